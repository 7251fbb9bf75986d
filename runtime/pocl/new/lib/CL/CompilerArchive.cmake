# What vorion-compiler contains of PoCL: its front end and passes, and what these call of the library. llvm-backend/new
# has headers that some of our passes share with the machine's compiler, and tells LLVM's headers that its target is the
# only one.
foreach(Part "lib_cl_llvm" "llvmpasses" "pocl-compiler-vorion")
  target_include_directories(${Part} BEFORE PRIVATE "${VORION_BACKEND}/config")
  target_include_directories(${Part} PRIVATE "${VORION_BACKEND}")
endforeach()
add_library("pocl-compiler" STATIC $<TARGET_OBJECTS:lib_cl_llvm> $<TARGET_OBJECTS:llvmpasses>
  $<TARGET_OBJECTS:pocl-compiler-vorion> $<TARGET_OBJECTS:pocl_cache>
  "$<FILTER:$<TARGET_OBJECTS:libpocl_unlinked_objs>,INCLUDE,/pocl_(checked_file|debug|file_util|hash|runtime_config|threads|timing|util)[.]c>"
  "$<FILTER:$<TARGET_OBJECTS:pocl-devices-vorion>,INCLUDE,/CacheFolders[.]cpp>")
set_target_properties("pocl-compiler" PROPERTIES LINKER_LANGUAGE CXX)
