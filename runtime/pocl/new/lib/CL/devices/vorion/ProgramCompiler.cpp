#include "ProgramCompiler.h"

#include "Device.h"
#include "ProgramKernels.h"

extern "C" {
#include "pocl_cache_folders.h"
#include "pocl_file_util.h"
#include "pocl_llvm.h"
#include "pocl_util.h"
}

#include <cstdlib>
#include <cstring>
#include <utility>

using namespace vorion;

namespace {

std::string textOrNone(const char *Text) { return Text ? Text : ""; }

/// Adds to the program's log.
void addToLog(cl_program Program, cl_uint Index, const std::string &Text) {
  if (Text.empty())
    return;
  char *&Log = Program->build_log[Index];
  const std::string All = textOrNone(Log) + Text;
  std::free(Log);
  Log = strdup(All.c_str());
}

/// The program becomes what the compiler made of it.
void take(cl_program Program, cl_uint Index, const CompilerAnswer &Answer) {
  Answer.Hash.copy(reinterpret_cast<char *>(Program->build_hash[Index]),
                   sizeof(SHA1_digest_t) - 1);
  addToLog(Program, Index, Answer.Log);
  if (Answer.Status != CL_SUCCESS)
    return;
  POCL_MEM_FREE(Program->binaries[Index]);
  Program->binaries[Index] =
      static_cast<unsigned char *>(std::malloc(Answer.Binary.size()));
  Program->binary_sizes[Index] = Answer.Binary.size();
  Answer.Binary.copy(reinterpret_cast<char *>(Program->binaries[Index]),
                     Answer.Binary.size());
  Program->global_var_total_size[Index] = Answer.VariableBytes;
  if (!Answer.Kernels.empty())
    keepKernels(Program, Index, Answer.Kernels);
}

const Tools &toolsFor(cl_program Program, cl_uint Index) {
  return deviceOf(Program->devices[Index]).Kernels.tools();
}

/// Asks for \p Request. Without an answer, the program's log says why.
int makeProgram(cl_program Program, cl_uint Index, CompilerRequest &Request) {
  CompilerAnswer Answer;
  if (const auto Why = toolsFor(Program, Index).ask(Request, Answer)) {
    addToLog(Program, Index, Why->message() + "\n");
    return Why->LackedResources ? CL_OUT_OF_HOST_MEMORY
                                : CL_BUILD_PROGRAM_FAILURE;
  }
  take(Program, Index, Answer);
  return Answer.Status;
}

} // namespace

CompilerRequest vorion::requestFor(cl_program Program, cl_uint Index,
                                   CompilerTask Task) {
  CompilerRequest Request;
  Request.Task = Task;
  cl_device_id Device = Program->devices[Index];
  Request.Device = *Device;
  for (const auto &[Text, From] :
       {std::pair(&Request.DeviceHash, Device->ops->build_hash(Device)),
        std::pair(&Request.DeviceOptions,
                  Device->ops->init_build(Device->data))}) {
    *Text = textOrNone(From);
    std::free(From);
  }
  Request.Options = textOrNone(Program->compiler_options);
  Request.BinaryType = Program->binary_type;
  Request.FlushesDenorms = Program->flush_denorms;
  Request.Hash = reinterpret_cast<const char *>(Program->build_hash[Index]);
  if (Program->binaries[Index])
    Request.Binaries.emplace_back(
        reinterpret_cast<const char *>(Program->binaries[Index]),
        Program->binary_sizes[Index]);
  return Request;
}

bool vorion::describeKernels(cl_program Program, cl_uint Index) {
  CompilerRequest Request = requestFor(Program, Index, CompilerTask::Kernels);
  CompilerAnswer Answer;
  if (const auto Why = toolsFor(Program, Index).ask(Request, Answer)) {
    addToLog(Program, Index, Why->message() + "\n");
    return false;
  }
  if (Answer.Status != CL_SUCCESS)
    return false;
  keepKernels(Program, Index, Answer.Kernels);
  return adoptKernels(Program, Index, Answer.Kernels);
}

// --- The functions of pocl_llvm.h. Nothing is prepared for them, and no
// --- program is kept as a module of LLVM.

void InitializeLLVM() {}
void UnInitializeLLVM() {}
void pocl_llvm_create_context(cl_context) {}
void pocl_llvm_release_context(cl_context) {}
int pocl_llvm_read_program_llvm_irs(cl_program, unsigned, const char *) {
  return CL_SUCCESS;
}
void pocl_llvm_free_llvm_irs(cl_program, unsigned) {}

int pocl_bitcode_is_triple(const char *Bitcode, size_t Size,
                           const char *Triple) {
  CompilerRequest Request;
  Request.Task = CompilerTask::Triple;
  Request.Binaries.emplace_back(Bitcode, Size);
  Request.Triple = Triple;
  CompilerAnswer Answer;
  return !Tools().ask(Request, Answer) && Answer.Status == CL_SUCCESS;
}

int pocl_llvm_build_program(cl_program Program, unsigned Index,
                            cl_uint NumHeaders, const cl_program *Headers,
                            const char **Names, int Link) {
  // The compiler takes such a folder for one that stays.
  if (pocl_cache_keeps_programs())
    pocl_tell_of_private_cache();
  CompilerRequest Request = requestFor(Program, Index, CompilerTask::Build);
  Request.Binaries.clear();
  Request.Source = textOrNone(Program->source);
  for (cl_uint I = 0; I != NumHeaders; ++I)
    Request.Headers.push_back({Names[I], textOrNone(Headers[I]->source)});
  Request.LinksLibrary = Link;
  return makeProgram(Program, Index, Request);
}

int pocl_llvm_link_program(cl_program Program, unsigned Index, cl_uint Count,
                           unsigned char **Binaries, size_t *Sizes, void **,
                           int LinkLibrary, int IsNew) {
  CompilerRequest Request = requestFor(Program, Index, CompilerTask::Link);
  Request.Binaries.clear();
  for (cl_uint I = 0; I != Count; ++I)
    Request.Binaries.emplace_back(reinterpret_cast<const char *>(Binaries[I]),
                                  Sizes[I]);
  Request.LinksLibrary = LinkLibrary;
  Request.IsNew = IsNew;
  return makeProgram(Program, Index, Request);
}

void pocl_append_to_buildlog(cl_program Program, cl_uint Index, char *Log,
                             size_t Size) {
  addToLog(Program, Index, std::string(Log, Size));
  std::free(Log);
}

// Of other devices. PoCL asks for it where it describes any device.

unsigned pocl_llvm_get_kernel_count(cl_program, unsigned) { return 0; }
int pocl_llvm_get_kernels_metadata(cl_program, unsigned) { return -1; }
int pocl_llvm_generate_workgroup_function_nowrite(unsigned, cl_device_id,
                                                  cl_kernel, _cl_command_node *,
                                                  void **, int) {
  return -1;
}
void pocl_destroy_llvm_module(void *, cl_context) {}
int pocl_write_module(void *, const char *) { return -1; }
int cpu_has_fma() { return 0; }
void cpu_setup_vector_widths(cl_device_id) {}
char *pocl_get_llvm_cpu_name() { return strdup(""); }
const char *pocl_get_llvm_cpu_abi() { return nullptr; }
int pocl_llvm_remove_file_on_signal(const char *) { return -1; }
int pocl_invoke_clang(cl_device_id, const char **) { return -1; }
int pocl_llvm_codegen(cl_device_id, cl_program, void *, char **, uint64_t *) {
  return -1;
}
