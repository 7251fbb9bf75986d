/// Files that say how long something took on the machine, and what two of them
/// differ in.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// A figure of a file. Figures of one group stand together: "stages", "cores".
struct TimeFigure {
  std::string Group, Name;
  double Value = 0;
};

/// What a file tells of time: of a frame or a sequence that `splat render
/// --time --json` wrote, or of all runs of `vorion-sim --time --stats`.
struct TimeFile {
  std::string Path;
  /// What has to be the same where two files are compared, by what it is
  /// called in messages: "the machine", "the view". Objects are compared by
  /// their members.
  nlohmann::json Machine, Work;
  unsigned ClockVersion = 0;
  /// Of what machine and clock the times are, for people.
  std::string On;
  double Milliseconds =
      0; ///< launches and copies included, where they are told
  /// Cycles, then cycles by stage and kernel or by run, then what each kind of
  /// unit counted, summed over its units.
  std::vector<TimeFigure> Figures;
};

/// Errors: no such file, no JSON, no time in it; a run that was not done.
Expected<TimeFile> readTimeFile(const std::string &Path);

/// Whether the times of \p B may be held against those of \p A; an error names
/// the first thing in which they differ. Clocks of different versions never
/// compare. Other machines and other work do if \p Across says so.
Expected<Success> checkComparable(const TimeFile &A, const TimeFile &B,
                                  bool Across);

/// A figure of two files; one of them may not have it.
struct TimeChange {
  std::string Group, Name;
  std::optional<double> A, B;

  /// From A to B in per cent; nothing where one is missing or A is 0.
  std::optional<double> percent() const;
};

/// All figures of both files in their order, the time in milliseconds first.
std::vector<TimeChange> changesOf(const TimeFile &A, const TimeFile &B);

/// A line that names the machine and the clock of both, or a line for each
/// where they differ.
std::string machinesText(const TimeFile &A, const TimeFile &B);

/// The rows whose values differ, under the names of their groups. The first
/// two, the time and the cycles, are always there.
std::string toText(const std::vector<TimeChange> &Changes);

} // namespace vorion::splat
