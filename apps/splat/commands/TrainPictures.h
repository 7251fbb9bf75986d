/// Outputs of `splat train` in addition to the scene: the cameras, and if
/// requested the held-out pictures with their photographs.
#pragma once

#include "page/Figures.h"
#include "train/run/Training.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

struct TrainPictures {
  PageFiles Page;
  std::string Pictures; ///< prefix of file names

  bool any() const { return Page.any() || !Pictures.empty(); }
};

/// The name of the camera file for the scene in \p Output: in the same folder,
/// with the same stem.
std::string camerasFor(const std::string &Output);

/// Declares the options; \p P must outlive the parsing.
void addTrainPictures(CLI::App &App, TrainPictures &P);

/// Checks the file extensions.
Expected<Success> checkTrainPictures(const TrainPictures &P);

/// Writes them for the scene in \p Output. The page has the curves of \p
/// Report, the run's.
Expected<Success> writeTrainPictures(const TrainPictures &P,
                                     const std::string &Output,
                                     const TrainOutcome &Out,
                                     const nlohmann::ordered_json &Report);

} // namespace vorion::splat
