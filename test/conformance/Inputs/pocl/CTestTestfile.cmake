# Tests as PoCL's build files describe them to CTest.
add_test(kernel/good "/bin/sh" "-c" "echo FIRST $CHOSEN && echo SECOND")
add_test(kernel/wrong "/bin/sh" "-c" "echo FAIL: 2 is not 3")
add_test(kernel/skips "/bin/sh" "-c" "exit 77")
# As programs that CMake runs do, its program is in a process group of its own, and only its session is the test's.
add_test(kernel/hangs "/bin/bash" "-c" "set -m; sleep 987654 & wait")
set_tests_properties(kernel/good kernel/wrong kernel/skips kernel/hangs PROPERTIES
  LABELS "internal;vorion" WORKING_DIRECTORY "/tmp" SKIP_RETURN_CODE 77 ENVIRONMENT "CHOSEN=this"
  FAIL_REGULAR_EXPRESSION "FAIL" PASS_REGULAR_EXPRESSION "FIRST this.*SECOND")
add_test(kernel/unlabelled "/bin/sh" "-c" "exit 1")
