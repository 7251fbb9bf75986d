#include "KernelCache.h"
#include "KernelModule.h"

extern "C" {
#include "pocl_cache.h"
#include "pocl_checked_file.h"
#include "pocl_file_util.h"
#include "pocl_llvm.h"
#include "pocl_util.h"
}

#include <CL/cl_vorion.h>
#include <vorion_abi.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace fs = std::filesystem;

namespace vorion {

namespace {

KernelDescription describe(cl_kernel Kernel, const size_t *LocalSize,
                           size_t MaxItems) {
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
  const size_t Items = LocalSize[0] * LocalSize[1] * LocalSize[2];
  D.MaxItems = Items ? Items : MaxItems;
  return D;
}

/// Another process may make the same file at the same time: each writes its own
/// and renames it.
std::string renameInto(const std::string &From, const std::string &To) {
  return pocl_rename(From.c_str(), To.c_str()) == 0
             ? std::string()
             : To + ": " + std::strerror(errno);
}

/// Puts the image that the linker left in \p From into the cache.
std::string keepImage(const std::string &From, const std::string &To) {
  char *Bytes = nullptr;
  uint64_t Size = 0;
  if (pocl_read_file(From.c_str(), &Bytes, &Size) != 0)
    return From + ": cannot be read: " + std::strerror(errno);
  const int Status = pocl_write_checked_file(To.c_str(), Bytes, Size);
  free(Bytes);
  pocl_remove(From.c_str());
  return Status == 0 ? std::string() : To + ": cannot be written";
}

/// Whether the cache has \p Path, unchanged since it was written.
bool isIntact(const std::string &Path) {
  char *Bytes = nullptr;
  uint64_t Size = 0;
  const auto Found = pocl_read_checked_file(Path.c_str(), &Bytes, &Size);
  free(Bytes);
  return Found == POCL_CHECKED_FILE_OK;
}

/// Whether \p Output of a program says that files cannot be read or written,
/// rather than what is wrong with their contents.
bool namesFiles(const std::string &Output) {
  for (const int Reason :
       {ENOSPC, EDQUOT, EFBIG, EROFS, EACCES, EIO, EMFILE, ENFILE})
    if (Output.find(std::strerror(Reason)) != std::string::npos)
      return true;
  return false;
}

} // namespace

std::string KernelCache::imagePath(_cl_command_node *Command, cl_kernel Kernel,
                                   bool Specialize) {
  // Small grids gain nothing from code of their own.
  Command->command.run.force_large_grid_wg_func = 1;
  char Path[POCL_MAX_PATHNAME_LENGTH];
  pocl_cache_final_binary_path(Path, Kernel->program, Command->program_device_i,
                               Kernel, Command, Specialize);
  return fs::path(Path)
      .replace_extension(Command->command.run.is_range_part ? ".part.elf"
                                                            : ".elf")
      .string();
}

KernelCache::Problem KernelCache::problem(_cl_command_node *Command,
                                          cl_kernel Kernel,
                                          const std::string &Text, bool Files) {
  Problem P{Text, Files};
  if (!Files)
    P.Text = std::string("kernel ") + Kernel->name + ": " + Text;
  else if (!Text.starts_with(CL_KERNEL_CACHE_PROBLEM_VORION))
    P.Text = CL_KERNEL_CACHE_PROBLEM_VORION + Text;
  const std::string Line = P.Text + "\n";
  pocl_append_to_buildlog(Kernel->program, Command->program_device_i,
                          strdup(Line.c_str()), Line.size());
  return P;
}

KernelCache::Problem KernelCache::make(_cl_command_node *Command,
                                       cl_kernel Kernel, bool Specialize,
                                       const std::string &ImagePath) {
  const unsigned DeviceIndex = Command->program_device_i;
  const std::string Base = fs::path(ImagePath).replace_extension().string();
  const std::string Own = Base + "." + std::to_string(getpid());

  const char *Options = Kernel->program->compiler_options;
  const bool Optimize = !Options || !strstr(Options, "-cl-opt-disable");

  pocl_forget_file_problem();
  std::string Text;
  void *Module = nullptr;
  if (pocl_mkdir_p(fs::path(Base).parent_path().c_str()))
    Text = "cannot make the folder of " + Base;
  else if (pocl_llvm_generate_workgroup_function_nowrite(
               DeviceIndex, Command->device, Kernel, Command, &Module,
               Specialize) ||
           !Module)
    Text = "cannot make a work-group function of it";
  if (Module) {
    const size_t AnySize[3] = {0, 0, 0};
    Text = writeKernelModule(
        Module,
        describe(Kernel,
                 Specialize ? Command->command.run.pc.local_size : AnySize,
                 Command->device->max_work_group_size),
        Own + ".bc");
    pocl_destroy_llvm_module(Module, Kernel->context);
    if (Text.empty())
      Text = ToolSet.compile(Own + ".bc", Own + ".o", Optimize);
    if (Text.empty())
      Text = ToolSet.link(Own + ".o", Own + ".elf");
    if (Text.empty())
      Text = renameInto(Own + ".o", Base + ".o");
    if (Text.empty())
      Text = keepImage(Own + ".elf", ImagePath);
    if (!pocl_get_bool_option("POCL_LEAVE_KERNEL_COMPILER_TEMP_FILES", 0))
      pocl_remove((Own + ".bc").c_str());
    if (!Text.empty()) // nothing half made stays
      for (const char *Kind : {".o", ".elf"})
        pocl_remove((Own + Kind).c_str());
  }
  if (Text.empty())
    return {};

  if (pocl_file_problem())
    return problem(Command, Kernel, pocl_file_problem(), true);
  return problem(Command, Kernel, Text, namesFiles(Text));
}

KernelCache::Problem KernelCache::compile(_cl_command_node *Command,
                                          cl_kernel Kernel, bool Specialize) {
  const std::string Path = imagePath(Command, Kernel, Specialize);
  return isIntact(Path) ? Problem() : make(Command, Kernel, Specialize, Path);
}

const LoadedKernel *KernelCache::get(_cl_command_node *Command, Problem &P,
                                     bool Specialize) {
  cl_kernel Kernel = Command->command.run.kernel;
  std::lock_guard Guard(CompileLock);
  const std::string Path = imagePath(Command, Kernel, Specialize);
  auto &Kernels = Loaded[Kernel->program].Kernels;
  if (auto Found = Kernels.find(Path); Found != Kernels.end())
    return &Found->second;

  P = compile(Command, Kernel, Specialize);
  if (!P.Text.empty())
    return nullptr;
  LoadedKernel New;
  vx_image *Image = nullptr;
  const vx_status Status = vx_image_load_file(Device, Path.c_str(), &Image);
  New.Image.reset(Image);
  New.Path = Path;
  if (Status != VX_OK ||
      vx_image_find_kernel(Image, Kernel->name, &New.Number) != VX_OK ||
      vx_image_get_kernel(Image, New.Number, &New.Info) != VX_OK) {
    P = problem(Command, Kernel, vx_last_error(), Status == VX_ERROR_FILE);
    return nullptr;
  }
  return &Kernels.emplace(Path, std::move(New)).first->second;
}

cl_ulong KernelCache::privateBytes(cl_kernel Kernel, cl_device_id Id,
                                   cl_uint Index, Problem &P) {
  const auto Needs = [](const LoadedKernel &Of) {
    return cl_ulong{Of.Info.stack_bytes} + Of.Info.context_bytes;
  };
  cl_ulong Most = 0;
  {
    std::lock_guard Guard(CompileLock);
    for (const auto &[Path, Known] : Loaded[Kernel->program].Kernels)
      if (!strcmp(Known.Info.name, Kernel->name))
        Most = std::max(Most, Needs(Known));
  }
  if (Most != 0)
    return Most;
  _cl_command_node Command{};
  Command.type = CL_COMMAND_NDRANGE_KERNEL;
  Command.device = Id;
  Command.program_device_i = Index;
  _cl_command_run &Run = Command.command.run;
  Run.kernel = Kernel;
  Run.hash = Kernel->meta->build_hash[Index];
  std::copy_n(Kernel->meta->reqd_wg_size, 3, Run.pc.local_size);
  // No code for ranges that begin at 0.
  std::fill_n(Run.pc.global_offset, 3, 1);
  const LoadedKernel *Found = get(&Command, P, Run.pc.local_size[0] != 0);
  return Found ? Needs(*Found) : 0;
}

std::optional<uint32_t> KernelCache::variables(cl_program Program,
                                               const LoadedKernel &Kernel) {
  std::lock_guard Guard(CompileLock);
  uint32_t &Address = Loaded[Program].Variables;
  if (!Address &&
      vx_variables_alloc(Kernel.Image.get(), Kernel.Number, &Address) != VX_OK)
    return std::nullopt;
  return Address;
}

void KernelCache::forget(cl_program Program) {
  std::lock_guard Guard(CompileLock);
  const auto Found = Loaded.find(Program);
  if (Found == Loaded.end())
    return;
  vx_mem_free(Device, Found->second.Variables);
  Loaded.erase(Found);
}

} // namespace vorion
