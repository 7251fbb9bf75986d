/// What a render did, for people and for programs.
#pragma once

#include "../io/SceneFile.h"
#include "Renderer.h"

#include <string>

namespace vorion::splat {

/// Everything that made a picture.
struct RenderRecord {
  const std::string &ScenePath, &AxesChange, &CameraFile, &Output;
  const SceneFile &Input;
  const Camera &View;
  const RenderOptions &Options;
  const RenderPlan &Plan;
  const Device &Dev;
  const RenderResult &Result;
};

/// JSON with inputs and their hashes, options, programs, device with its
/// configuration, versions, counts, and time and counters of every stage and
/// kernel. Fails if an input cannot be read again.
Expected<std::string> jsonReport(const RenderRecord &R);

/// A short table.
std::string textReport(const Camera &View, const RenderOptions &Options,
                       const Device &Dev, const RenderResult &Result);

} // namespace vorion::splat
