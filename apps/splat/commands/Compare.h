/// What `splat compare` does: every kind of comparison, over files alone, so
/// that no OpenCL device is needed.
#pragma once

#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace vorion::splat {

struct CompareArguments {
  std::string Reference, Picture; ///< what to expect, and what there is
  std::string Mask, Json, Html;   ///< files; empty for none
  bool Pairs = false;
  std::optional<double> MinDb;       ///< outside the mask
  std::optional<double> MinDbAll;    ///< over all pixels
  std::optional<double> MaxDoubtful; ///< masked share, per cent
  bool Times = false;
  bool Across = false;          ///< of other machines or other work, too
  std::optional<double> AtMost; ///< longer, per cent
};

/// What was compared, for reports: the file and its hash; null for no file.
Expected<nlohmann::ordered_json> comparedFile(const std::string &File);

/// Prints and, on request, writes the differences of two pictures. Figures
/// out of the bounds that the arguments set are an Error (GuestFailed), given
/// after the writing.
Expected<Success> comparePictures(const CompareArguments &A);

/// Whether two files of `--dump-pairs` hold the same pairs in the same order;
/// if not, an Error (GuestFailed) with the first place that differs, given
/// after the report is written.
Expected<Success> comparePairs(const CompareArguments &A);

/// Prints and, on request, writes what changed from one time report to the
/// other. Reports that do not compare are an Error; a time beyond the bound is
/// one, too (GuestFailed), given after the writing.
Expected<Success> compareTimes(const CompareArguments &A);

} // namespace vorion::splat
