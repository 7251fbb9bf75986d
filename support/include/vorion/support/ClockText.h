/// Texts of the simulated machine's clock: what the variable VORION_TIME says,
/// and what stands beside a time.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vorion {

/// The fastest clock that a machine can be given, in MHz.
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
  /// 100 or 100MHz. A 1 without a unit is no clock: people write it for on. The
  /// error does not name the variable.
  static Expected<ClockText> parse(std::string_view Text);
  /// The text of a clock that is always on, of \p Mhz.
  static std::string ofMhz(uint32_t Mhz);
};

/// A machine and its clock for people. Where a time is printed, this stands
/// beside it. \p Version is that of the simulator's clock, not of a file.
std::string clockedMachine(std::string_view Machine, uint64_t Mhz,
                           uint64_t Version);

} // namespace vorion
