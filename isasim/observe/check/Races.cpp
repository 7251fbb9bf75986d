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

void RaceCheck::runBegins(const RunStart & /*R*/) {
  const unsigned Count = Where.agents();
  Pages.clear();
  Released.clear();
  Agents.assign(Count, AgentState());
  Groups = 0;
  for (AgentState &A : Agents) {
    A.Acquired.assign(Count, 0);
    A.Group = ++Groups;
  }
}

void RaceCheck::fetch(const Step &S) {
  // All who take part have arrived before the first one goes on.
  if (S.Insn.Opcode == Op::VX_BAR)
    ownOf(S).Arrived = ownOf(S).Now;
  if (!Where.hasLaunch() || S.Pc != Where.launch().Entry)
    return;
  // A new group comes after nothing of this run.
  AgentState &A = ownOf(S);
  A.Group = ++Groups;
  A.LastBarrier = A.Now++;
  std::fill(A.Acquired.begin(), A.Acquired.end(), 0);
}

/// Whether more than one work-item may have business there.
bool RaceCheck::isShared(uint32_t Address) const {
  switch (Where.kindOf(Address)) {
  case Places::Global:
    // What an agent's groups use one after the other.
    return !Where.hasLaunch() || !Where.isContext(Address);
  case Places::Local:
  case Places::Program:
    return true;
  case Places::Stack:
  case Places::Nothing:
    break;
  }
  return false;
}

RaceCheck::Cell &RaceCheck::cellOf(uint32_t Address, unsigned Agent) {
  const bool IsLocal = Where.kindOf(Address) == Places::Local;
  const uint64_t Number =
      Address >> PageShift | uint64_t{IsLocal ? Agent + 1 : 0} << 32;
  std::unique_ptr<Page> &P = Pages[Number];
  if (!P)
    P = std::make_unique<Page>();
  return (*P)[Address % (1U << PageShift) / 4];
}

bool RaceCheck::isOrdered(const Access &Earlier, const Access &Now,
                          bool IsLocal) const {
  if (Earlier.Group == Now.Group)
    return Earlier.Hart == Now.Hart ||
           Earlier.When <= Agents[Now.Agent].LastBarrier;
  // Groups have an agent's local memory one after the other.
  return IsLocal || Earlier.When <= Agents[Now.Agent].Acquired[Earlier.Agent];
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
                      Earlier.Agent / Where.shape().WarpsPerCore,
                      Earlier.Hart / Lanes, Earlier.Hart % Lanes,
                      Earlier.Group == Now.Group ? " of the same group" : "",
                      Out.place(Earlier.Pc)),
          Earlier.Pc);
}

/// The part of a lane's access that lies in the word of \p Address.
void RaceCheck::accessWord(const Commit &C, unsigned Lane, uint32_t Address) {
  const bool IsAtomic = C.Access->What == MemoryAccess::Atomic;
  const AgentState &Own = ownOf(C);
  Access Now;
  Now.Group = Own.Group;
  Now.When = Own.Now;
  Now.Pc = C.Pc;
  Now.Agent = static_cast<uint16_t>(Where.agentOf(C));
  Now.Hart = static_cast<uint8_t>(C.Warp * Where.shape().LanesPerWarp + Lane);
  Now.Bytes = (((1U << C.Access->Bytes) - 1) << Address % 4) & 15;
  Now.IsAtomic = IsAtomic;
  Cell &At = cellOf(Address, Now.Agent);
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

void RaceCheck::synchronise(uint32_t Address, unsigned Agent) {
  AgentState &Own = Agents[Agent];
  Clock &There = Released[Address];
  There.resize(Agents.size());
  for (size_t N = 0; N != There.size(); ++N)
    Own.Acquired[N] = There[N] = std::max(There[N], Own.Acquired[N]);
  There[Agent] = Own.Now;
}

void RaceCheck::deviceBarrier(unsigned Agent) {
  // Who takes part is not followed: others have arrived nowhere, or earlier.
  Clock &Own = Agents[Agent].Acquired;
  for (size_t N = 0; N != Agents.size(); ++N)
    Own[N] = std::max(Own[N], Agents[N].Arrived);
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
    AgentState &Own = ownOf(C);
    if (Id & DeviceBarrier)
      deviceBarrier(Where.agentOf(C));
    Own.LastBarrier = Own.Now++;
    return;
  }
  if (!C.Access)
    return;
  const bool IsAtomic = C.Access->What == MemoryAccess::Atomic;
  for (uint32_t Left = withoutRepeats(C); Left; Left &= Left - 1) {
    const auto L = static_cast<unsigned>(std::countr_zero(Left));
    if (IsAtomic && Where.kindOf(C.Access->Addresses[L]) != Places::Local)
      synchronise(C.Access->Addresses[L], Where.agentOf(C));
    if (isShared(C.Access->Addresses[L]))
      for (uint32_t N = 0; N < C.Access->Bytes; N += 4)
        accessWord(C, L, C.Access->Addresses[L] + N);
  }
  if (IsAtomic)
    ++ownOf(C).Now;
}

std::unique_ptr<Check> makeRaceCheck(Reporter Out, const Places &Where) {
  return std::make_unique<RaceCheck>(Out, Where);
}

} // namespace vorion::isasim
