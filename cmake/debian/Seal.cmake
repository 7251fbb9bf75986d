# Run by cpack behind packing.
foreach(Package IN LISTS CPACK_PACKAGE_FILES)
  execute_process(COMMAND sh "${CMAKE_CURRENT_LIST_DIR}/seal.sh" "${Package}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
