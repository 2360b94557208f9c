# Writes launchsafe/version.hpp; run at every build, rewrites the header only when its content changes.
#   cmake -D SOURCE_DIR= -D OUTPUT= -D VERSION= -D COMPILER= -D FLAGS= -D BUILD_TYPE= -P version.cmake
cmake_minimum_required(VERSION 3.25)

set(COMMIT "unknown")
find_program(git_program git)
if(git_program AND EXISTS "${SOURCE_DIR}/.git") # a source archive unpacked inside another repository has no commit
  execute_process(
    COMMAND "${git_program}" rev-parse --verify HEAD
    WORKING_DIRECTORY "${SOURCE_DIR}"
    RESULT_VARIABLE failed OUTPUT_VARIABLE head ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed)
    set(COMMIT "${head}")
    # Only what the program is built from counts: remaking a report does not make the program another one.
    execute_process(
      COMMAND "${git_program}" --no-optional-locks status --porcelain -- CMakeLists.txt .cmake include src
      WORKING_DIRECTORY "${SOURCE_DIR}"
      RESULT_VARIABLE failed OUTPUT_VARIABLE changes ERROR_QUIET)
    if(failed OR NOT changes STREQUAL "")
      string(APPEND COMMIT "-dirty")
    endif()
  endif()
endif()

configure_file("${CMAKE_CURRENT_LIST_DIR}/version.hpp.in" "${OUTPUT}" @ONLY)
