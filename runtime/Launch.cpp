/// The launch block: what the start-up code reads (docs/abi.md, "Launch block
/// and kernel table").

#include "Device.h"
#include "Limits.h"
#include "vorion_abi.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

using namespace vorion;
using namespace vorion::runtime;

namespace {

std::uint64_t product(const std::uint32_t (&Sizes)[3], std::uint64_t Limit) {
  std::uint64_t Result = 1;
  for (const std::uint32_t Size : Sizes) {
    if (Size == 0)
      return 0;
    // Saturates: no product of three 32-bit numbers may wrap.
    Result = Result > Limit ? Result : Result * Size;
  }
  return Result;
}

} // namespace

Failure runtime::checkLaunch(const isasim::Kernel &Kernel,
                             const vx_launch_params &Params,
                             std::uint32_t ArgsBytes,
                             std::uint32_t LocalBytes) {
  if (Params.work_dim < 1 || Params.work_dim > 3)
    return badArgument(
        fmt::format("work_dim is {}, expected 1 to 3", Params.work_dim));
  for (unsigned I = Params.work_dim; I < 3; ++I)
    if (Params.num_groups[I] != 1 || Params.local_size[I] != 1)
      return badArgument(
          fmt::format("dimension {} is beyond work_dim, expected "
                      "a size of 1 there",
                      I));
  const std::uint64_t Items = product(Params.local_size, MaxGroupItems);
  if (Items < 1 || Items > MaxGroupItems)
    return badArgument(fmt::format(
        "work-group of {} x {} x {} work-items, expected 1 to {} in all",
        Params.local_size[0], Params.local_size[1], Params.local_size[2],
        MaxGroupItems));
  if (product(Params.num_groups, MaxGroups) > MaxGroups)
    return badArgument(
        fmt::format("more than {} work-groups in a launch", MaxGroups));
  if (Kernel.LocalSize[0] != 0)
    for (unsigned I = 0; I < 3; ++I)
      if (Kernel.LocalSize[I] != Params.local_size[I])
        return badArgument(fmt::format(
            "kernel {} was compiled for groups of {} x {} x {}, expected these",
            Kernel.Name, Kernel.LocalSize[0], Kernel.LocalSize[1],
            Kernel.LocalSize[2]));
  if (ArgsBytes != Kernel.ArgsBytes)
    return badArgument(
        fmt::format("{} bytes of packed arguments, expected {} for kernel {}",
                    ArgsBytes, Kernel.ArgsBytes, Kernel.Name));
  if (Kernel.LocalBytes > LocalBytes)
    return {VX_ERROR_MEMORY,
            fmt::format("kernel {} uses {} bytes of local memory, the device "
                        "has {}",
                        Kernel.Name, Kernel.LocalBytes, LocalBytes)};
  return {};
}

Failure Device::prepare(const isasim::Kernel &Kernel,
                        const vx_launch_params &Params, const void *Args) {
  const std::uint64_t Items = product(Params.local_size, MaxGroupItems);
  // A core's share begins on a boundary of its own.
  const std::uint64_t Stride =
      (Kernel.contextBytesOf(Items) + VX_MEM_ALIGNMENT - 1) / VX_MEM_ALIGNMENT *
      VX_MEM_ALIGNMENT;
  if (Stride > UINT32_MAX)
    return {VX_ERROR_MEMORY,
            fmt::format("kernel {} keeps {} bytes a work-item across barriers, "
                        "too much for groups of {}",
                        Kernel.Name, Kernel.ContextBytes, Items)};
  Failure Failed =
      allocateLocked(sizeof(vx_launch), "the launch block", InUse.Launch);
  if (!Failed)
    Failed = allocateLocked(PrintBytes, "the print buffer", InUse.Print);
  if (!Failed && Kernel.ArgsBytes)
    Failed = allocateLocked(Kernel.ArgsBytes, "the arguments", InUse.Args);
  if (!Failed && Stride)
    Failed = allocateLocked(Stride * Machine->config().cores(),
                            "the memory that a kernel keeps across barriers",
                            InUse.Context);
  if (Failed)
    return Failed;

  vx_launch Block{};
  Block.entry = Kernel.Entry;
  Block.args = InUse.Args;
  Block.work_dim = Params.work_dim;
  std::copy_n(Params.num_groups, 3, Block.num_groups);
  std::copy_n(Params.local_size, 3, Block.local_size);
  std::copy_n(Params.global_offset, 3, Block.global_offset);
  Block.context = InUse.Context;
  Block.context_stride = static_cast<std::uint32_t>(Stride);
  Block.print_buffer = InUse.Print;
  Block.print_capacity = PrintBytes;
  std::memcpy(Machine->hostPointer(InUse.Launch, sizeof(Block)), &Block,
              sizeof(Block));
  Watch->written(InUse.Launch, sizeof(Block));
  if (Kernel.ArgsBytes) {
    std::memcpy(Machine->hostPointer(InUse.Args, Kernel.ArgsBytes), Args,
                Kernel.ArgsBytes);
    Watch->written(InUse.Args, Kernel.ArgsBytes);
  }
  return {};
}

void Device::finish(isasim::RunResult Run) {
  TimeText = Run.Time ? isasim::toJson(*Run.Time) : std::string();
  Last = std::move(Run);
  PrintText.clear();
  PrintDropped = 0;
  if (!InUse.Launch)
    return;
  vx_launch Block;
  std::memcpy(&Block, Machine->hostPointer(InUse.Launch, sizeof(Block)),
              sizeof(Block));
  const std::uint32_t Kept = std::min(Block.print_used, PrintBytes);
  if (Kept) {
    const std::byte *Text = Machine->hostPointer(InUse.Print, Kept);
    PrintText.assign(reinterpret_cast<const char *>(Text), Kept);
  }
  PrintDropped = Block.print_used - Kept;
}
