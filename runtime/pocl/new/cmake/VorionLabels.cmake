# Labels the tests of this folder that the device `vorion` is to pass, or to skip for what it does not offer. A test
# exists once for each of the ways in which PoCL compiles groups for processors. The device has a way of its own,
# so one of them is enough. What the tests ask of processors is taken away: the choice of a device, and that some
# cannot pass.
get_property(Tests DIRECTORY PROPERTY TESTS)
foreach(Test IN LISTS Tests)
  if(NOT Test MATCHES "_(cbs|loops|repl)$")
    get_property(Environment TEST "${Test}" PROPERTY ENVIRONMENT)
    list(FILTER Environment EXCLUDE REGEX "^POCL_DEVICES=")
    set_tests_properties("${Test}" PROPERTIES ENVIRONMENT "${Environment}" WILL_FAIL 0)
    set_property(TEST "${Test}" APPEND PROPERTY LABELS vorion)
  endif()
endforeach()
