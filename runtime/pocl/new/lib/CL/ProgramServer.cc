//===- ProgramServer.cc - PoCL's front end and passes in the compiler -----===//
//
// PoCL's functions work on programs of the OpenCL library. Here these objects
// are made of a request's fields, for as long as it takes to answer it.
//
//===----------------------------------------------------------------------===//

#include "ProgramServer.h"

#include "devices/vorion/CompilerMessages.h"
#include "devices/vorion/OutOfMemory.h"

#include "pocl_cache.h"
#include "pocl_cache_folders.h"
#include "pocl_checked_file.h"
#include "pocl_llvm.h"
#include "pocl_llvm_api.h"
#include "pocl_runtime_config.h"
#include "pocl_util.h"

#include <llvm/IR/Module.h>
#include <llvm/Support/CommandLine.h>

#include <cstdlib>
#include <cstring>
#include <optional>
#include <unistd.h>
#include <vector>

namespace {

/// What pocl_get_private_datadir() gives.
std::string DataFolder;

/// What the device's functions give, of the request that is answered.
std::string DeviceHash, DeviceOptions;

pocl_device_ops *operations() {
  static pocl_device_ops Ops{};
  Ops.build_hash = [](cl_device_id) { return strdup(DeviceHash.c_str()); };
  Ops.init_build = [](void *) { return strdup(DeviceOptions.c_str()); };
  return &Ops;
}

} // namespace

// What PoCL's functions call of parts of it that the compiler does not have.

int pocl_get_private_datadir(char *Path) {
  strcpy(Path, DataFolder.c_str());
  return 0;
}
/// No kernel is compiled for small ranges.
size_t pocl_cmd_max_grid_dim_width(_cl_command_run *) { return SIZE_MAX; }

namespace vorion {

namespace {

/// Of the request that is answered. PoCL knows the library by it.
_cl_device_id Device;

/// What PoCL keeps for LLVM: its context and the library of built-in functions.
class Context {
public:
  Context() { pocl_llvm_create_context(&Of); }
  Context(const Context &) = delete;
  Context &operator=(const Context &) = delete;
  ~Context() { pocl_llvm_release_context(&Of); }

  cl_context get() { return &Of; }

  /// Whether all structures of \p Program are the library's.
  bool hasOnlyLibraryTypes(const llvm::Module &Program) {
    const auto *Data = static_cast<PoclLLVMContextData *>(Of.llvm_context_data);
    const auto Library = Data->kernelLibraryMap->find(&Device);
    if (Library == Data->kernelLibraryMap->end())
      return false;
    const auto Known = Library->second->getIdentifiedStructTypes();
    return llvm::all_of(Program.getIdentifiedStructTypes(),
                        [&](llvm::StructType *Type) {
                          return llvm::is_contained(Known, Type);
                        });
  }

private:
  _cl_context Of{};
};

/// The one in which programs are linked with the library, which takes 20 ms to
/// read. The names of structures that bitcode has depend on what its context
/// had before: only programs without structures of their own leave it to the
/// next one.
std::optional<Context> LinkContext;

/// A program of one device with what a request has of it.
class Program {
public:
  Program(CompilerRequest &Request, Context &LlvmContext) {
    Of.context = LlvmContext.get();
    Of.num_devices = Of.associated_num_devices = 1;
    Of.devices = Of.associated_devices = &DevicePointer;
    Of.compiler_options = Request.Options.data();
    Of.binary_type = Request.BinaryType;
    Of.flush_denorms = Request.FlushesDenorms;
    Of.source = Request.Source.data();
    Of.build_hash = &Hash;
    Of.llvm_irs = &Module;
    Of.binaries = &Binary;
    Of.binary_sizes = &BinarySize;
    Of.build_log = &Log;
    Of.global_var_total_size = &VariableBytes;
    Request.Hash.copy(reinterpret_cast<char *>(Hash), sizeof(Hash));
  }
  Program(const Program &) = delete;
  Program &operator=(const Program &) = delete;
  ~Program() {
    for (size_t I = 0; I != Of.num_kernels; ++I)
      pocl_free_kernel_metadata(&Of, I);
    std::free(Of.kernel_meta);
    pocl_llvm_free_llvm_irs(&Of, 0);
    std::free(Binary);
    std::free(Log);
  }

  cl_program get() { return &Of; }

  /// Reads \p Bitcode. False if it is none.
  bool read(const std::string &Bitcode) {
    Binary = static_cast<unsigned char *>(std::malloc(Bitcode.size()));
    std::memcpy(Binary, Bitcode.data(), Bitcode.size());
    BinarySize = Bitcode.size();
    return pocl_llvm_read_program_llvm_irs(&Of, 0, nullptr) == CL_SUCCESS;
  }

  /// Null if it was not made.
  const llvm::Module *module() const {
    return static_cast<const llvm::Module *>(Module);
  }

  /// What is known of it now.
  void describe(CompilerAnswer &Answer) const {
    Answer.Hash = reinterpret_cast<const char *>(Hash);
    Answer.Binary.assign(reinterpret_cast<const char *>(Binary), BinarySize);
    Answer.Log = Log ? Log : "";
    Answer.VariableBytes = VariableBytes;
  }

  /// Of a program that is linked with the library.
  cl_int describeKernels(CompilerAnswer &Answer) {
    Of.num_kernels = pocl_llvm_get_kernel_count(&Of, 0);
    Of.kernel_meta = static_cast<pocl_kernel_metadata_t *>(
        std::calloc(Of.num_kernels, sizeof(*Of.kernel_meta)));
    const cl_int Status = pocl_llvm_get_kernels_metadata(&Of, 0);
    ProgramKernels Kernels{VariableBytes, Of.kernel_meta,
                           static_cast<cl_uint>(Of.num_kernels)};
    Answer.Kernels = textOf(Kernels);
    return Status;
  }

private:
  cl_device_id DevicePointer = &Device;
  _cl_program Of{};
  SHA1_digest_t Hash{};
  void *Module = nullptr;
  unsigned char *Binary = nullptr;
  size_t BinarySize = 0;
  char *Log = nullptr;
  size_t VariableBytes = 0;
};

void build(CompilerRequest &Request, CompilerAnswer &Answer, Program &Built) {
  std::vector<_cl_program> Headers(Request.Headers.size());
  std::vector<cl_program> Pointers;
  std::vector<const char *> Names;
  for (size_t I = 0; I != Headers.size(); ++I) {
    Headers[I].source = Request.Headers[I].Text.data();
    Pointers.push_back(&Headers[I]);
    Names.push_back(Request.Headers[I].Name.c_str());
  }
  Answer.Status = pocl_llvm_build_program(
      Built.get(), 0, static_cast<cl_uint>(Headers.size()), Pointers.data(),
      Names.data(), Request.LinksLibrary);
}

bool isSpirv(std::string_view Binary) {
  const uint32_t Magic = 0x07230203;
  return Binary.size() > sizeof(Magic) &&
         !std::memcmp(Binary.data(), &Magic, sizeof(Magic));
}

void link(CompilerRequest &Request, CompilerAnswer &Answer, Program &Linked,
          const CompilerSteps &Steps) {
  std::vector<unsigned char *> Binaries;
  std::vector<size_t> Sizes;
  for (std::string &Binary : Request.Binaries) {
    if (isSpirv(Binary)) {
      Translation Made = Steps.Translate(Binary);
      if (!Made.Problem.empty()) {
        Made.Problem += '\n';
        pocl_append_to_buildlog(Linked.get(), 0, strdup(Made.Problem.c_str()),
                                Made.Problem.size());
        Answer.Status = CL_LINK_PROGRAM_FAILURE;
        return;
      }
      Binary = std::move(Made.Bitcode);
    }
    Binaries.push_back(reinterpret_cast<unsigned char *>(Binary.data()));
    Sizes.push_back(Binary.size());
  }
  Answer.Status = pocl_llvm_link_program(
      Linked.get(), 0, static_cast<cl_uint>(Binaries.size()), Binaries.data(),
      Sizes.data(), nullptr, Request.LinksLibrary, Request.IsNew);
}

void makeProgram(CompilerRequest &Request, CompilerAnswer &Answer,
                 const CompilerSteps &Steps) {
  if (!LinkContext)
    LinkContext.emplace();
  bool MayKeep = false;
  {
    Program Made(Request, *LinkContext);
    if (Request.Task == CompilerTask::Build)
      build(Request, Answer, Made);
    else
      link(Request, Answer, Made, Steps);
    Made.describe(Answer);
    if (Answer.Status == CL_SUCCESS && Request.LinksLibrary)
      Answer.Status = Made.describeKernels(Answer);
    MayKeep = Made.module() && LinkContext->hasOnlyLibraryTypes(*Made.module());
  }
  if (!MayKeep)
    LinkContext.reset();
}

void describeKernels(CompilerRequest &Request, CompilerAnswer &Answer) {
  Context Own;
  Program Of(Request, Own);
  Answer.Status = CL_INVALID_BINARY;
  if (Request.Binaries.size() != 1 || !Of.read(Request.Binaries[0]))
    return;
  Answer.Status = Of.describeKernels(Answer);
}

void makeKernelImage(CompilerRequest &Request, CompilerAnswer &Answer,
                     const CompilerSteps &Steps) {
  Context Own;
  Program Of(Request, Own);
  if (Request.Binaries.size() != 1 || !Of.read(Request.Binaries[0])) {
    Answer.Problem = "cannot make a work-group function of it";
    return;
  }
  _cl_kernel Kernel{};
  Kernel.context = Of.get()->context;
  Kernel.program = Of.get();
  Kernel.name = Request.Kernel.Name.c_str();
  _cl_command_node Command{};
  Command.device = &Device;
  _cl_command_run &Run = Command.command.run;
  Run.kernel = &Kernel;
  Run.force_large_grid_wg_func = 1;
  Run.is_range_part = Request.IsRangePart;
  for (int I = 0; I != 3; ++I) {
    Run.pc.local_size[I] = Request.Kernel.LocalSize[I];
    Run.pc.global_offset[I] = Request.HasOffset;
  }
  void *Module = nullptr;
  if (pocl_llvm_generate_workgroup_function_nowrite(
          0, &Device, &Kernel, &Command, &Module, Request.IsSpecialized) ||
      !Module) {
    Answer.Problem = "cannot make a work-group function of it";
    return;
  }
  MachineRequest ForMachine;
  Answer.Problem =
      finishKernelModule(Module, Request.Kernel, ForMachine.Bitcode);
  pocl_destroy_llvm_module(Module, Kernel.context);
  if (Request.WantsBitcode)
    Answer.Bitcode = ForMachine.Bitcode;
  if (!Answer.Problem.empty())
    return;
  ForMachine.Name = "kernel " + Request.Kernel.Name;
  ForMachine.Optimize = Request.IsOptimized;
  ForMachine.Options = Request.MachineOptions;
  ForMachine.WantsImage = Request.WantsImage;
  MachineAnswer Made = Steps.MakeImage(ForMachine);
  Answer.Image = std::move(Made.Image);
  if (Request.WantsObject)
    Answer.Object = std::move(Made.Object);
  Answer.Problem = std::move(Made.Problem);
}

void fill(CompilerRequest &Request, CompilerAnswer &Answer,
          const CompilerSteps &Steps) {
  switch (Request.Task) {
  case CompilerTask::Build:
  case CompilerTask::Link:
    makeProgram(Request, Answer, Steps);
    break;
  case CompilerTask::Kernels:
    describeKernels(Request, Answer);
    break;
  case CompilerTask::Image:
    makeKernelImage(Request, Answer, Steps);
    break;
  case CompilerTask::Triple:
    Answer.Status = Request.Binaries.size() == 1 &&
                            pocl_bitcode_is_triple(Request.Binaries[0].data(),
                                                   Request.Binaries[0].size(),
                                                   Request.Triple.c_str())
                        ? CL_SUCCESS
                        : CL_INVALID_BINARY;
    break;
  case CompilerTask::Objects: {
    MachineAnswer Made = Steps.LinkObjects(Request.Objects);
    Answer.Image = std::move(Made.Image);
    Answer.Problem = std::move(Made.Problem);
    break;
  }
  case CompilerTask::Options:
    if (!Steps.AreOptions(Request.MachineOptions))
      Answer.Problem = "cannot compile with these options";
    break;
  }
}

/// Once.
void prepare(const std::string &Root) {
  if (!DataFolder.empty())
    return;
  DataFolder = Root + "/pocl/share/pocl";
  endInOneLineWithoutMemory();
  setenv("POCL_LLVM_GLOBAL_CONTEXT", "0", 1); // each has its own
  pocl_debug_messages_setup(pocl_get_string_option("POCL_DEBUG", "0"));
}

} // namespace

std::string answerProgramRequest(
    std::string_view Text, const std::string &Root, const CompilerSteps &Steps,
    const std::function<std::string()> &TakePrinted, bool &MayStay) {
  CompilerRequest Request;
  MayStay = false;
  if (!isReadInto(Request, Text)) // it is of another version
    return {};
  prepare(Root);
  CompilerAnswer Answer;
  Device = Request.Device;
  Device.ops = operations();
  DeviceHash = Request.DeviceHash;
  DeviceOptions = Request.DeviceOptions;
  // The machine's compiler has other options of LLVM than PoCL's passes.
  llvm::cl::ResetAllOptionOccurrences();
  UnInitializeLLVM();
  InitializeLLVM();
  pocl_forget_file_problem();
  // A folder that is gone is nobody's include folder.
  [[maybe_unused]] const int Failed = chdir(Request.Folder.c_str());
  if (!Request.IsKept) // as of all requests of its program
    pocl_cache_keep_no_programs();
  if (pocl_cache_init_topdir())
    Answer.Status = CL_BUILD_PROGRAM_FAILURE;
  else
    fill(Request, Answer, Steps);
  if (const char *Problem = pocl_file_problem())
    Answer.FileProblem = Problem;
  Answer.Printed = TakePrinted();
  FieldReleaser Releaser;
  visit(Releaser, Request);
  // Options of LLVM are those of a process.
  MayStay = Request.MachineOptions.empty() && Answer.Status == CL_SUCCESS &&
            Answer.Problem.empty();
  return textOf(Answer);
}

} // namespace vorion
