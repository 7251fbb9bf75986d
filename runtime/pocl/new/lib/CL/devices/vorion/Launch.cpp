#include "Launch.h"
#include "Capture.h"
#include "Event.h"
#include "Images.h"
#include "Messages.h"
#include "RangeParts.h"

extern "C" {
#include "pocl_util.h"
}

#include <vorion_abi.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstring>

namespace vorion {

namespace {

/// Fails one command.
struct Failing {
  const _cl_command_node &Command;

  cl_int with(cl_int Status, const std::string &Text) const {
    tellFailure(Command.sync.event.event->context, Status, Text);
    return Status;
  }
  /// \p Text is about the command's kernel, which it may begin with.
  cl_int kernel(cl_int Status, const std::string &Text) const {
    const std::string Name =
        std::string("kernel ") + Command.command.run.kernel->name;
    return with(Status,
                Text.starts_with(Name + ' ') ? Text : Name + ": " + Text);
  }
};

/// The address that a pointer argument stands for, 0 for a null pointer.
uint32_t deviceAddress(const pocl_argument &Argument, cl_device_id Device) {
  if (!Argument.value)
    return 0;
  cl_mem Buffer;
  memcpy(&Buffer, Argument.value, sizeof(Buffer));
  if (!Buffer)
    return 0;
  const void *Address = Buffer->device_ptrs[Device->global_mem_id].device_addr;
  return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(Address) +
                               Argument.offset);
}

/// What the launches of a command took together.
struct Total {
  vx_counters Counters{};
  std::string TimeReport; ///< of the last
  double DeviceSeconds = 0;

  void add(const vx_result &Result) {
    using Words = std::array<uint64_t, sizeof(vx_counters) / sizeof(uint64_t)>;
    auto Sum = std::bit_cast<Words>(Counters);
    const auto More = std::bit_cast<Words>(Result.counters);
    for (size_t I = 0; I < Sum.size(); ++I)
      Sum[I] += More[I];
    Counters = std::bit_cast<vx_counters>(Sum);
    TimeReport = Result.time_report;
    DeviceSeconds += Result.device_seconds;
  }
};

/// One launch, of the whole range if \p Whole is null.
cl_int runPart(vx_device *Device, KernelCache &Kernels,
               _cl_command_node *Command, const LoadedKernel *Kernel,
               const vx_whole_range *Whole, Total &Took) {
  _cl_command_run &Run = Command->command.run;
  const pocl_context &Grid = Run.pc;
  const Failing Fail{*Command};
  const pocl_kernel_metadata_t &Meta = *Run.kernel->meta;
  std::vector<unsigned char> Packed(Kernel->Info.args_bytes);
  std::vector<uint64_t> LocalSizes;
  ImageDescriptions Images(Device);
  for (unsigned I = 0; I < Meta.num_args; ++I) {
    vx_arg_info Info;
    if (vx_image_get_arg(Kernel->Image.get(), Kernel->Number, I, &Info) !=
        VX_OK)
      return Fail.kernel(CL_INVALID_KERNEL_ARGS, vx_last_error());
    pocl_argument &Argument = Run.arguments[I];
    const pocl_argument_type Type = Meta.arg_info[I].type;
    if (Info.kind == VX_ARG_LOCAL) {
      LocalSizes.push_back(Argument.size);
    } else if (Info.kind == VX_ARG_GLOBAL) {
      const uint32_t Address = deviceAddress(Argument, Command->device);
      memcpy(&Packed[Info.offset], &Address, sizeof(Address));
    } else if (Type == POCL_ARG_TYPE_IMAGE) {
      const auto Address = Images.add(Argument, Command->device);
      if (!Address)
        return Fail.kernel(CL_MEM_OBJECT_ALLOCATION_FAILURE, vx_last_error());
      memcpy(&Packed[Info.offset], &*Address, sizeof(*Address));
    } else if (Type == POCL_ARG_TYPE_SAMPLER) {
      const uint32_t Value = samplerValue(Argument);
      memcpy(&Packed[Info.offset], &Value, sizeof(Value));
    } else if (Argument.value) {
      // A vector of three elements is set with the size of four.
      memcpy(&Packed[Info.offset], Argument.value,
             std::min<size_t>(Info.size, Argument.size));
    }
  }
  vx_launch_params Params{};
  vx_status Status = vx_image_place_locals(Kernel->Image.get(), Kernel->Number,
                                           LocalSizes.data(), LocalSizes.size(),
                                           Packed.data(), &Params.local_bytes);
  if (Status != VX_OK)
    return Fail.kernel(CL_OUT_OF_RESOURCES, vx_last_error());

  Params.work_dim = Grid.work_dim;
  for (int I = 0; I < 3; ++I) {
    Params.num_groups[I] = Grid.num_groups[I];
    Params.local_size[I] = Grid.local_size[I];
    Params.global_offset[I] = Grid.global_offset[I];
  }
  Params.part_of = Whole;
  if (Kernel->Info.variables_bytes) {
    const auto Address = Kernels.variables(Run.kernel->program, *Kernel);
    if (!Address)
      return Fail.kernel(CL_MEM_OBJECT_ALLOCATION_FAILURE, vx_last_error());
    Params.variables = *Address;
  }
  captureLaunch(*Kernel, *Command);
  const cl_command_queue Queue = Command->sync.event.event->queue;
  vx_device_set_profiled(Device,
                         (Queue->properties & CL_QUEUE_PROFILING_ENABLE) != 0);
  vx_result Result;
  Status = vx_start(Device, Kernel->Image.get(), Kernel->Number, &Params,
                    Packed.data(), Packed.size());
  if (Status == VX_OK)
    Status = vx_wait(Device, &Result);
  if (Status != VX_OK)
    return Fail.kernel(CL_OUT_OF_RESOURCES, vx_last_error());

  if (Result.print_bytes) {
    fwrite(Result.print_text, 1, Result.print_bytes, stdout);
    fflush(stdout);
  }
  if (Result.print_dropped)
    fprintf(stderr,
            "vorion: warning: kernel %s: the print buffer is full, %llu bytes "
            "of printf were dropped\n",
            Run.kernel->name,
            static_cast<unsigned long long>(Result.print_dropped));
  if (Result.outcome != VX_OUTCOME_DONE) {
    const std::string Exit =
        "ended with exit code " + std::to_string(Result.exit_code);
    return Fail.kernel(CL_OUT_OF_RESOURCES, Result.outcome == VX_OUTCOME_EXIT
                                                ? Exit.c_str()
                                                : Result.report);
  }
  Took.add(Result);
  return CL_SUCCESS;
}

} // namespace

cl_int runKernel(vx_device *Device, KernelCache &Kernels,
                 _cl_command_node *Command) {
  _cl_command_run &Run = Command->command.run;
  // A range without items is done as it is.
  if (std::find(Run.pc.num_groups, Run.pc.num_groups + 3, 0U) !=
      Run.pc.num_groups + 3) {
    pocl_update_event_running(Command->sync.event.event);
    return CL_SUCCESS;
  }

  const std::vector<RangePart> Parts = partsOf(Run);
  std::vector<const LoadedKernel *> Loaded;
  for (const RangePart &Part : Parts) {
    const PartGuard Guard(Run, Part);
    KernelCache::Problem Problem;
    Loaded.push_back(Kernels.get(Command, Problem));
    if (!Loaded.back())
      return Failing{*Command}.with(Problem.status(), Problem.Text);
  }
  // What the event says of its time is without the compilation.
  pocl_update_event_running(Command->sync.event.event);
  Total Took;
  for (size_t I = 0; I < Parts.size(); ++I) {
    const PartGuard Guard(Run, Parts[I]);
    if (const cl_int Status =
            runPart(Device, Kernels, Command, Loaded[I], Guard.whole(), Took);
        Status != CL_SUCCESS)
      return Status;
  }
  if (EventData *Data = eventData(Command->sync.event.event)) {
    Data->Counters = Took.Counters;
    Data->TimeReport = Took.TimeReport;
    Data->DeviceSeconds = Took.DeviceSeconds;
  }
  return CL_SUCCESS;
}

} // namespace vorion
