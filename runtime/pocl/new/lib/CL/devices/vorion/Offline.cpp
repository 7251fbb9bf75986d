/// The library as the compiler of vorion-clang (vorion_offline.h): a program is
/// built by the functions of OpenCL, in a process of which it is the only one.

#include "vorion_offline.h"

#include "Device.h"
#include "Opening.h"
#include "ProgramCompiler.h"

extern "C" {
#include "pocl_cache_folders.h"
#include "pocl_shared.h"
#include "pocl_util.h"
}

#include <CL/cl_ext.h>

#include <algorithm>
#include <vector>

using namespace vorion;

namespace {

/// Says \p What and the reason as the platform does.
std::string errorLine(const std::string &What) {
  return "vorion: error: " + What + "\n";
}

void CL_CALLBACK listen(const char *Text, const void *, size_t, void *To) {
  *static_cast<std::string *>(To) += errorLine(Text);
}

class Compiler : public OfflineCompiler {
public:
  Compiler() {
    pocl_cache_keep_no_programs();
    Tools::Listener = [this](const CompilerAnswer &Answer) {
      Log += Answer.Log;
      Printed += Answer.Printed;
    };
  }

  std::string commandLine() const override {
    return '"' + ToolSet.compiler() + "\" \"" + ServeCalls + '"';
  }

  OfflineAnswer compile(const OfflineProgram &Wanted) override {
    OfflineAnswer Answer;
    Log.clear();
    Printed.clear();
    if (openDevice())
      build(Wanted, Answer);
    Answer.Log = std::move(Log);
    Answer.Printed = std::move(Printed);
    return Answer;
  }

  std::string link(const std::vector<OfflineKernel> &Kernels,
                   std::string &Said) override {
    CompilerRequest Request;
    Request.Task = CompilerTask::Objects;
    for (const OfflineKernel &Kernel : Kernels)
      Request.Objects.push_back({Kernel.Name, Kernel.Object});
    return ask(Request, Said).Image;
  }

  bool areOptions(std::string &Said) override {
    CompilerRequest Request;
    Request.Task = CompilerTask::Options;
    ask(Request, Said);
    return Said.empty();
  }

private:
  /// The answer, or why there is none in \p Said.
  CompilerAnswer ask(CompilerRequest &Request, std::string &Said) {
    CompilerAnswer Answer;
    Printed.clear();
    if (const auto Why = ToolSet.ask(Request, Answer))
      Said = Why->message();
    else
      Said = Answer.Printed;
    return Answer;
  }

  bool openDevice() {
    if (Context)
      return true;
    cl_platform_id Platform = nullptr;
    cl_int Status = POname(clGetPlatformIDs)(1, &Platform, nullptr);
    char Reason[1024] = "";
    if (Status == CL_SUCCESS)
      Status = openDevices(Platform, 0, nullptr, sizeof(Reason), Reason);
    if (Status != CL_SUCCESS)
      Printed += errorLine(Reason);
    else
      Status = POname(clGetDeviceIDs)(Platform, CL_DEVICE_TYPE_ALL, 1, &Device,
                                      nullptr);
    if (Status == CL_SUCCESS)
      Context = POname(clCreateContext)(nullptr, 1, &Device, listen, &Printed,
                                        &Status);
    return Context != nullptr;
  }

  void build(const OfflineProgram &Wanted, OfflineAnswer &Answer) {
    cl_int Status = CL_SUCCESS;
    const char *Text = Wanted.Text.data();
    const size_t Size = Wanted.Text.size();
    cl_program Program =
        Wanted.IsSpirv
            ? POname(clCreateProgramWithIL)(Context, Text, Size, &Status)
            : POname(clCreateProgramWithSource)(Context, 1, &Text, &Size,
                                                &Status);
    if (Status != CL_SUCCESS)
      return;
    Status = POname(clBuildProgram)(Program, 0, nullptr, Wanted.Options.c_str(),
                                    nullptr, nullptr);
    Answer.IsBuilt = Status == CL_SUCCESS;
    Answer.IsWhole = Answer.IsBuilt;
    if (Answer.IsBuilt)
      for (size_t I = 0; I != Program->num_kernels; ++I)
        compileKernel(Program, Program->kernel_meta[I], Wanted, Answer);
    else if (const char *Why = Program->build_log[0])
      Printed += Why;
    POname(clReleaseProgram)(Program);
  }

  void compileKernel(cl_program Program, pocl_kernel_metadata_t &Meta,
                     const OfflineProgram &Wanted, OfflineAnswer &Answer) {
    _cl_kernel Kernel{};
    Kernel.context = Context;
    Kernel.program = Program;
    Kernel.meta = &Meta;
    Kernel.name = Meta.name;
    _cl_command_node Command{};
    Command.type = CL_COMMAND_NDRANGE_KERNEL;
    Command.device = Device;
    _cl_command_run &Run = Command.command.run;
    Run.kernel = &Kernel;
    std::copy_n(Meta.reqd_wg_size, 3, Run.pc.local_size);
    // No code for ranges that begin at 0.
    std::fill_n(Run.pc.global_offset, 3, 1);
    CompilerRequest Request = requestFor(Program, 0, CompilerTask::Image);
    Request.WantsImage = false;
    Request.WantsObject = true;
    Request.WantsBitcode = Wanted.WantsBitcode;
    CompilerAnswer Made;
    const auto Problem = deviceOf(Device).Kernels.ask(
        &Command, &Kernel, Meta.reqd_wg_size[0] != 0, Request, Made);
    if (Problem.Text.empty()) {
      Answer.Kernels.push_back(
          {Meta.name, std::move(Made.Object), std::move(Made.Bitcode)});
    } else {
      Printed += errorLine(Problem.Text);
      Answer.IsWhole = false;
    }
  }

  Tools ToolSet;
  cl_device_id Device = nullptr;
  cl_context Context = nullptr;
  std::string Log, Printed; ///< of the present program
};

} // namespace

extern "C" __attribute__((visibility("default"))) OfflineCompiler *
vorion_offline_compiler() {
  static Compiler Only;
  return &Only;
}
