#include "KernelCache.h"
#include "KernelModule.h"

extern "C" {
#include "pocl_cache.h"
#include "pocl_file_util.h"
#include "pocl_llvm.h"
#include "pocl_util.h"
}

#include <vorion_abi.h>

#include <cstring>
#include <filesystem>

namespace fs = std::filesystem;

namespace vorion {

namespace {

KernelDescription describe(cl_kernel Kernel, const size_t *LocalSize) {
  KernelDescription D;
  D.Name = Kernel->name;
  const pocl_kernel_metadata_t &Meta = *Kernel->meta;
  for (unsigned I = 0; I < Meta.num_args; ++I) {
    const pocl_argument_info &Info = Meta.arg_info[I];
    uint32_t Kind = VX_ARG_VALUE;
    if (ARG_IS_LOCAL(Info))
      Kind = VX_ARG_LOCAL;
    else if (Info.type == POCL_ARG_TYPE_POINTER)
      Kind = VX_ARG_GLOBAL;
    D.Arguments.push_back({Info.name ? Info.name : "", Kind});
  }
  for (int I = 0; I < 3; ++I)
    D.LocalSize[I] = LocalSize[I];
  return D;
}

/// Another process may make the same file at the same time: each writes its own
/// and renames it.
std::string renameInto(const std::string &From, const std::string &To) {
  std::error_code Error;
  fs::rename(From, To, Error);
  return Error ? To + ": " + Error.message() : std::string();
}

} // namespace

std::string KernelCache::compile(_cl_command_node *Command, cl_kernel Kernel,
                                 bool Specialize, std::string &ImagePath) {
  // Small grids gain nothing from code of their own.
  Command->command.run.force_large_grid_wg_func = 1;
  const unsigned DeviceIndex = Command->program_device_i;
  char Path[POCL_MAX_PATHNAME_LENGTH];
  pocl_cache_final_binary_path(Path, Kernel->program, DeviceIndex, Kernel,
                               Command, Specialize);
  const std::string Base = fs::path(Path).replace_extension().string();
  ImagePath = Base + ".elf";
  if (pocl_exists(ImagePath.c_str()))
    return {};

  const auto Fail = [&](std::string Text) {
    char *Log = strdup((Text + "\n").c_str());
    pocl_append_to_buildlog(Kernel->program, DeviceIndex, Log, strlen(Log));
    return Text;
  };
  if (pocl_mkdir_p(fs::path(Base).parent_path().c_str()))
    return Fail("cannot make the folder of " + Base);

  void *Module = nullptr;
  if (pocl_llvm_generate_workgroup_function_nowrite(
          DeviceIndex, Command->device, Kernel, Command, &Module, Specialize) ||
      !Module)
    return Fail(std::string("cannot make a work-group function of ") +
                Kernel->name);
  const size_t AnySize[3] = {0, 0, 0};
  const std::string Own = Base + "." + std::to_string(getpid());
  std::string Problem = writeKernelModule(
      Module,
      describe(Kernel,
               Specialize ? Command->command.run.pc.local_size : AnySize),
      Own + ".bc");
  pocl_destroy_llvm_module(Module, Kernel->context);
  if (Problem.empty())
    Problem = ToolSet.compile(Own + ".bc", Own + ".o");
  if (Problem.empty())
    Problem = ToolSet.link(Own + ".o", Own + ".elf");
  const bool Keep =
      pocl_get_bool_option("POCL_LEAVE_KERNEL_COMPILER_TEMP_FILES", 0);
  if (!Keep)
    pocl_remove((Own + ".bc").c_str());
  for (const char *Kind : {".o", ".elf"})
    if (Problem.empty())
      Problem = renameInto(Own + Kind, Base + Kind);
  if (!Problem.empty())
    return Fail(std::string("kernel ") + Kernel->name + ": " + Problem);
  return {};
}

const LoadedKernel *KernelCache::get(_cl_command_node *Command,
                                     std::string &Problem) {
  cl_kernel Kernel = Command->command.run.kernel;
  std::lock_guard Guard(CompileLock);
  std::string Path;
  Problem = compile(Command, Kernel, true, Path);
  if (!Problem.empty())
    return nullptr;
  auto &Kernels = Loaded[Kernel->program];
  if (auto Found = Kernels.find(Path); Found != Kernels.end())
    return &Found->second;

  LoadedKernel New;
  vx_image *Image = nullptr;
  if (vx_image_load_file(Device, Path.c_str(), &Image) != VX_OK) {
    Problem = vx_last_error();
    return nullptr;
  }
  New.Image.reset(Image);
  New.Path = Path;
  if (vx_image_find_kernel(Image, Kernel->name, &New.Number) != VX_OK ||
      vx_image_get_kernel(Image, New.Number, &New.Info) != VX_OK) {
    Problem = vx_last_error();
    return nullptr;
  }
  return &Kernels.emplace(Path, std::move(New)).first->second;
}

void KernelCache::forget(cl_program Program) {
  std::lock_guard Guard(CompileLock);
  Loaded.erase(Program);
}

} // namespace vorion
