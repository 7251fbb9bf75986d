/// Reports of a render, as text and as JSON.
#pragma once

#include "render/Backward.h"
#include "render/Renderer.h"
#include "scene/SceneFile.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace vorion::splat {

struct SceneGradients;

/// The options of a backward pass, and the file with the gradients by pixels.
struct BackwardRecord {
  const BackwardOptions &Options;
  const std::string &Upstream;
  const SceneGradients &Gradients;
};

/// The inputs and results of a picture, and of its gradients if present.
struct RenderRecord {
  const std::string &ScenePath, &AxesChange, &CameraFile, &Output;
  const SceneFile &Input; ///< whose Gaussians may be gone
  std::size_t Gaussians;
  const Camera &View;
  const RenderOptions &Options;
  const RenderPlan &Plan;
  const Device &Dev;
  const RenderResult &Result;
  std::optional<BackwardRecord> Back = std::nullopt;
};

/// JSON with inputs and their hashes, options, programs, device with its
/// configuration, versions, counts, and time and counters of every stage and
/// kernel. Fails if an input cannot be read again.
Expected<nlohmann::ordered_json> jsonReport(const RenderRecord &R);

/// The part without files and date: view, options, programs, device with its
/// configuration, counts, stages and their total.
Expected<nlohmann::ordered_json> drawnJson(const Camera &View,
                                           const RenderOptions &Options,
                                           const RenderPlan &Plan,
                                           const Device &Dev,
                                           const RenderResult &Result);

/// fnv1a64 of the computed bits of \p P, independent of the file format.
std::string pictureHash(const Image &P);

/// JSON array of stages: seconds, and kernels with launches and counters.
nlohmann::ordered_json stagesJson(const std::vector<StageReport> &Stages);

/// A short table.
std::string textReport(const Camera &View, const RenderOptions &Options,
                       const Device &Dev, const RenderResult &Result);

} // namespace vorion::splat
