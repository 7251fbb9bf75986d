/// Gradients of the training loss at a scene, in fp64: what every reciprocal
/// unit and order of sums is held against.
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
  std::string Cameras;                        ///< the view, alone
  std::string Upstream;  ///< the loss's gradients by the pixels
  std::string Gradients; ///< f64_g_*, as the reference results name them
};

/// Renders \p S over \p Background as \p V sees it, by INRIA's rules with
/// support `exact`, and takes the loss against its picture back. Nothing comes
/// back from pixels where fp32 may decide otherwise.
Expected<Success>
writeGradientReference(const GradientFiles &Files, const Scene &S,
                       const TrainView &V,
                       const std::array<float, 3> &Background);

/// Relative L2 differences of f32_g_* of \p File, which `splat gradients`
/// wrote, by name ("means"), and the largest ("largest"). Of quaternions,
/// which vanish for round Gaussians, against a share of the scales' at least.
Expected<nlohmann::ordered_json> gradientErrors(const GradientFiles &Files,
                                                const std::string &File);

} // namespace vorion::splat
