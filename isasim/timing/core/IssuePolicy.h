/// The cores' own scheduler of warps.
#pragma once

#include "timing/common/Turn.h"
#include "timing/policy/Policy.h"

namespace vorion::isasim {

static_assert(WarpToIssue::Never == Turn::Never);

/// In turn: the first warp that can issue or, as \p Slots, each cycle's slot to
/// one of the warps with a decoded instruction, whether or not it can issue
/// (`timing.core.issue_in_turn`).
class IssueInTurn final : public WarpScheduler {
public:
  IssueInTurn(uint32_t Warps, bool Slots) : Warps(Warps), Slots(Slots) {}

  IssueSlot first(uint64_t From, uint32_t Last,
                  std::span<const WarpToIssue> All) const override {
    return Slots ? firstSlot(From, Last, All) : firstReady(All);
  }

private:
  static IssueSlot firstReady(std::span<const WarpToIssue> All) {
    IssueSlot First;
    for (const WarpToIssue &W : All)
      if (W.ReadyAt < First.Cycle)
        First = {W.Warp, W.ReadyAt};
    return First;
  }
  IssueSlot firstSlot(uint64_t From, uint32_t Last,
                      std::span<const WarpToIssue> All) const;

  uint32_t Warps;
  bool Slots;
};

/// Of core \p Of, which has the slots of IssueInTurn if nobody else's.
class IssuePolicy : public Policy<WarpScheduler, IssueInTurn> {
public:
  IssuePolicy(const CoreInfo &Of, bool Slots)
      : Policy(IssueInTurn(Of.Warps, Slots),
               Of.Warps > 1 && pluggedPolicies().Warps
                   ? pluggedPolicies().Warps(Of)
                   : nullptr),
        Core(Of.Core), Slots(Slots) {}

  /// Whether an instruction waits for the slot that first() says, and not only
  /// for what it needs.
  bool givesSlots() const { return Slots || !isOwn(); }
  IssueSlot first(uint64_t From, uint32_t Last,
                  std::span<const WarpToIssue> All) const;
  void issued(uint32_t Warp, uint64_t Cycle) {
    ask([&](auto &P) { P.issued(Warp, Cycle); });
  }

private:
  uint32_t Core;
  bool Slots;
};

} // namespace vorion::isasim
