/// Checker of barriers that not all work-items of a group reach.
#include "core/Isa.h"
#include "observe/check/Check.h"

#include <bit>
#include <fmt/format.h>
#include <vector>

namespace vorion::isasim {

/// A group's work-items are the lanes that the last vx_tmc left active. A
/// barrier of OpenCL C that stands under a condition is compiled as if the
/// condition were the same for all (docs/adr/0006-work-item-loops.md): where it
/// is not, the branch traps, which this explains.
class BarrierCheck : public Check {
public:
  explicit BarrierCheck(Reporter Out) : Out(Out) {}
  void runBegins(const RunStart &R) override;
  void fetch(const Step &S) override;
  void trap(const Trap &T) override;

private:
  struct Warp {
    uint32_t Alive = 1;
    bool Changed = false; ///< by a vx_tmc just before
  };
  Reporter Out;
  unsigned WarpsPerCore = 1;
  std::vector<Warp> Warps;
};

void BarrierCheck::runBegins(const RunStart &R) {
  const Config &Shape = R.Shape;
  WarpsPerCore = Shape.WarpsPerCore;
  Warps.assign(size_t{Shape.cores()} * WarpsPerCore, Warp());
}

void BarrierCheck::fetch(const Step &S) {
  Warp &W = Warps[size_t{S.Core} * WarpsPerCore + S.Warp];
  if (W.Changed)
    W.Alive = S.LaneMask;
  W.Changed = S.Insn.Opcode == Op::VX_TMC;
  if (S.Insn.Opcode != Op::VX_BAR || S.LaneMask == W.Alive)
    return;
  const uint32_t Missing = W.Alive & ~S.LaneMask;
  Out.add(Culprit::of(S, static_cast<unsigned>(std::countr_zero(S.LaneMask))),
          fmt::format("barrier reached by lanes 0x{:04x}, not by lanes "
                      "0x{:04x} of the same warp",
                      S.LaneMask, Missing));
}

void BarrierCheck::trap(const Trap &T) {
  if (T.Cause == TrapCause::DivergentBranch)
    Out.add(
        {T.Core, T.Warp, T.Lane, T.Pc, T.Instruction},
        fmt::format("lanes {} and {} diverge at a branch that must be uniform: "
                    "a barrier depends on it, or vx_uniform() asserts it",
                    T.Lane, std::countr_zero(T.LaneMask)));
}

std::unique_ptr<Check> makeBarrierCheck(Reporter Out, const Places &) {
  return std::make_unique<BarrierCheck>(Out);
}

} // namespace vorion::isasim
