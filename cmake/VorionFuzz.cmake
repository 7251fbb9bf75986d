# vorion_fuzzer(NAME SOURCE LIBRARY...): a libFuzzer program, built by the
# `fuzz` preset alone (VORION_FUZZ); in every other build the call does nothing.
# The target `fuzzers` builds all of them, into bin/. SOURCE defines
# LLVMFuzzerTestOneInput; see docs/random-tests.md for how to run them.
option(VORION_FUZZ "Build the libFuzzer programs, with coverage in our own libraries" OFF)

if(VORION_FUZZ)
  # Our libraries count their branches; only fuzzers link libFuzzer's main.
  target_compile_options(vorion_options INTERFACE -fsanitize=fuzzer-no-link)
  target_link_options(vorion_options INTERFACE -fsanitize=fuzzer-no-link)
  add_custom_target(fuzzers)
endif()

function(vorion_fuzzer Name Source)
  if(NOT VORION_FUZZ)
    return()
  endif()
  add_executable(${Name} EXCLUDE_FROM_ALL ${Source})
  target_link_libraries(${Name} PRIVATE vorion_options ${ARGN})
  target_link_options(${Name} PRIVATE -fsanitize=fuzzer)
  add_dependencies(fuzzers ${Name})
endfunction()
