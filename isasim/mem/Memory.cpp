#include "mem/Memory.h"

#include "core/IsaTables.h"
#include "vorion/isasim/Launch.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>
#include <utility>

namespace vorion::isasim {

namespace {

/// A vector access that begins inside a region may read (never write) this far
/// beyond its end.
constexpr uint64_t Slack = 4096;

/// [Address, Address + Bytes), or nullptr if it is not all in the region.
std::byte *rangeAt(const Region &R, uint32_t Address, uint64_t Bytes) {
  const uint64_t Offset = uint64_t{Address} - R.Lo;
  return Address >= R.Lo && Offset <= R.Bytes && Bytes <= R.Bytes - Offset
             ? R.Host + Offset
             : nullptr;
}

/// On the host stacks come in whole groups of StackGroup.
uint64_t onHost(uint64_t Stacks, uint32_t StackBytes) {
  const uint64_t Group = StackGroup * uint64_t{StackBytes};
  return (Stacks + Group - 1) / Group * Group;
}

unsigned shiftOf(uint32_t StackBytes) {
  return static_cast<unsigned>(std::countr_zero(StackBytes));
}

/// Appends what of \p Part lies outside of \p ReadOnly.
void addWritable(const Region &Part, std::span<const AddressRange> ReadOnly,
                 std::vector<Region> &Pieces) {
  uint64_t From = Part.Lo;
  const uint64_t End = From + Part.Bytes;
  const auto Add = [&](uint64_t To) {
    if (To > From)
      Pieces.push_back({static_cast<uint32_t>(From),
                        static_cast<uint32_t>(To - From),
                        Part.at(static_cast<uint32_t>(From))});
  };
  for (const AddressRange &R : ReadOnly) {
    if (R.Base < From || R.Base >= End)
      continue;
    Add(R.Base);
    From = std::min(R.Base + R.Bytes, End);
  }
  Add(End);
}

} // namespace

Expected<Mapping> Mapping::make(uint64_t Bytes) {
  const uint64_t Page = static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
  const uint64_t Guard = std::max(Page, Slack);
  const uint64_t Whole = (Bytes + Page - 1) / Page * Page;
  const uint64_t All = Guard + Whole + 2 * Guard;
  void *At = mmap(nullptr, All, PROT_NONE,
                  MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  auto *Base = static_cast<std::byte *>(At);
  if (At == MAP_FAILED ||
      mprotect(Base + Guard, Whole, PROT_READ | PROT_WRITE) != 0 ||
      mprotect(Base + Guard + Whole, Guard, PROT_READ) != 0) {
    const int Cause = errno;
    if (At != MAP_FAILED)
      munmap(At, All);
    return Error{"",
                 fmt::format("cannot map {} bytes of device memory: {}, "
                             "expected a host with enough memory",
                             Bytes, std::strerror(Cause)),
                 ExitCode::LimitReached};
  }
  return Mapping(Base, All, Base + Guard);
}

Mapping::Mapping(Mapping &&Other) noexcept
    : Base(std::exchange(Other.Base, nullptr)), All(Other.All),
      Start(Other.Start) {}

Mapping::~Mapping() {
  if (Base)
    munmap(Base, All);
}

Memory::Memory(std::vector<Mapping> Maps) : Mappings(std::move(Maps)) {}

Expected<std::unique_ptr<Memory>> Memory::create(const Config &C) {
  const auto StackBytes = static_cast<uint32_t>(stackBytes(C));
  const auto [Low, High] = globalRanges(C);
  std::vector<AddressRange> Wanted = {Low,
                                      {VX_STACK_TOP - StackBytes, StackBytes},
                                      {VX_IMAGE_BASE, VX_IMAGE_SIZE}};
  for (unsigned Core = 0; Core != C.cores(); ++Core)
    Wanted.push_back({VX_LOCAL_BASE, C.LocalBytes});
  if (High.Bytes)
    Wanted.push_back(High);

  const uint64_t StackBytesOnHost = onHost(StackBytes, C.StackBytes);
  std::vector<Mapping> Maps;
  std::vector<Region> Regions;
  for (const auto &[Lo, Bytes] : Wanted) {
    const bool IsStack = Lo == VX_STACK_TOP - StackBytes;
    Expected<Mapping> M = Mapping::make(IsStack ? StackBytesOnHost : Bytes);
    if (!M)
      return M.error();
    // Buffers are walked at strides that leave no page's translation in the
    // host's TLB: project.cl reads 59 planes of a scene at a time. Hosts that
    // have no large pages say no.
    if (Lo == Low.Base || Lo == High.Base)
      madvise(M->data(), Bytes, MADV_HUGEPAGE);
    Regions.push_back({Lo, static_cast<uint32_t>(Bytes), M->data()});
    Maps.push_back(std::move(*M));
  }
  std::unique_ptr<Memory> Result(new Memory(std::move(Maps)));
  Result->Global = Regions[0];
  Result->OwnStack = Regions[1];
  Result->StackBytesOnHost = StackBytesOnHost;
  Result->ImageRange = Regions[2];
  Result->OwnStackShift = shiftOf(C.StackBytes);
  Result->Locals.assign(Regions.begin() + 3, Regions.begin() + 3 + C.cores());
  Result->High = High.Bytes ? Regions.back() : Result->Global;
  Result->endRun();
  return Result;
}

Expected<Success> Memory::beginRun(const RunMemory &Run) {
  endRun();
  if (shiftOf(Run.StackBytes) != OwnStackShift) {
    Expected<Mapping> Large = Mapping::make(onHost(Run.Stacks, Run.StackBytes));
    if (!Large)
      return Large.error();
    LargeStacks.emplace(std::move(*Large));
    const auto Bytes = static_cast<uint32_t>(Run.Stacks);
    Stack = {VX_STACK_TOP - Bytes, Bytes, LargeStacks->data()};
    StackShift = shiftOf(Run.StackBytes);
  }
  constexpr size_t MaxReadOnly = std::size(MemoryView().Rest);
  for (const AddressRange &R : Run.ReadOnly)
    if (R.Bytes && R.Base % LaunchAlignment == 0 &&
        R.Bytes % LaunchAlignment == 0 && global(R.Base, R.Bytes) &&
        ReadOnly.size() != MaxReadOnly)
      ReadOnly.push_back(R);
  std::ranges::sort(ReadOnly, {}, &AddressRange::Base);
  return Success{};
}

void Memory::endRun() {
  Stack = OwnStack;
  StackShift = OwnStackShift;
  LargeStacks.reset();
  ReadOnly.clear();
}

MemoryView Memory::view(unsigned Core) const {
  MemoryView V;
  // Stacks that are larger than the machine's cover some of it.
  Region Behind = High;
  if (High.Host != Global.Host)
    Behind.Bytes = std::min(High.Bytes, Stack.Lo - std::min(Stack.Lo, High.Lo));
  std::vector<Region> Pieces;
  addWritable(Global, ReadOnly, Pieces);
  const size_t Front = Pieces.size();
  if (High.Host != Global.Host)
    addWritable(Behind, ReadOnly, Pieces);
  V.Global = Pieces.empty() ? Global : Pieces.front();
  V.High = Front < Pieces.size() ? Pieces[Front] : V.Global;
  std::ranges::fill(V.Rest, V.Global);
  Region *Rest = V.Rest;
  for (size_t N = 1; N < Pieces.size(); ++N)
    if (N != Front)
      *Rest++ = Pieces[N];
  V.Whole[0] = Global;
  V.Whole[1] = Behind.Bytes ? Behind : Global;
  V.Local = Locals[Core];
  V.Stack = Stack;
  V.Image = ImageRange;
  V.StackShift = StackShift;
  V.ImageWritable = Writable.data();
  V.NumImageWritable = static_cast<unsigned>(Writable.size());
  return V;
}

void Memory::load(const Image &Program) {
  // Fresh pages rather than 16 MiB of stores.
  madvise(ImageRange.Host, ImageRange.Bytes, MADV_DONTNEED);
  // The gaps between segments are memory too; what is not writable is.
  Writable.clear();
  uint32_t From = VX_IMAGE_BASE;
  auto Close = [&](uint32_t To) {
    if (To > From)
      Writable.push_back({From, To - From, ImageRange.at(From)});
  };
  for (const Image::Segment &S : Program.segments()) {
    if (!S.Bytes.empty())
      std::memcpy(ImageRange.at(S.Address), S.Bytes.data(), S.Bytes.size());
    if (!S.Writable) {
      Close(S.Address);
      From = S.Address + S.MemBytes;
    }
  }
  Close(VX_IMAGE_BASE + VX_IMAGE_SIZE);
}

void Memory::clearLocal() {
  for (const Region &L : Locals)
    std::memset(L.Host, 0, L.Bytes);
}

std::vector<std::span<std::byte>> Memory::kept() const {
  std::vector<std::span<std::byte>> All = {{Global.Host, Global.Bytes},
                                           {OwnStack.Host, StackBytesOnHost}};
  if (High.Host != Global.Host)
    All.emplace_back(High.Host, High.Bytes);
  return All;
}

std::byte *Memory::global(uint32_t Address, uint64_t Bytes) const {
  if (uint64_t{Address} + Bytes > Stack.Lo)
    return nullptr;
  std::byte *const At = rangeAt(Global, Address, Bytes);
  return At ? At : rangeAt(High, Address, Bytes);
}

std::byte *Memory::writable(uint32_t Address, uint64_t Bytes) const {
  for (const AddressRange &R : ReadOnly)
    if (Address < R.Base + R.Bytes && Address + Bytes > R.Base)
      return nullptr;
  return global(Address, Bytes);
}

std::byte *Memory::shared(uint32_t Address, uint64_t Bytes) const {
  std::byte *const At = global(Address, Bytes);
  return At ? At : rangeAt(ImageRange, Address, Bytes);
}

std::byte *Memory::stackByte(uint32_t Address) const {
  if (Address - Stack.Lo >= Stack.Bytes)
    return nullptr;
  return Stack.Host + view(0).stackOffset(Address);
}

} // namespace vorion::isasim
