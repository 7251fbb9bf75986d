/// Proves that a machine can never go on: it is back in a state where it was
/// before, and nothing outside its registers has changed in between. A spin
/// lock between lanes of one warp ends here (docs/decisions.md, 4).
#pragma once

#include "core/Core.h"

#include <memory>
#include <vector>

namespace vorion::isasim {

class HangDetector {
public:
  /// To be called where all cores are parked. \p Progress: something has
  /// happened since the last call that stores and atomics do not show.
  /// Returns whether the machine is caught in a loop.
  bool check(const std::vector<std::unique_ptr<Core>> &Cores, bool Progress);

private:
  std::vector<std::byte>
  snapshot(const std::vector<std::unique_ptr<Core>> &Cores) const;

  uint64_t LastChanges = 0;
  uint64_t QuietRounds = 0;
  std::vector<std::byte> Earlier;
};

} // namespace vorion::isasim
