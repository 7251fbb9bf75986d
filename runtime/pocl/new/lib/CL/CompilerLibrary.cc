//===- CompilerLibrary.cc - What needs LLVM, loaded when it is needed -----===//
//
// The functions of pocl_llvm.h, by their names. Each loads the compiler's
// library first; the library has functions of the same names.
//
//===----------------------------------------------------------------------===//

#include "CompilerLibrary.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <mutex>
#include <string>

using pocl::CompilerFunctions;

namespace {

/// Null, and a line on standard error, if the library cannot be loaded.
const CompilerFunctions *load() {
  const std::string File = pocl::compilerLibraryFile();
  void *Library = dlopen(File.c_str(), RTLD_NOW | RTLD_LOCAL);
  const void *Found =
      Library ? dlsym(Library, "vorion_compiler_functions") : nullptr;
  if (!Found) {
    fprintf(stderr, "vorion: error: the compiler cannot be loaded: %s\n",
            dlerror());
    return nullptr;
  }
  const auto *Functions = static_cast<const CompilerFunctions *>(Found);
  Functions->Initialize();
  return Functions;
}

const CompilerFunctions *compiler() {
  static const CompilerFunctions *const Loaded = load();
  return Loaded;
}

/// While what the compiler keeps of contexts is made or freed.
std::mutex ContextLock;

/// The same, with what it keeps of a context.
const CompilerFunctions *compilerFor(cl_context Context) {
  const CompilerFunctions *Functions = compiler();
  const std::lock_guard<std::mutex> Guard(ContextLock);
  if (Functions && !Context->llvm_context_data)
    Functions->CreateContext(Context);
  return Functions;
}

} // namespace

std::string pocl::compilerLibraryFile() {
  Dl_info Own;
  if (!dladdr(reinterpret_cast<void *>(&load), &Own))
    return {};
  const std::string Path(Own.dli_fname);
  return Path.substr(0, Path.rfind('/') + 1) + "libvorion-pocl-compiler.so";
}

// A context is given what the compiler keeps of it when it is needed.

void InitializeLLVM() {}
void UnInitializeLLVM() {}
void pocl_llvm_create_context(cl_context) {}

void pocl_llvm_release_context(cl_context Context) {
  const std::lock_guard<std::mutex> Guard(ContextLock);
  if (Context->llvm_context_data)
    compiler()->ReleaseContext(Context);
}

int pocl_bitcode_is_triple(const char *Bitcode, size_t Size,
                           const char *Triple) {
  const CompilerFunctions *Functions = compiler();
  return Functions ? Functions->IsTriple(Bitcode, Size, Triple) : 0;
}

int pocl_llvm_build_program(cl_program Program, unsigned Device,
                            cl_uint NumHeaders, const cl_program *Headers,
                            const char **Names, int Link) {
  const CompilerFunctions *Functions = compilerFor(Program->context);
  return Functions ? Functions->BuildProgram(Program, Device, NumHeaders,
                                             Headers, Names, Link)
                   : CL_BUILD_PROGRAM_FAILURE;
}

int pocl_llvm_link_program(cl_program Program, unsigned Device,
                           cl_uint NumPrograms, unsigned char **Binaries,
                           size_t *Sizes, void **Modules, int LinkLibrary,
                           int IsNew) {
  const CompilerFunctions *Functions = compilerFor(Program->context);
  return Functions
             ? Functions->LinkProgram(Program, Device, NumPrograms, Binaries,
                                      Sizes, Modules, LinkLibrary, IsNew)
             : CL_LINK_PROGRAM_FAILURE;
}

int pocl_llvm_read_program_llvm_irs(cl_program Program, unsigned Device,
                                    const char *Path) {
  const CompilerFunctions *Functions = compilerFor(Program->context);
  return Functions ? Functions->ReadProgram(Program, Device, Path)
                   : CL_BUILD_PROGRAM_FAILURE;
}

void pocl_llvm_free_llvm_irs(cl_program Program, unsigned Device) {
  if (Program->llvm_irs[Device])
    compiler()->FreeProgram(Program, Device);
}

unsigned pocl_llvm_get_kernel_count(cl_program Program, unsigned Device) {
  const CompilerFunctions *Functions = compilerFor(Program->context);
  return Functions ? Functions->KernelCount(Program, Device) : 0;
}

int pocl_llvm_get_kernels_metadata(cl_program Program, unsigned Device) {
  const CompilerFunctions *Functions = compilerFor(Program->context);
  return Functions ? Functions->KernelsMetadata(Program, Device)
                   : CL_INVALID_KERNEL;
}

int pocl_llvm_generate_workgroup_function_nowrite(
    unsigned DeviceI, cl_device_id Device, cl_kernel Kernel,
    _cl_command_node *Command, void **Output, int Specialize) {
  const CompilerFunctions *Functions = compilerFor(Kernel->context);
  // A binary may be without the program.
  if (!Functions || (!Kernel->program->llvm_irs[DeviceI] &&
                     !Kernel->program->binaries[DeviceI]))
    return CL_BUILD_PROGRAM_FAILURE;
  if (const int Status =
          Functions->ReadProgram(Kernel->program, DeviceI, nullptr))
    return Status;
  return Functions->WorkGroupFunction(DeviceI, Device, Kernel, Command, Output,
                                      Specialize);
}

void pocl_destroy_llvm_module(void *Module, cl_context Context) {
  compilerFor(Context)->DestroyModule(Module, Context);
}

void pocl_append_to_buildlog(cl_program Program, cl_uint Device, char *Log,
                             size_t Size) {
  if (const CompilerFunctions *Functions = compiler())
    Functions->AppendToBuildLog(Program, Device, Log, Size);
  else
    free(Log);
}

std::string vorion::finishKernelModule(void *Module,
                                       const KernelDescription &Kernel,
                                       std::string &Bitcode) {
  return compiler()->FinishKernelModule(Module, Kernel, Bitcode);
}

// Of the host's processor, which is no device of this platform. PoCL asks for
// it where it describes any device.

int cpu_has_fma() { return 0; }
void cpu_setup_vector_widths(cl_device_id) {}
char *pocl_get_llvm_cpu_name() { return strdup(""); }
const char *pocl_get_llvm_cpu_abi() { return nullptr; }
int pocl_llvm_remove_file_on_signal(const char *) { return -1; }
extern "C" int pocl_write_module(void *, const char *) { return -1; }
int pocl_invoke_clang(cl_device_id, const char **) { return -1; }
int pocl_llvm_codegen(cl_device_id, cl_program, void *, char **, uint64_t *) {
  return -1;
}
