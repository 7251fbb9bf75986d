# What needs LLVM and clang, which CompilerLibrary.cc loads from the folder of
# PoCL's library. It calls functions of that, some of which have the names of its
# own: -Bsymbolic, so that it calls its own.
add_library("pocl-compiler" SHARED $<TARGET_OBJECTS:lib_cl_llvm> $<TARGET_OBJECTS:llvmpasses>
  $<TARGET_OBJECTS:pocl-compiler-vorion>)
harden("pocl-compiler")
target_link_options("pocl-compiler" PRIVATE "LINKER:--exclude-libs,ALL" "LINKER:-Bsymbolic" "LINKER:--no-undefined")
set_target_properties("pocl-compiler" PROPERTIES
  OUTPUT_NAME "vorion-pocl-compiler" LINK_FLAGS "${LLVM_LDFLAGS}" INSTALL_RPATH "\$ORIGIN;${CMAKE_INSTALL_RPATH}")
target_link_libraries("pocl-compiler" PRIVATE "${POCL_LIBRARY_NAME}" ${CLANG_LIBFILES} ${POCL_LLVM_LIBS} ${LLVM_SYSLIBS}
  ${LIBMATH} ${CMAKE_DL_LIBS} ${PTHREAD_LIBRARY})
install(TARGETS "pocl-compiler" LIBRARY DESTINATION ${POCL_INSTALL_PUBLIC_LIBDIR} COMPONENT "lib")
