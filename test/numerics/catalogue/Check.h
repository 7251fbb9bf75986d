/// Runs the catalogue on the device: cases, settings, broken kernels.
#pragma once

#include "Judge.h"
#include "Knobs.h"
#include "Machine.h"
#include "Rows.h"

#include <functional>
#include <string_view>

namespace vorion::test {

/// Is told a check's row, and the picture that it judged; null if there is
/// none, as of gradients or of a run that ended early.
using CheckListener =
    std::function<void(const nlohmann::json &Row, const splat::Image *Picture)>;

/// What is to be checked, and how much of it.
struct CheckPlan {
  std::vector<std::string> Cases; ///< by name; all if empty
  bool Long = false;              ///< the long ones too
  bool Alone = false;             ///< each knob alone
  uint32_t Random = 0;            ///< combinations of knobs
  uint32_t Seed = 1;
  bool Broken = false; ///< that broken kernels are noticed
  /// Evaluations a case at which fp64 is held against the oracle.
  uint64_t Oracle = 0;
  uint32_t OneIn = 1;  ///< of settings and broken kernels
  std::string RowFile; ///< rows are kept there
  std::string Scratch; ///< folder for broken kernels; a temporary one if empty
  splat::DeviceOptions Machine = {};
  CheckListener Listener = {}; ///< may be empty
  /// Is told which check begins; may be empty.
  std::function<void(std::string_view)> Progress = {};
};

struct CheckCounts {
  uint32_t Checked = 0, Kept = 0, Failed = 0;
};

/// Prints a line for every check that fails, unless \p P has a listener, and
/// all of them with \p Verbose.
Expected<CheckCounts> check(const CheckPlan &P, bool Verbose);

} // namespace vorion::test
