/// Text forms of the clock of the simulated machine: the value of the variable
/// VORION_TIME, and the annotation of printed times.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vorion {

/// Maximum clock frequency of a machine, in MHz.
inline constexpr uint32_t MostClockMhz = 100000;

struct ClockText {
  enum class Runs {
    AsConfigured, ///< nothing is said
    Never,
    Profiled, ///< in runs of profiled queues alone
    Always
  };
  Runs When = Runs::AsConfigured;
  std::optional<uint32_t> Mhz; ///< nothing: the machine's own

  /// \p Text: nothing; off, 0 or false; on, 1 or true; profiled; or a clock, as
  /// 100 or 100MHz. A 1 without a unit means on, not a frequency. The error
  /// does not name the variable.
  static Expected<ClockText> parse(std::string_view Text);
  /// The text of a clock that is always on, with the frequency \p Mhz.
  static std::string ofMhz(uint32_t Mhz);
};

/// Human-readable description of a machine and its clock, printed with every
/// time. \p Version is that of the simulator's clock, not of a file.
std::string clockedMachine(std::string_view Machine, uint64_t Mhz,
                           uint64_t Version);

} // namespace vorion
