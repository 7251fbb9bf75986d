/// What `splat train` writes beside the scene: the cameras, and on request the
/// held-out pictures beside their photographs.
#pragma once

#include "train/run/Training.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

struct TrainPictures {
  std::string Html, Pictures; ///< file, and what names begin with

  bool any() const { return !Html.empty() || !Pictures.empty(); }
};

/// Where the cameras of the scene in \p Output go: a file beside it, of its
/// name.
std::string camerasFor(const std::string &Output);

/// Declares the options; \p P must outlive the parsing.
void addTrainPictures(CLI::App &App, TrainPictures &P);

/// Whether the files' names promise what is in them.
Expected<Success> checkTrainPictures(const TrainPictures &P);

/// Writes them for the scene in \p Output.
Expected<Success> writeTrainPictures(const TrainPictures &P,
                                     const std::string &Output,
                                     const TrainOutcome &Out);

} // namespace vorion::splat
