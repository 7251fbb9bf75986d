#include "vorion/isasim/Launch.h"

#include "core/IsaTables.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/MemoryMap.h"
#include "vorion/isasim/Session.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

Error badShape(std::string What) {
  return {"", std::move(What), ExitCode::Usage};
}

Error noMemory(std::string What) {
  return {"", std::move(What), ExitCode::LimitReached};
}

Error noLocalMemory(const std::string &Name, uint64_t Capacity) {
  return noMemory(fmt::format(
      "kernel {} needs more than {} bytes of local memory", Name, Capacity));
}

Error noStacks(const Kernel &K, uint64_t Stacks) {
  std::string All =
      Stacks ? fmt::format(", {} with those of all lanes that run it", Stacks)
             : "";
  return noMemory(fmt::format("kernel {} needs a stack of {} bytes for each "
                              "work-item{}, expected room for them",
                              K.Name, K.StackBytes, All));
}

/// Above \p Limit if it is more: no product of three 32-bit numbers may wrap.
uint64_t product(const std::array<uint32_t, 3> &Sizes, uint64_t Limit) {
  if (std::ranges::count(Sizes, 0U))
    return 0;
  uint64_t Result = 1;
  for (const uint32_t Size : Sizes)
    Result = Result > Limit ? Result : Result * Size;
  return Result;
}

Expected<Success> check(const Kernel &K, const LaunchShape &S) {
  if (S.WorkDim < 1 || S.WorkDim > 3)
    return badShape(fmt::format("work_dim is {}, expected 1 to 3", S.WorkDim));
  for (unsigned I = S.WorkDim; I < 3; ++I)
    if (S.NumGroups[I] != 1 || S.LocalSize[I] != 1)
      return badShape(fmt::format(
          "dimension {} exceeds work_dim, expected a size of 1", I));
  const uint64_t Items = product(S.LocalSize, MaxGroupItems);
  if (Items < 1 || Items > MaxGroupItems)
    return badShape(fmt::format(
        "work-group of {} x {} x {} work-items, expected 1 to {} in total",
        S.LocalSize[0], S.LocalSize[1], S.LocalSize[2], MaxGroupItems));
  if (product(S.NumGroups, MaxGroups) > MaxGroups)
    return badShape(
        fmt::format("more than {} work-groups in a launch", MaxGroups));
  if (K.LocalSize[0] != 0 && K.LocalSize != S.LocalSize)
    return badShape(fmt::format("kernel {} was compiled for groups of {} x {} "
                                "x {}, expected this work-group size",
                                K.Name, K.LocalSize[0], K.LocalSize[1],
                                K.LocalSize[2]));
  return Success{};
}

template <typename T> std::span<std::byte> bytesOf(T &Value) {
  return std::as_writable_bytes(std::span(&Value, 1));
}

/// What \p S is a part of, perhaps all.
WholeRange rangeOf(const LaunchShape &S) {
  if (S.PartOf)
    return *S.PartOf;
  WholeRange R{.EnqueuedSize = S.LocalSize, .AllGroups = S.NumGroups};
  for (unsigned I = 0; I != 3; ++I)
    R.GlobalSize[I] = S.LocalSize[I] * S.NumGroups[I];
  return R;
}

/// The warps of a core that take part: as many as there are groups for, and
/// parts of local memory of \p Stride bytes.
uint32_t warpsFor(const Kernel &K, const LaunchShape &S, uint64_t Stride,
                  const Config &C) {
  if (!K.SharesCore || !S.LocalBytes)
    return 1;
  const uint64_t Groups = product(S.NumGroups, MaxGroups);
  const uint64_t Useful = (Groups + C.cores() - 1) / C.cores();
  const uint64_t Fit = Stride ? C.LocalBytes / Stride : C.WarpsPerCore;
  return static_cast<uint32_t>(
      std::clamp<uint64_t>(std::min(Useful, Fit), 1, C.WarpsPerCore));
}

uint32_t address(uint64_t Part) { return static_cast<uint32_t>(Part); }

} // namespace

Expected<Launch> Launch::plan(const Kernel &K, const LaunchShape &S,
                              const Config &C) {
  if (const Expected<Success> Ok = check(K, S); !Ok)
    return Ok.error();
  if (K.LocalBytes > C.LocalBytes)
    return noLocalMemory(K.Name, C.LocalBytes);
  const uint64_t Items = product(S.LocalSize, MaxGroupItems);
  // A core's share begins on a boundary of its own.
  const uint64_t Stride = alignLaunch(K.contextBytesOf(Items));
  if (Stride > UINT32_MAX)
    return noMemory(fmt::format("kernel {} saves {} bytes per work-item across "
                                "barriers, too much for groups of {}",
                                K.Name, K.ContextBytes, Items));
  Launch L(K, S);
  L.ContextStride = static_cast<uint32_t>(Stride);
  L.Cores = C.cores();
  L.LocalStride =
      static_cast<uint32_t>(alignLaunch(S.LocalBytes.value_or(K.LocalBytes)));
  L.Warps = warpsFor(K, S, L.LocalStride, C);
  L.StackBytes = stackFor(K.StackBytes, C);
  if (L.StackBytes == 0)
    return noStacks(K, 0);
  const auto AllStacks = [&] {
    return stackBytes(C, L.StackBytes, L.Warps, S.NumGroups);
  };
  constexpr uint64_t MostStacks = VX_STACK_TOP - VX_HIGH_BASE;
  while (L.Warps > 1 && AllStacks() > MostStacks)
    --L.Warps;
  const uint64_t Stacks = AllStacks();
  if (Stacks > MostStacks)
    return noStacks(K, Stacks);
  L.StacksBegin = VX_STACK_TOP - Stacks;
  const AddressRange High = globalRanges(C)[1];
  const uint64_t HighEnd = High.Base + High.Bytes;
  L.BytesUnderStacks = HighEnd - std::min(HighEnd, L.StacksBegin);
  L.Bytes = {.Block = sizeof(VxLaunch) * L.Warps,
             .Args = K.ArgsBytes,
             .Context = Stride * C.cores() * L.Warps,
             .Print = PrintBytes,
             .Variables = bytesFor(K.Variables)};
  return L;
}

void Launch::write(Machine &M, Session &Watch, const LaunchParts &Addresses,
                   std::span<const std::byte> Args) const {
  VxLaunch Block{};
  Block.Entry = Entry;
  Block.Args = address(Addresses.Args);
  Block.WorkDim = Shape.WorkDim;
  std::ranges::copy(Shape.NumGroups, Block.NumGroups);
  std::ranges::copy(Shape.LocalSize, Block.LocalSize);
  std::ranges::copy(Shape.GlobalOffset, Block.GlobalOffset);
  Block.ContextStride = ContextStride;
  Block.PrintBuffer = address(Addresses.Print);
  Block.PrintCapacity = PrintBytes - sizeof(VxPrint);
  Block.StackBytes = StackBytes;
  Block.Variables = address(Addresses.Variables);
  const WholeRange Range = rangeOf(Shape);
  std::ranges::copy(Range.EnqueuedSize, Block.EnqueuedSize);
  std::ranges::copy(Range.GroupsBefore, Block.GroupsBefore);
  std::ranges::copy(Range.AllGroups, Block.AllGroups);
  std::ranges::copy(Range.GlobalSize, Block.GlobalSize);
  Block.Warps = Warps;
  Block.LocalStride = LocalStride;
  for (uint32_t W = 0; W != Warps; ++W) {
    Block.Context =
        address(Addresses.Context + uint64_t{W} * Cores * ContextStride);
    M.write(address(Addresses.Block + W * sizeof(Block)), bytesOf(Block));
  }
  Watch.hostWrote(address(Addresses.Block), Bytes.Block);
  VxPrint Print{};
  M.write(Block.PrintBuffer, bytesOf(Print));
  Watch.hostWrote(Block.PrintBuffer, sizeof(Print));
  if (Args.empty())
    return;
  M.write(address(Addresses.Args), Args);
  Watch.hostWrote(address(Addresses.Args), Args.size());
}

uint64_t bytesFor(const ProgramVariables &V) {
  const uint64_t Room =
      V.Alignment > LaunchAlignment ? V.Alignment - LaunchAlignment : 0;
  return V.Bytes + Room;
}

uint32_t placeOf(const ProgramVariables &V, uint32_t Address) {
  return (Address + V.Alignment - 1) / V.Alignment * V.Alignment;
}

void writeVariables(Machine &M, Session &Watch, const Image &Program,
                    const Kernel &K, uint32_t Place) {
  const ProgramVariables &V = K.Variables;
  std::byte *const Bytes = M.hostPointer(Place, V.Bytes);
  std::memset(Bytes, 0, V.Bytes);
  std::ranges::copy(Program.bytesAt(V.Contents, V.ContentsBytes), Bytes);
  const auto Pointers =
      Program.bytesAt(V.Pointers, V.NumPointers * uint32_t{sizeof(uint32_t)});
  for (size_t At = 0; At != Pointers.size(); At += sizeof(uint32_t)) {
    uint32_t Offset = 0, Value = 0;
    std::memcpy(&Offset, &Pointers[At], sizeof(Offset));
    std::memcpy(&Value, Bytes + Offset, sizeof(Value));
    Value += Place;
    std::memcpy(Bytes + Offset, &Value, sizeof(Value));
  }
  Watch.hostWrote(Place, V.Bytes);
}

Printed printedBy(Machine &M, const LaunchParts &Addresses) {
  VxPrint Print{};
  M.read(address(Addresses.Print), bytesOf(Print));
  const auto Kept =
      std::min<uint32_t>(Print.Used, PrintBytes - sizeof(VxPrint));
  Printed P{.Text = std::string(Kept, '\0'), .Dropped = Print.Used - Kept};
  M.read(address(Addresses.Print + sizeof(VxPrint)),
         std::as_writable_bytes(std::span(P.Text)));
  return P;
}

Expected<uint32_t> LocalPlaces::place(uint64_t Bytes) {
  const uint64_t Begin = alignLaunch(End);
  if (Begin > Capacity || Bytes > Capacity - Begin)
    return noLocalMemory(Name, Capacity);
  End = Begin + Bytes;
  return static_cast<uint32_t>(VX_LOCAL_BASE + Begin);
}

} // namespace vorion::isasim
