/// Gradients of the training loss in fp64, the reference of reciprocal units
/// and summation orders.
#pragma once

#include "scene/Scene.h"
#include "train/data/TrainingSet.h"
#include "vorion/support/Expected.h"

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vorion::splat {

/// The files of a reference, for `splat gradients`.
struct GradientFiles {
  explicit GradientFiles(const std::string &Folder)
      : Cameras(Folder + "/cameras.json"), Upstream(Folder + "/upstream.npz"),
        Gradients(Folder + "/gradients.npz") {}
  static constexpr const char *View = "view"; ///< its name in Cameras
  std::string Cameras;                        ///< only the view
  std::string Upstream;  ///< gradients of the loss by pixels
  std::string Gradients; ///< f64_g_*, as in reference results
};

/// Renders the view \p V of \p S over \p Background, by INRIA's rules with the
/// support `exact`, and computes the gradients of the loss. Gradients of
/// doubtful pixels are 0.
Expected<Success>
writeGradientReference(const GradientFiles &Files, Scene S, const TrainView &V,
                       const std::array<float, 3> &Background);

/// Relative L2 errors of f32_g_* in \p File, an output of `splat gradients`, by
/// name ("means"), and their maximum ("largest"). Gradients of quaternions
/// vanish for isotropic Gaussians, so their norm is bounded below by a fraction
/// of that of scales.
Expected<nlohmann::ordered_json> gradientErrors(const GradientFiles &Files,
                                                const std::string &File);

} // namespace vorion::splat
