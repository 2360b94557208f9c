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
function(add_told_file name)
  add_custom_command(OUTPUT "${told_dir}/${name}"
    COMMAND sh -c "\"$0\" explain \"$@\" > \"${told_dir}/${name}\"" "$<TARGET_FILE:launchsafe>" ${ARGN}
    DEPENDS launchsafe
    VERBATIM)
endfunction()
add_told_file(launchsafe.1 --manual)
add_told_file(launchsafe.bash --completion bash)
add_told_file(scene.schema.json --schema scene)
add_told_file(study.schema.json --schema study)
add_told_file(references.schema.json --schema references)
add_custom_command(OUTPUT "${told_dir}/launchsafe.1.gz"
  COMMAND gzip --best --no-name --keep --force "${told_dir}/launchsafe.1"
  DEPENDS "${told_dir}/launchsafe.1")
add_custom_target(told ALL DEPENDS "${told_dir}/launchsafe.1.gz" "${told_dir}/launchsafe.bash"
  "${told_dir}/scene.schema.json" "${told_dir}/study.schema.json" "${told_dir}/references.schema.json")

set(data_dir "${CMAKE_INSTALL_DATADIR}/launchsafe")
install(FILES "${told_dir}/launchsafe.1.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT program)
install(FILES "${told_dir}/launchsafe.bash" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
  RENAME launchsafe COMPONENT program)
install(FILES "${told_dir}/scene.schema.json" "${told_dir}/study.schema.json" "${told_dir}/references.schema.json"
  DESTINATION "${data_dir}/schema"
  COMPONENT program)
# Studies rest on the records of others, which they name by their place beside them; pages link to each other likewise.
install(DIRECTORY studies DESTINATION "${data_dir}" COMPONENT program
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv" PATTERN "*.md" PATTERN "*.cpp")
install(DIRECTORY reports DESTINATION "${data_dir}" COMPONENT program
  FILES_MATCHING PATTERN "calibration.json" PATTERN "accuracy.json" PATTERN "model_form.json"
  PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png")
foreach(folder launchsafe launchsafe/mpm)
  install(FILES include/${folder}/README.md DESTINATION "${data_dir}/include/${folder}" COMPONENT program)
endforeach()
install(DIRECTORY src/report/templates DESTINATION "${data_dir}/src/report" COMPONENT program)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION "${data_dir}" COMPONENT program)
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
