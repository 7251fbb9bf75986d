# Writes to OUTPUT, unless it says so already, the commit of the checkout SOURCE,
# with "-changed" if files differ from it; COMMIT if that is given; "unknown" of
# what is no checkout.
if(COMMIT STREQUAL "")
  set(COMMIT unknown)
  set(Git "${CMAKE_COMMAND}" -E env GIT_OPTIONAL_LOCKS=0 git -C "${SOURCE}")
  execute_process(COMMAND ${Git} rev-parse --show-prefix RESULT_VARIABLE Failed OUTPUT_VARIABLE Prefix
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  # A source tree below somebody else's checkout is not what that checkout is.
  if(Failed EQUAL 0 AND Prefix STREQUAL "")
    execute_process(COMMAND ${Git} describe --always --exclude=* --abbrev=12 --dirty=-changed RESULT_VARIABLE Failed
                    OUTPUT_VARIABLE Described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(Failed EQUAL 0)
      set(COMMIT "${Described}")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "${COMMIT}\n" @ONLY)
