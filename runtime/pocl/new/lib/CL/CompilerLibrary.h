//===- CompilerLibrary.h - What needs LLVM, in a library of its own -------===//
//
// To load LLVM and clang takes a third of the processor time of a small
// program: the dynamic linker relocates half a million addresses in them. A
// program whose kernels are in the kernel cache does without them. So what
// needs them is a library of its own, libvorion-pocl-compiler.so, which is
// loaded when one of its functions is called.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_POCL_COMPILER_LIBRARY_H
#define VORION_POCL_COMPILER_LIBRARY_H

#include "devices/vorion/KernelModule.h"
#include "pocl_llvm.h"

namespace pocl {

/// The library's functions, as they are declared.
struct CompilerFunctions {
  decltype(&InitializeLLVM) Initialize;
  decltype(&pocl_llvm_create_context) CreateContext;
  decltype(&pocl_llvm_release_context) ReleaseContext;
  decltype(&pocl_bitcode_is_triple) IsTriple;
  decltype(&pocl_llvm_build_program) BuildProgram;
  decltype(&pocl_llvm_link_program) LinkProgram;
  decltype(&pocl_llvm_read_program_llvm_irs) ReadProgram;
  decltype(&pocl_llvm_free_llvm_irs) FreeProgram;
  decltype(&pocl_llvm_get_kernel_count) KernelCount;
  decltype(&pocl_llvm_get_kernels_metadata) KernelsMetadata;
  decltype(&pocl_llvm_generate_workgroup_function_nowrite) WorkGroupFunction;
  decltype(&pocl_destroy_llvm_module) DestroyModule;
  decltype(&pocl_append_to_buildlog) AppendToBuildLog;
  decltype(&vorion::finishKernelModule) FinishKernelModule;
};

/// Where the library is: beside PoCL's own.
std::string compilerLibraryFile();

} // namespace pocl

/// Where the library has them: the only name that is looked up in it.
extern "C" POCL_EXPORT const pocl::CompilerFunctions vorion_compiler_functions;

#endif
