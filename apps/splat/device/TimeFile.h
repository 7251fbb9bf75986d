/// Files with simulated times, and their comparison.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// A figure of a file, and its group: "stages", "cores".
struct TimeFigure {
  std::string Group, Name;
  double Value = 0;
};

/// The times in a file: of a frame or a sequence from `splat render --time
/// --json`, or of all runs from `vorion-sim --time --stats`.
struct TimeFile {
  std::string Path;
  /// The values that must be equal in compared files, by their names in
  /// messages: "the machine", "the view". Objects are compared by member.
  nlohmann::json Machine, Work;
  unsigned ClockVersion = 0;
  /// The machine and clock of the times, as text.
  std::string On;
  double Milliseconds = 0; ///< including launches and copies, if reported
  /// Cycles, then cycles by stage and kernel or by run, then the counts of each
  /// kind of unit, summed over its units.
  std::vector<TimeFigure> Figures;
};

/// Errors: no such file, no JSON, no times, an incomplete run.
Expected<TimeFile> readTimeFile(const std::string &Path);

/// Checks whether the times of \p B and \p A are comparable; the error names
/// the first difference. Clocks of different versions are never comparable.
/// With \p Across, different machines and workloads are.
Expected<Success> checkComparable(const TimeFile &A, const TimeFile &B,
                                  bool Across);

/// A figure in two files; it may be missing in one.
struct TimeChange {
  std::string Group, Name;
  std::optional<double> A, B;

  /// Change from A to B in per cent; empty if one is missing or A is 0.
  std::optional<double> percent() const;
};

/// All figures of both files in their order, the time in milliseconds first.
std::vector<TimeChange> changesOf(const TimeFile &A, const TimeFile &B);

/// One line with the machine and clock of both, or one line for each if they
/// differ.
std::string machinesText(const TimeFile &A, const TimeFile &B);

/// The rows whose values differ, under the names of their groups. The first
/// two, time and cycles, are always included.
std::string toText(const std::vector<TimeChange> &Changes);

} // namespace vorion::splat
