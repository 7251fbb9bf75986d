/// The comparisons of `splat compare`. They read only files and need no OpenCL
/// device.
#pragma once

#include "page/Figures.h"
#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace vorion::splat {

struct CompareArguments {
  std::string Reference, Picture; ///< expected and actual picture
  std::string Mask, Json;         ///< file names; empty for none
  PageFiles Page;
  bool Pairs = false;
  std::optional<double> MinDb;       ///< outside the mask
  std::optional<double> MinDbAll;    ///< over all pixels
  std::optional<double> MaxDoubtful; ///< masked pixels, per cent
  bool Times = false;
  bool Trainings = false;
  bool Across = false;          ///< also of other machines or workloads
  std::optional<double> AtMost; ///< maximum increase, per cent
};

/// A compared file in reports: name and hash; null without a file.
Expected<nlohmann::ordered_json> comparedFile(const std::string &File);

/// Prints the differences of two pictures, and writes them if requested. A
/// figure beyond the bounds in the arguments is an Error (GuestFailed),
/// returned after writing.
Expected<Success> comparePictures(const CompareArguments &A);

/// Compares the pairs of two files of `--pairs`, including their order. A
/// difference is an Error (GuestFailed) with the first position that differs,
/// returned after the report is written.
Expected<Success> comparePairs(const CompareArguments &A);

/// Prints the changes between two time reports, and writes them if requested.
/// Reports that are not comparable are an Error. A time beyond the bound is an
/// Error (GuestFailed), returned after writing.
Expected<Success> compareTimes(const CompareArguments &A);

/// Prints the results of two trainings and the settings in which they differ,
/// and writes a page with their curves if requested.
Expected<Success> compareTrainings(const CompareArguments &A);

} // namespace vorion::splat
