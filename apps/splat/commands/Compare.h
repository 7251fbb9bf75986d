/// What `splat compare` does: both kinds of comparison, over files alone, so
/// that no OpenCL device is needed.
#pragma once

#include "vorion/support/Expected.h"

#include <optional>
#include <string>

namespace vorion::splat {

struct CompareArguments {
  std::string Reference, Picture; ///< what to expect, and what there is
  std::string Mask, Json;         ///< files; empty for none
  bool Pairs = false;
  std::optional<double> MinDb;       ///< outside the mask
  std::optional<double> MinDbAll;    ///< over all pixels
  std::optional<double> MaxDoubtful; ///< masked share, per cent
};

/// Prints and, on request, writes the differences of two pictures. Figures
/// out of the bounds that the arguments set are an Error (GuestFailed), given
/// after the writing.
Expected<Success> comparePictures(const CompareArguments &A);

/// Whether two files of `--dump-pairs` hold the same pairs in the same order;
/// if not, an Error (GuestFailed) with the first place that differs.
Expected<Success> comparePairs(const CompareArguments &A);

} // namespace vorion::splat
