/// Checker of accesses that nothing orders.
#include "core/Isa.h"
#include "core/State.h"
#include "observe/check/Check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <fmt/format.h>
#include <memory>
#include <unordered_map>
#include <vector>

namespace vorion::isasim {

/// Two accesses to one byte race if they belong to different work-items, one of
/// them writes, they are not both atomic, and neither happens before the other.
/// What orders them: a barrier, between work-items of one group; an atomic on
/// one word by both groups in between, taken as release and acquire whatever
/// its memory order; a device barrier; the end of the run. A compare-exchange
/// that finds another value than it expects does not write. Work-items are
/// lanes here: two of a group that is larger than a warp and share a lane are
/// taken for one, so that a race between these is missed. Stores of the same
/// value do not race. Of each word the last store and two accesses of each
/// other kind are kept, so that a race with an older one may be missed.
class RaceCheck : public Check {
public:
  RaceCheck(Reporter Out, const Places &Where) : Out(Out), Where(Where) {}
  void runBegins(const RunStart &R) override;
  void fetch(const Step &S) override;
  void commit(const Commit &C) override;

private:
  /// Moments of an agent, counted by what orders its accesses.
  using Time = uint32_t;
  using Clock = std::vector<Time>; ///< by agent

  struct Access {
    uint32_t Group = 0; ///< number of the group's start, 0 for no access
    Time When = 0;
    uint32_t Pc = 0;
    uint32_t Agent : 18 = 0; ///< Places::agentOf()
    uint32_t Hart : 8 = 0;   ///< warp and lane
    uint32_t Bytes : 4 = 0;
    uint32_t IsAtomic : 1 = 0;
    uint32_t Writes : 1 = 0;
  };
  /// Two accesses of which an access of any work-item differs from one.
  using Pair = std::array<Access, 2>;
  struct Cell {
    Access Store;
    uint32_t Stored = 0; ///< the value
    Pair Loads;
  };
  /// What atomics did, few words of a program.
  struct AtomicCell {
    Pair Writes, Reads;
  };
  struct Page {
    std::array<Cell, 1024> Words;
    std::unordered_map<uint32_t, AtomicCell> Atomics; ///< by word
  };

  struct AgentState {
    Time Now = 1;
    Time LastBarrier = 0; ///< accesses up to then are ordered for the group
    Time Arrived = 0;     ///< at a barrier of the device
    uint32_t Group = 1;
    Clock Acquired; ///< moments of agents that this one's group comes after
  };

  AgentState &ownOf(const Step &S) { return Agents[Where.agentOf(S)]; }
  size_t warpOf(const Step &S) const {
    return size_t{S.Core} * Where.shape().WarpsPerCore + S.Warp;
  }
  bool isShared(uint32_t Address) const;
  Page &pageOf(uint32_t Address, unsigned Agent);
  bool isOrdered(const Access &Earlier, const Access &Now, bool IsLocal) const;
  void check(const Commit &C, unsigned Lane, const Access &Earlier,
             const Access &Now);
  void keep(Pair &Kept, const Access &Now, bool IsLocal) const;
  Access accessOf(const Commit &C);
  void accessWord(const Commit &C, unsigned Lane, uint32_t Address, Access Now,
                  uint32_t Value);
  bool writes(const Commit &C, unsigned Lane) const;
  void synchronise(uint32_t Address, unsigned Agent);
  void deviceBarrier(unsigned Agent);

  Reporter Out;
  const Places &Where;
  std::vector<AgentState> Agents;
  /// By warp: what the compare-exchange at hand expects, in each lane.
  std::vector<std::array<std::array<uint32_t, 16>, 2>> Expected;
  uint32_t Groups = 1;
  std::unordered_map<uint64_t, std::unique_ptr<Page>> Pages;
  uint64_t RecentNumber = 0;
  Page *Recent = nullptr;                       ///< the page of that number
  std::unordered_map<uint32_t, Clock> Released; ///< by word
};

namespace {

constexpr uint32_t PageShift = 12;
constexpr uint32_t DeviceBarrier = 1U << 31; ///< in vx_bar's rs1 (Simt.td)

/// What \p Lane stores, or 0.
uint32_t storedBy(const Commit &C, unsigned Lane) {
  if (C.Access->What != MemoryAccess::Store)
    return 0;
  const InsnInfo &Info = C.Insn.info();
  const unsigned Register = (Info.Rs2 == File::F ? FBase : XBase) + C.Insn.Rs2;
  const uint32_t Word = C.State.lanes(Register * sizeof(LaneWords))[Lane];
  return C.Access->Bytes == 4 ? Word : Word & ((1U << C.Access->Bytes * 8) - 1);
}

bool isCompareExchange(Op Opcode) {
  return Opcode == Op::RV_AMOCAS_W || Opcode == Op::RV_AMOCAS_D;
}

} // namespace

void RaceCheck::runBegins(const RunStart &R) {
  const unsigned Count = Where.agents();
  Pages.clear();
  Recent = nullptr;
  Released.clear();
  Agents.assign(Count, AgentState());
  Expected.assign(size_t{R.Shape.cores()} * R.Shape.WarpsPerCore, {});
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
  if (isCompareExchange(S.Insn.Opcode))
    for (unsigned N = 0; N != (S.Insn.info().Pairs ? 2 : 1); ++N)
      std::copy_n(S.State.lanes((S.Insn.Rd + N) * sizeof(LaneWords)),
                  Expected[warpOf(S)][N].size(),
                  Expected[warpOf(S)][N].begin());
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

RaceCheck::Page &RaceCheck::pageOf(uint32_t Address, unsigned Agent) {
  const bool IsLocal = Where.kindOf(Address) == Places::Local;
  const uint64_t Number =
      Address >> PageShift | uint64_t{IsLocal ? Agent + 1 : 0} << 32;
  if (Recent && RecentNumber == Number)
    return *Recent;
  std::unique_ptr<Page> &P = Pages[Number];
  if (!P)
    P = std::make_unique<Page>();
  RecentNumber = Number;
  Recent = P.get();
  return *Recent;
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
                      const Access &Now) {
  if (Earlier.Group == 0 || !(Earlier.Bytes & Now.Bytes) ||
      (Earlier.IsAtomic && Now.IsAtomic) || (!Earlier.Writes && !Now.Writes))
    return;
  const uint32_t Address = C.Access->Addresses[Lane];
  if (isOrdered(Earlier, Now, Where.kindOf(Address) == Places::Local))
    return;
  const unsigned Lanes = Where.shape().LanesPerWarp;
  const auto NameOf = [](const Access &A) {
    return A.IsAtomic ? "atomic" : A.Writes ? "store" : "load";
  };
  Out.add(Culprit::of(C, Lane),
          fmt::format("{} at 0x{:08x}, {}, is not ordered with the {} by core "
                      "{}, warp {}, lane {}{} at {}",
                      NameOf(Now), Address, Where.describe(Address, C, Lane),
                      NameOf(Earlier),
                      Earlier.Agent / Where.shape().WarpsPerCore,
                      Earlier.Hart / Lanes, Earlier.Hart % Lanes,
                      Earlier.Group == Now.Group ? " of the same group" : "",
                      Out.place(Earlier.Pc)),
          Earlier.Pc);
}

/// Adds \p Now to the accesses of its kind. It takes the place of one that
/// happened before it, because who races with that also races with \p Now.
/// Of two others one stays, of another group if there is one.
void RaceCheck::keep(Pair &Kept, const Access &Now, bool IsLocal) const {
  const auto IsOver = [&](const Access &Earlier) {
    return Earlier.Group == 0 || isOrdered(Earlier, Now, IsLocal);
  };
  if (!IsOver(Kept[0]) && (IsOver(Kept[1]) || Kept[0].Group != Now.Group))
    Kept[1] = Kept[0];
  Kept[0] = Now;
}

/// Whether the access of \p Lane writes: an atomic load does not, nor does a
/// compare-exchange that found another value.
bool RaceCheck::writes(const Commit &C, unsigned Lane) const {
  if (C.Access->What != MemoryAccess::Atomic)
    return C.Access->What == MemoryAccess::Store;
  if (!isCompareExchange(C.Insn.Opcode) || C.Result.empty())
    return true;
  const auto &Wanted = Expected[warpOf(C)];
  return C.Result[Lane] == Wanted[0][Lane] &&
         (C.HighResult.empty() || C.HighResult[Lane] == Wanted[1][Lane]);
}

/// What is the same for all lanes of \p C.
RaceCheck::Access RaceCheck::accessOf(const Commit &C) {
  const AgentState &Own = ownOf(C);
  Access A;
  A.Group = Own.Group;
  A.When = Own.Now;
  A.Pc = C.Pc;
  A.Agent = Where.agentOf(C);
  A.IsAtomic = Where.isAtomic(C);
  return A;
}

/// The part of the access \p Now that lies in the word of \p Address.
void RaceCheck::accessWord(const Commit &C, unsigned Lane, uint32_t Address,
                           Access Now, uint32_t Value) {
  Now.Bytes = (((1U << C.Access->Bytes) - 1) << Address % 4) & 15;
  const bool IsLocal = Where.kindOf(Address) == Places::Local;
  const bool IsStore = Now.Writes && !Now.IsAtomic;
  Page &P = pageOf(Address, Now.Agent);
  const uint32_t Word = Address % (1U << PageShift) / 4;
  Cell &At = P.Words[Word];
  if (!IsStore || At.Store.Bytes != Now.Bytes || At.Stored != Value)
    check(C, Lane, At.Store, Now);
  for (const Access &Load : At.Loads)
    check(C, Lane, Load, Now);
  if (Now.IsAtomic) {
    AtomicCell &Atomics = P.Atomics[Word];
    keep(Now.Writes ? Atomics.Writes : Atomics.Reads, Now, IsLocal);
    return;
  }
  const auto Atomics =
      P.Atomics.empty() ? P.Atomics.end() : P.Atomics.find(Word);
  if (Atomics != P.Atomics.end())
    for (const Pair *Kept : {&Atomics->second.Writes, &Atomics->second.Reads})
      for (const Access &Earlier : *Kept)
        check(C, Lane, Earlier, Now);
  if (!IsStore) {
    keep(At.Loads, Now, IsLocal);
    return;
  }
  // Whatever was before it has been reported, or happened before it.
  At = {Now, Value, {}};
  if (Atomics != P.Atomics.end())
    P.Atomics.erase(Atomics);
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
  Access Now = accessOf(C);
  for (uint32_t Left = C.LaneMask; Left; Left &= Left - 1) {
    const auto L = static_cast<unsigned>(std::countr_zero(Left));
    const uint32_t Address = C.Access->Addresses[L];
    if (Now.IsAtomic && Where.kindOf(Address) != Places::Local)
      synchronise(Address, Now.Agent);
    if (!isShared(Address))
      continue;
    Now.Hart = static_cast<uint8_t>(C.Warp * Where.shape().LanesPerWarp + L);
    Now.Writes = writes(C, L);
    for (uint32_t N = 0; N < C.Access->Bytes; N += 4)
      accessWord(C, L, Address + N, Now, storedBy(C, L));
  }
  if (Now.IsAtomic)
    ++ownOf(C).Now;
}

std::unique_ptr<Check> makeRaceCheck(Reporter Out, const Places &Where) {
  return std::make_unique<RaceCheck>(Out, Where);
}

} // namespace vorion::isasim
