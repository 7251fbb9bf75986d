/// Checker of accesses that nothing orders.
#pragma once

#include "observe/check/Check.h"

#include <array>
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
    uint16_t Agent = 0; ///< Places::agentOf()
    uint8_t Hart = 0;   ///< warp and lane
    uint8_t Bytes : 4 = 0;
    uint8_t IsAtomic : 1 = 0;
    uint8_t Writes : 1 = 0;
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

} // namespace vorion::isasim
