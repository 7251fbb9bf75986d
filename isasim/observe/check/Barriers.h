/// Checker of barriers that not all work-items of a group reach.
#pragma once

#include "observe/check/Check.h"

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

} // namespace vorion::isasim
