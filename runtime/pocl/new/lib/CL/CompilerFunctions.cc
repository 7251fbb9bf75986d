//===- CompilerFunctions.cc - What the compiler's library offers ----------===//

#include "CompilerLibrary.h"

#include "devices/vorion/OutOfMemory.h"

static void initialize() {
  vorion::endInOneLineWithoutMemory();
  InitializeLLVM();
}

const pocl::CompilerFunctions vorion_compiler_functions = {
    initialize,
    pocl_llvm_create_context,
    pocl_llvm_release_context,
    pocl_bitcode_is_triple,
    pocl_llvm_build_program,
    pocl_llvm_link_program,
    pocl_llvm_read_program_llvm_irs,
    pocl_llvm_free_llvm_irs,
    pocl_llvm_get_kernel_count,
    pocl_llvm_get_kernels_metadata,
    pocl_llvm_generate_workgroup_function_nowrite,
    pocl_destroy_llvm_module,
    pocl_append_to_buildlog,
    vorion::finishKernelModule};
