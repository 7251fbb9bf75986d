/// Where the cycles of the cores go: an annotated source listing (docs/
/// profiling.md, "Profile").
#pragma once

#include "observe/SourceCosts.h"
#include "timing/common/TimeObserver.h"

#include <array>
#include <cstdint>
#include <string>

namespace vorion::isasim {

class Machine;

class CycleProfile final : public TimeObserver {
public:
  /// Of the programs that \p Watched runs.
  explicit CycleProfile(const Machine &Watched) : Device(Watched) {}
  void timeBegins(uint64_t Now) override;
  void coreSpent(const CoreSpent &S) override;
  void coreIssued(const CoreIssued &I) override;

  /// The listing of all runs so far: source lines, then the instructions that
  /// took most, with the shares of all cores' cycles that went to each reason.
  std::string report() const;
  /// The same of every instruction, as JSON.
  std::string json() const;

private:
  struct Cost {
    std::array<uint64_t, size_t(CoreCycle::Count)> Cycles{};
    uint64_t Executed = 0; ///< warp instructions
    uint64_t sum() const;
    bool isNone() const { return sum() == 0; }
    Cost &operator+=(const Cost &Other);
  };
  /// The reasons that any instruction has cycles of, and how they are shown.
  struct Columns;

  const Machine &Device;
  SourceCosts<Cost> Places;
  Cost Nowhere; ///< of no instruction: before the first and after the last
};

} // namespace vorion::isasim
