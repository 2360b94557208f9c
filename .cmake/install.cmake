# cmake --install, and the Debian package that .ci/package makes of it. A build that is one of the package's faster
# programs (LAUNCHSAFE_ARCHITECTURE without LAUNCHSAFE_CHOOSES_PROGRAM, in a preset package-*) installs that program alone
# as the component `faster`.
include(GNUInstallDirs)
install(TARGETS launchsafe RUNTIME COMPONENT program)
if(LAUNCHSAFE_ARCHITECTURE)
  install(TARGETS launchsafe RUNTIME DESTINATION lib/launchsafe/${LAUNCHSAFE_ARCHITECTURE} COMPONENT faster EXCLUDE_FROM_ALL)
endif()

# What the program says of itself.
set(told_dir "${PROJECT_BINARY_DIR}/told")
file(MAKE_DIRECTORY "${told_dir}")
foreach(kind scene study references)
  set(schema "${told_dir}/${kind}.schema.json")
  add_custom_command(OUTPUT "${schema}"
    COMMAND sh -c "\"$0\" explain --schema ${kind} > \"${schema}\"" "$<TARGET_FILE:launchsafe>"
    DEPENDS launchsafe
    VERBATIM)
  list(APPEND told_files "${schema}")
endforeach()

set(completion "${told_dir}/launchsafe.bash")
add_custom_command(OUTPUT "${completion}"
  COMMAND sh -c "\"$0\" --bash-completion > \"${completion}\"" "$<TARGET_FILE:launchsafe>"
  DEPENDS launchsafe
  VERBATIM)
install(FILES "${completion}" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" RENAME launchsafe
  COMPONENT program)

# The manual page, of what --help says.
find_program(LAUNCHSAFE_HELP2MAN help2man)
if(LAUNCHSAFE_HELP2MAN)
  add_custom_command(OUTPUT "${told_dir}/launchsafe.1.gz"
    COMMAND "${LAUNCHSAFE_HELP2MAN}" --no-info --version-string=${PROJECT_VERSION}
      "--name=launch safety of explosive shells by the material point method" "--output=${told_dir}/launchsafe.1"
      "$<TARGET_FILE:launchsafe>"
    COMMAND gzip --best --no-name --force "${told_dir}/launchsafe.1"
    DEPENDS launchsafe
    VERBATIM)
  install(FILES "${told_dir}/launchsafe.1.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT program)
  set(manual_page "${told_dir}/launchsafe.1.gz")
else()
  message(STATUS "help2man was not found: an installation will have no manual page")
endif()
add_custom_target(told ALL DEPENDS ${told_files} ${completion} ${manual_page})

set(data_dir "${CMAKE_INSTALL_DATADIR}/launchsafe")
install(FILES ${told_files} DESTINATION "${data_dir}/schema" COMPONENT program)
# Studies rest on the records of others, which they name by their place beside them; pages link to each other likewise.
install(DIRECTORY studies DESTINATION "${data_dir}" COMPONENT program
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv" PATTERN "*.txt" PATTERN "*.md" PATTERN "*.cpp")
install(DIRECTORY reports DESTINATION "${data_dir}" COMPONENT program
  FILES_MATCHING PATTERN "calibration.json" PATTERN "accuracy*.json" PATTERN "model_form.json"
  PATTERN "*.md" PATTERN "*.html" PATTERN "*.svg" PATTERN "*.png")
foreach(folder launchsafe launchsafe/mpm)
  install(FILES include/${folder}/README.md DESTINATION "${data_dir}/include/${folder}" COMPONENT program)
endforeach()
install(DIRECTORY src/report/templates DESTINATION "${data_dir}/src/report" COMPONENT program)
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION "${data_dir}" COMPONENT program)
install(FILES LICENSE CHANGELOG.md CITATION.cff DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" RENAME copyright COMPONENT program)

# --- the Debian package ---

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME launchsafe)
set(CPACK_PACKAGE_CONTACT "The launchsafe developers <launchsafe@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "launch safety of explosive shells by the material point method")
set(CPACK_PACKAGE_DESCRIPTION
  "How thick may the gap under an explosive charge be before a launch ignites it?\nlaunchsafe simulates launches by the material point method, seeks the critical\ngap, and writes verdict tables and reports.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};launchsafe;program;/")
foreach(architecture x86-64-v3 x86-64-v4)
  list(APPEND CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_SOURCE_DIR}/build/package-${architecture};launchsafe;faster;/")
endforeach()
include(CPack)
