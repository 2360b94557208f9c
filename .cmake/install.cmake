# cmake --install, and the Debian package that .ci/package makes of it. A build that is one of the package's faster
# programs (LAUNCHSAFE_ARCHITECTURE without LAUNCHSAFE_CHOOSES_PROGRAM, in a preset package-*) installs that program alone
# as the component `faster`.
include(GNUInstallDirs)
install(TARGETS launchsafe RUNTIME COMPONENT program)
if(LAUNCHSAFE_ARCHITECTURE)
  install(TARGETS launchsafe RUNTIME DESTINATION lib/launchsafe/${LAUNCHSAFE_ARCHITECTURE} COMPONENT faster EXCLUDE_FROM_ALL)
endif()

# The manual page, of what --help says.
find_program(LAUNCHSAFE_HELP2MAN help2man)
if(LAUNCHSAFE_HELP2MAN)
  set(manual_page "${PROJECT_BINARY_DIR}/launchsafe.1")
  add_custom_command(OUTPUT "${manual_page}.gz"
    COMMAND "${LAUNCHSAFE_HELP2MAN}" --no-info --version-string=${PROJECT_VERSION}
      "--name=launch safety of explosive shells by the material point method" "--output=${manual_page}"
      "$<TARGET_FILE:launchsafe>"
    COMMAND gzip --best --no-name --force "${manual_page}"
    DEPENDS launchsafe
    VERBATIM)
  install(FILES "${manual_page}.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT program)
  add_custom_target(manual ALL DEPENDS "${manual_page}.gz")
else()
  message(STATUS "help2man was not found: an installation will have no manual page")
endif()

set(data_dir "${CMAKE_INSTALL_DATADIR}/launchsafe")
# Studies rest on the records of others, which they name by their place beside them; pages link to each other likewise.
install(DIRECTORY studies DESTINATION "${data_dir}" COMPONENT program
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.json" PATTERN "*.csv" PATTERN "*.txt" PATTERN "*.md" PATTERN "*.cpp" PATTERN "*.sbatch")
install(DIRECTORY reports DESTINATION "${data_dir}" COMPONENT program
  FILES_MATCHING PATTERN "*.md" PATTERN "*.html" PATTERN "*.svg" PATTERN "*.png")
foreach(folder launchsafe launchsafe/mpm)
  install(FILES include/${folder}/README.md DESTINATION "${data_dir}/include/${folder}" COMPONENT program)
endforeach()
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
