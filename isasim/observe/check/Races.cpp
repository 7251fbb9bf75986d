#include "observe/check/Races.h"

#include "core/Isa.h"
#include "core/State.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

constexpr uint32_t PageShift = 12;
constexpr uint32_t DeviceBarrier = 1U << 31; ///< in vx_bar's rs1 (Simt.td)

} // namespace

void RaceCheck::runBegins(const RunStart &R) {
  const unsigned Count = R.Shape.cores();
  Pages.clear();
  Released.clear();
  Cores.assign(Count, CoreState());
  Groups = 0;
  for (CoreState &C : Cores) {
    C.Acquired.assign(Count, 0);
    C.Group = ++Groups;
  }
}

void RaceCheck::fetch(const Step &S) {
  // All who take part have arrived before the first one goes on.
  if (S.Insn.Opcode == Op::VX_BAR)
    Cores[S.Core].Arrived = Cores[S.Core].Now;
  if (!Where.hasLaunch() || S.Pc != Where.launch().Entry)
    return;
  // A new group comes after nothing of this run.
  CoreState &C = Cores[S.Core];
  C.Group = ++Groups;
  C.LastBarrier = C.Now++;
  std::fill(C.Acquired.begin(), C.Acquired.end(), 0);
}

/// Whether more than one work-item may have business there.
bool RaceCheck::isShared(uint32_t Address) const {
  switch (Where.kindOf(Address)) {
  case Places::Global: {
    // What a core's groups use one after the other.
    const VxLaunch &L = Where.launch();
    return !Where.hasLaunch() ||
           Address - L.Context >= L.ContextStride * Where.shape().cores();
  }
  case Places::Local:
  case Places::Program:
    return true;
  case Places::Stack:
  case Places::Nothing:
    break;
  }
  return false;
}

RaceCheck::Cell &RaceCheck::cellOf(uint32_t Address, unsigned Core) {
  const bool IsLocal = Where.kindOf(Address) == Places::Local;
  const uint64_t Number =
      Address >> PageShift | uint64_t{IsLocal ? Core + 1 : 0} << 32;
  std::unique_ptr<Page> &P = Pages[Number];
  if (!P)
    P = std::make_unique<Page>();
  return (*P)[Address % (1U << PageShift) / 4];
}

bool RaceCheck::isOrdered(const Access &Earlier, const Access &Now,
                          bool IsLocal) const {
  if (Earlier.Group == Now.Group)
    return Earlier.Hart == Now.Hart ||
           Earlier.When <= Cores[Now.Core].LastBarrier;
  // Groups have a core's local memory one after the other.
  return IsLocal || Earlier.When <= Cores[Now.Core].Acquired[Earlier.Core];
}

void RaceCheck::check(const Commit &C, unsigned Lane, const Access &Earlier,
                      const Access &Now, bool EarlierWrites) {
  if (Earlier.Group == 0 || !(Earlier.Bytes & Now.Bytes) ||
      (Earlier.IsAtomic && Now.IsAtomic))
    return;
  const uint32_t Address = C.Access->Addresses[Lane];
  if (isOrdered(Earlier, Now, Where.kindOf(Address) == Places::Local))
    return;
  const unsigned Lanes = Where.shape().LanesPerWarp;
  constexpr const char *Names[] = {"load", "store", "atomic"};
  Out.add(Culprit::of(C, Lane),
          fmt::format("{} at 0x{:08x}, {}, is not ordered with the {} by core "
                      "{}, warp {}, lane {}{} at {}",
                      Names[C.Access->What], Address,
                      Where.describe(Address, C, Lane),
                      Earlier.IsAtomic ? "atomic"
                      : EarlierWrites  ? "store"
                                       : "load",
                      Earlier.Core, Earlier.Hart / Lanes, Earlier.Hart % Lanes,
                      Earlier.Group == Now.Group ? " of the same group" : "",
                      Out.place(Earlier.Pc)),
          Earlier.Pc);
}

/// The part of a lane's access that lies in the word of \p Address.
void RaceCheck::accessWord(const Commit &C, unsigned Lane, uint32_t Address) {
  const bool IsAtomic = C.Access->What == MemoryAccess::Atomic;
  const CoreState &Own = Cores[C.Core];
  Access Now;
  Now.Group = Own.Group;
  Now.When = Own.Now;
  Now.Pc = C.Pc;
  Now.Core = static_cast<uint16_t>(C.Core);
  Now.Hart = static_cast<uint8_t>(C.Warp * Where.shape().LanesPerWarp + Lane);
  Now.Bytes = (((1U << C.Access->Bytes) - 1) << Address % 4) & 15;
  Now.IsAtomic = IsAtomic;
  Cell &At = cellOf(Address, C.Core);
  check(C, Lane, At.Write, Now, true);
  if (C.Access->What == MemoryAccess::Load) {
    // Two readers that differ: a writer differs from one of them.
    Access &First = At.Reads[0];
    if (First.Group != Now.Group || First.Hart == Now.Hart)
      std::swap(At.Reads[0], At.Reads[1]);
    if (At.Reads[0].Group == Now.Group && At.Reads[0].Hart == Now.Hart)
      At.Reads[0] = Now;
    else
      At.Reads[1] = std::exchange(At.Reads[0], Now);
    return;
  }
  for (const Access &Read : At.Reads)
    check(C, Lane, Read, Now, false);
  At.Write = Now;
  At.Reads = {};
}

void RaceCheck::synchronise(uint32_t Address, unsigned Core) {
  CoreState &Own = Cores[Core];
  Clock &There = Released[Address];
  There.resize(Cores.size());
  for (size_t N = 0; N != There.size(); ++N)
    Own.Acquired[N] = There[N] = std::max(There[N], Own.Acquired[N]);
  There[Core] = Own.Now;
}

void RaceCheck::deviceBarrier(unsigned Core) {
  // Who takes part is not followed: others have arrived nowhere, or earlier.
  Clock &Own = Cores[Core].Acquired;
  for (size_t N = 0; N != Cores.size(); ++N)
    Own[N] = std::max(Own[N], Cores[N].Arrived);
}

/// The active lanes without those that store what a lower one stores to the
/// same place.
uint32_t RaceCheck::withoutRepeats(const Commit &C) const {
  if (C.Access->What != MemoryAccess::Store)
    return C.LaneMask;
  const InsnInfo &Info = C.Insn.info();
  const unsigned Register = (Info.Rs2 == File::F ? FBase : XBase) + C.Insn.Rs2;
  const uint32_t *Values = C.State.lanes(Register * sizeof(LaneWords));
  uint32_t Kept = 0;
  for (uint32_t Left = C.LaneMask; Left; Left &= Left - 1) {
    const auto L = static_cast<unsigned>(std::countr_zero(Left));
    bool Repeats = false;
    for (uint32_t Lower = Kept; Lower && !Repeats; Lower &= Lower - 1) {
      const auto M = static_cast<unsigned>(std::countr_zero(Lower));
      Repeats = C.Access->Addresses[M] == C.Access->Addresses[L] &&
                Values[M] == Values[L];
    }
    if (!Repeats)
      Kept |= Left & -Left;
  }
  return Kept;
}

void RaceCheck::commit(const Commit &C) {
  if (C.Insn.Opcode == Op::VX_BAR) {
    const unsigned Last = static_cast<unsigned>(std::bit_width(C.LaneMask)) - 1;
    const uint32_t Id = C.State.lanes(C.Insn.Rs1 * sizeof(LaneWords))[Last];
    CoreState &Own = Cores[C.Core];
    if (Id & DeviceBarrier)
      deviceBarrier(C.Core);
    Own.LastBarrier = Own.Now++;
    return;
  }
  if (!C.Access)
    return;
  const bool IsAtomic = C.Access->What == MemoryAccess::Atomic;
  for (uint32_t Left = withoutRepeats(C); Left; Left &= Left - 1) {
    const auto L = static_cast<unsigned>(std::countr_zero(Left));
    if (IsAtomic && Where.kindOf(C.Access->Addresses[L]) != Places::Local)
      synchronise(C.Access->Addresses[L], C.Core);
    if (isShared(C.Access->Addresses[L]))
      for (uint32_t N = 0; N < C.Access->Bytes; N += 4)
        accessWord(C, L, C.Access->Addresses[L] + N);
  }
  if (IsAtomic)
    ++Cores[C.Core].Now;
}

std::unique_ptr<Check> makeRaceCheck(Reporter Out, const Places &Where) {
  return std::make_unique<RaceCheck>(Out, Where);
}

} // namespace vorion::isasim
