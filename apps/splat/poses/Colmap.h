/// Camera poses of photographs, found by the program COLMAP.
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// A capture's folder. COLMAP reads images/, and masks/ if there are any. Its
/// models are written to sparse/, and its other files to colmap/.
struct PoseRequest {
  std::string Folder;
  std::vector<std::string> Pictures; ///< names in images/, sorted
  bool HasMasks = false;
  std::string Lens;        ///< the name of COLMAP's camera model
  bool OneLens = false;    ///< all pictures are of one camera
  bool Sequential = false; ///< only neighbours are compared, as in a video
};

/// Told of a step's name and, where they are known, of its parts: the number
/// that are done, and of all.
using PoseProgress = std::function<void(std::string_view Step, std::size_t Done,
                                        std::size_t All)>;

/// Runs COLMAP's steps. Steps of an earlier run with the same request are not
/// repeated, and an interrupted step continues with the pictures that it has
/// not handled. Errors: COLMAP is not installed, or fails; no model is found.
Expected<Success> findPoses(const PoseRequest &R, const PoseProgress &Progress);

/// What COLMAP's \c model_analyzer says about a model.
struct PoseModel {
  std::string Name;                  ///< sparse/0
  std::vector<std::string> Pictures; ///< registered ones, sorted
  std::size_t Points = 0;
  double TrackLength = 0; ///< pictures in which a point is seen, mean
  double Error = 0;       ///< of reprojection, mean, in pixels
};

/// The models in sparse/ of the capture's \p Folder, the largest first.
Expected<std::vector<PoseModel>> posedModels(const std::string &Folder);

/// The judgement of the largest of \p Models, which has an element, in lines of
/// text: registered pictures of all \p Pictures (sorted), error, points, gaps,
/// other models, and whether to train.
std::string judgePoses(const std::vector<PoseModel> &Models,
                       const std::vector<std::string> &Pictures);

} // namespace vorion::splat
