# The fuzzers of the readers as tests with the label `fuzz`: clang++ builds them in a configuration of their own, then
# each runs for some seconds on the seeds of tests/fuzz/corpus and on what earlier runs found. An input that fails is
# kept in fuzz/failures of the build folder, `fuzz/tests/fuzz/fuzz_scene FILE` repeats it, and what it showed becomes
# a usual test (tests/scene/fuzzed_input_test.cpp).
if(LAUNCHSAFE_SANITIZE OR NOT TARGET launchsafe)
  return() # the fuzzers have the same sanitizers: once is enough
endif()

set(fuzz_dir "${PROJECT_BINARY_DIR}/fuzz")
include("${CMAKE_CURRENT_LIST_DIR}/readers.cmake")

# Whether there is a clang++ with its fuzzer's library.
find_program(LAUNCHSAFE_FUZZ_COMPILER NAMES clang++)
if(LAUNCHSAFE_FUZZ_COMPILER AND NOT DEFINED LAUNCHSAFE_CAN_FUZZ)
  set(probe "${PROJECT_BINARY_DIR}/can_fuzz")
  file(WRITE "${probe}.cpp" "extern \"C\" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }\n")
  execute_process(
    COMMAND "${LAUNCHSAFE_FUZZ_COMPILER}" -fsanitize=fuzzer,address,undefined "${probe}.cpp" -o "${probe}"
    RESULT_VARIABLE probe_result OUTPUT_QUIET ERROR_QUIET)
  if(probe_result EQUAL 0)
    set(LAUNCHSAFE_CAN_FUZZ ON CACHE INTERNAL "clang++ has the library of its fuzzer")
  endif()
endif()

if(NOT LAUNCHSAFE_CAN_FUZZ)
  message(STATUS "clang++ with the library of its fuzzer not found: the fuzzers are skipped")
  foreach(reader IN LISTS fuzzed_readers)
    add_test(NAME fuzz.${reader} COMMAND "${CMAKE_COMMAND}" -E echo "skipped: no clang++ with libFuzzer")
    set_tests_properties(fuzz.${reader} PROPERTIES LABELS fuzz SKIP_REGULAR_EXPRESSION "skipped")
  endforeach()
  return()
endif()

add_test(NAME fuzz.configure
  COMMAND "${CMAKE_COMMAND}" --preset fuzz -S "${PROJECT_SOURCE_DIR}" -B "${fuzz_dir}"
          "-DCMAKE_CXX_COMPILER=${LAUNCHSAFE_FUZZ_COMPILER}"
          "-DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}"
  WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
add_test(NAME fuzz.build COMMAND "${CMAKE_COMMAND}" --build "${fuzz_dir}" --parallel 2 --target fuzzers)
set_tests_properties(fuzz.configure PROPERTIES FIXTURES_SETUP fuzz_configuration LABELS fuzz TIMEOUT 120)
set_tests_properties(fuzz.build PROPERTIES
  FIXTURES_REQUIRED fuzz_configuration FIXTURES_SETUP fuzzers LABELS fuzz PROCESSORS 2 TIMEOUT 1800)

# Shipped files are seeds too, as far as -max_len goes.
file(GLOB shipped CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/studies/*.toml")
list(JOIN shipped "," shipped)
set(seeds_scene "-seed_inputs=${shipped}")
set(seeds_study "-seed_inputs=${shipped}")
file(MAKE_DIRECTORY "${fuzz_dir}/failures")
foreach(reader IN LISTS fuzzed_readers)
  set(found "${fuzz_dir}/found_${reader}")
  file(MAKE_DIRECTORY "${found}")
  set(longest 6000)
  # -timeout, s: a reader that takes so long on an input hangs. -rss_limit_mb: or holds all of it.
  add_test(NAME fuzz.${reader}
    COMMAND "${fuzz_dir}/tests/fuzz/fuzz_${reader}" -seed=1 -max_total_time=15 -timeout=10 -rss_limit_mb=2048 -max_len=${longest}
            -print_final_stats=1 "-dict=${CMAKE_CURRENT_SOURCE_DIR}/fuzz/keys.dict"
            "-artifact_prefix=${fuzz_dir}/failures/${reader}-" ${seeds_${reader}} "${found}"
            "${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus/${reader}")
  set_tests_properties(fuzz.${reader} PROPERTIES FIXTURES_REQUIRED fuzzers LABELS fuzz TIMEOUT 180)
endforeach()
