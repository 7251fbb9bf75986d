#include "KernelCache.h"
#include "ProgramCompiler.h"

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

/// Puts \p Bytes into the cache. Empty on success.
std::string keep(const std::string &Path, const std::string &Bytes) {
  return pocl_write_checked_file(Path.c_str(), Bytes.data(), Bytes.size()) == 0
             ? std::string()
             : Path + ": cannot be written";
}

/// Writes \p Bytes for who asked for more than the image.
std::string leave(const std::string &Path, const std::string &Bytes) {
  return pocl_write_file(Path.c_str(), Bytes.data(), Bytes.size(), 0) == 0
             ? std::string()
             : Path + ": cannot be written";
}

/// Whether the cache has \p Path, unchanged since it was written.
bool isIntact(const std::string &Path) {
  char *Bytes = nullptr;
  uint64_t Size = 0;
  const auto Found = pocl_read_checked_file(Path.c_str(), &Bytes, &Size);
  free(Bytes);
  return Found == POCL_CHECKED_FILE_OK;
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
                                          cl_kernel Kernel, std::string Text,
                                          Problem::Cause Of) {
  if (pocl_file_problem()) {
    Text = pocl_file_problem();
    Of = Problem::Cause::Files;
  }
  Problem P{Text, Of};
  if (Of != Problem::Cause::Files)
    P.Text = std::string("kernel ") + Kernel->name + ": " + Text;
  else if (!Text.starts_with(CL_KERNEL_CACHE_PROBLEM_VORION))
    P.Text = CL_KERNEL_CACHE_PROBLEM_VORION + Text;
  const std::string Line = P.Text + "\n";
  pocl_append_to_buildlog(Kernel->program, Command->program_device_i,
                          strdup(Line.c_str()), Line.size());
  return P;
}

KernelCache::Problem KernelCache::ask(_cl_command_node *Command,
                                      cl_kernel Kernel, bool Specialize,
                                      CompilerRequest &Request,
                                      CompilerAnswer &Answer) {
  const char *Options = Kernel->program->compiler_options;
  const _cl_command_run &Run = Command->command.run;
  constexpr size_t AnySize[3] = {0, 0, 0};
  Request.Kernel = describe(Kernel, Specialize ? Run.pc.local_size : AnySize,
                            Command->device->max_work_group_size);
  Request.IsSpecialized = Specialize;
  Request.HasOffset =
      std::any_of(Run.pc.global_offset, Run.pc.global_offset + 3,
                  [](size_t Offset) { return Offset != 0; });
  Request.IsRangePart = Run.is_range_part;
  Request.IsOptimized = !Options || !strstr(Options, "-cl-opt-disable");

  std::string Text;
  Problem::Cause Of = Problem::Cause::Kernel;
  if (const auto Why = ToolSet.ask(Request, Answer)) {
    Text = Why->message();
    if (Why->LackedResources)
      Of = Problem::Cause::Resources;
  } else if (!Answer.Problem.empty()) {
    Text = Answer.Problem + "\n" + Answer.Printed;
  }
  return Text.empty() ? Problem() : problem(Command, Kernel, Text, Of);
}

KernelCache::Problem KernelCache::make(_cl_command_node *Command,
                                       cl_kernel Kernel, bool Specialize,
                                       const std::string &ImagePath) {
  const std::string Base = fs::path(ImagePath).replace_extension().string();
  CompilerRequest Request = requestFor(
      Kernel->program, Command->program_device_i, CompilerTask::Image);
  Request.WantsBitcode =
      pocl_get_bool_option("POCL_LEAVE_KERNEL_COMPILER_TEMP_FILES", 0);

  pocl_forget_file_problem();
  if (pocl_mkdir_p(fs::path(Base).parent_path().c_str()))
    return problem(Command, Kernel, "cannot make the folder of " + Base,
                   Problem::Cause::Kernel);
  CompilerAnswer Answer;
  if (Problem P = ask(Command, Kernel, Specialize, Request, Answer);
      !P.Text.empty())
    return P;
  std::string Text;
  if (Request.WantsBitcode)
    Text = leave(Base + ".bc", Answer.Bitcode);
  if (Text.empty())
    Text = keep(ImagePath, Answer.Image);
  return Text.empty() ? Problem()
                      : problem(Command, Kernel, Text, Problem::Cause::Kernel);
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
  pocl_forget_file_problem();
  LoadedKernel New;
  vx_image *Image = nullptr;
  const vx_status Status = vx_image_load_file(Device, Path.c_str(), &Image);
  New.Image.reset(Image);
  New.Path = Path;
  if (Status != VX_OK ||
      vx_image_find_kernel(Image, Kernel->name, &New.Number) != VX_OK ||
      vx_image_get_kernel(Image, New.Number, &New.Info) != VX_OK) {
    P = problem(Command, Kernel, vx_last_error(),
                Status == VX_ERROR_FILE ? Problem::Cause::Files
                                        : Problem::Cause::Kernel);
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
