/// Policies of the clock that a plugin can replace (docs/plugins.md): which
/// line leaves a data cache, which request DRAM serves next, which warp issues.
/// They change cycles, never results.
///
/// A policy is called in the order of modelled time, by one thread at a time.
/// It must depend only on the arguments of its calls, so that a run has the
/// same cycles on every host: not on addresses of the host, clocks, or other
/// policies.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

namespace vorion::isasim {

/// \name Data caches
/// @{
struct CacheInfo {
  const char *Name; ///< "core", "l2" or "llc", as in keys of timing
  uint32_t Number;  ///< of its core or cluster; 0 for "llc"
  uint32_t Sets, Ways;
  /// Whether LineUse::Keep matters (timing.l2.intersect_hint).
  bool Hint;
};

/// A request that found its line, or whose line has taken a way.
struct LineUse {
  uint32_t Set, Way;
  uint32_t Line; ///< its address divided by 64
  bool IsFill;   ///< the line is new
  bool IsWrite;  ///< or an atomic
  bool Keep;     ///< other tiles will want it (intersect hint)
};

class Replacement {
public:
  virtual ~Replacement() = default;
  virtual void use(const LineUse &U) = 0;
  struct Victim {
    uint32_t Way;
    bool Spares = false; ///< another was spared for its hint, which is counted
  };
  /// The way of \p Set whose line leaves. All its ways have lines: empty ones
  /// are filled in order before this is called.
  virtual Victim victim(uint32_t Set) = 0;
  /// The cache has lost all lines.
  virtual void clear() = 0;
};
/// @}

/// \name DRAM
/// @{
struct DramInfo {
  uint32_t Channel;
  uint32_t Banks, BanksPerGroup;
};

/// A request that may be chosen. A bank has at most two: the oldest for its
/// open row, and the oldest for another one.
struct DramCandidate {
  static constexpr uint64_t Waits = UINT64_MAX;
  enum Command : uint8_t { Access, Activate, Precharge };

  /// Ticks until its next command can begin, or Waits: its bank is refreshed or
  /// has been opened for another request, whose turn comes first.
  uint64_t Ticks;
  uint64_t Order; ///< smaller: has arrived before
  uint32_t Bank, Row;
  uint32_t Uses; ///< of the bank's row since it was opened
  Command Next;
  bool IsWrite;
};

/// The order of a channel's requests. What is not its business: whether reads
/// or writes have their turn, refreshes, and that a row which was opened for a
/// request is used by it first (docs/dram.md).
class DramScheduler {
public:
  virtual ~DramScheduler() = default;
  /// The request with the smallest rank is next, even if it has to wait. Must
  /// be a function of \p C.
  virtual uint64_t rank(const DramCandidate &C) const = 0;
  /// Whether rows beyond timing.dram.row_hit_cap are used only for the oldest
  /// request of their bank group. If so, requests for them are no candidates.
  virtual bool capsRows() const { return false; }
};
/// @}

/// \name Warps of a core
/// @{
struct CoreInfo {
  uint32_t Core, Warps;
};

struct WarpToIssue {
  static constexpr uint64_t Never = UINT64_MAX >> 1;

  uint32_t Warp;
  /// Cycle from which its next instruction is decoded. Never for one that
  /// another warp starts, which needs no decoded instruction.
  uint64_t DecodedAt;
  /// Cycle from which it can issue; Never if memory has to answer first.
  uint64_t ReadyAt;
};

struct IssueSlot {
  uint32_t Warp = 0;
  uint64_t Cycle = WarpToIssue::Never;
};

/// Who gets the issue slots of a core with several warps.
class WarpScheduler {
public:
  virtual ~WarpScheduler() = default;
  /// Which of \p Warps issues first, and in which cycle, which is not before
  /// \p From and its ReadyAt. The default IssueSlot if no warp can. The warps
  /// are in order from the one behind \p Last, which issued last. May be called
  /// several times before a warp issues.
  virtual IssueSlot first(uint64_t From, uint32_t Last,
                          std::span<const WarpToIssue> Warps) const = 0;
  /// \p Warp issues.
  virtual void issued(uint32_t /*Warp*/, uint64_t /*Cycle*/) {}
};
/// @}

/// Makers of policies: of a plugin in its Plugin, and those of the process. One
/// that returns null leaves the unit its own policy. Called when a machine is
/// opened.
struct PolicyMakers {
  std::unique_ptr<Replacement> (*Cache)(const CacheInfo &) = nullptr;
  std::unique_ptr<DramScheduler> (*Dram)(const DramInfo &) = nullptr;
  std::unique_ptr<WarpScheduler> (*Warps)(const CoreInfo &) = nullptr;
};

} // namespace vorion::isasim
