/// One thing that a picture may need beyond the bare pipeline: how it is told
/// that it is needed, and what it adds.
#pragma once

#include "device/DeviceOptions.h"
#include "effects/ViewFacts.h"
#include "picture/Options.h"
#include "scene/Scene.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace vorion::splat {

enum class EffectKind {
  Scene,      ///< from data; on or off where it is not needed, same bits
  Machine,    ///< changes time, and at most rounding within its bound
  Observation ///< by option only; changes nothing
};

std::string_view name(EffectKind K);

/// Whether an effect is needed, and the figure that decided.
struct Finding {
  bool Needed = false;
  std::string Figure;
  /// False where the options rule it out: it is then not even done unneeded.
  bool Applies = true;
};

/// What detection looks at.
struct EffectInputs {
  const Scene &Gaussians;
  const RenderOptions &Options;
  const ViewFacts &Facts;
  bool KeepPairs = false;     ///< --dump-pairs
  bool Depth = false;         ///< --depth
  DeviceOptions Machine = {}; ///< what the device is opened with
  bool Normals = false;       ///< --normals
  bool Lists = false;         ///< --contributors, --depth-as median
  std::size_t Views = 1;      ///< pictures that are drawn of the scene at once
};

/// A record of the registry; each is defined in a file of its own.
struct Effect {
  /// As --effects and reports have it.
  std::string_view Name;
  EffectKind Kind;
  /// What it is and what it adds: code, unit, model.
  std::string_view What;
  /// The choice of its code in the kernels (device/Program.h, EffectSwitch);
  /// empty where it has no code of its own.
  std::string_view Macro = ""; // NOLINT(readability-redundant-string-init)
  Finding (*Detect)(const EffectInputs &) = nullptr;
  /// In place of that: the lens that a camera has which needs it.
  const LensModel *Lens = nullptr;
  /// The effect that encloses its code, which is done where this one is; later
  /// in the registry.
  const Effect *Within = nullptr;
  /// Done where it is not needed, it changes no bit. What is not neutral is
  /// told by an option, and compiled in unneeded only behind its flag.
  bool Neutral = true;
  /// The camera or an option decides, in every mode: its code is of this
  /// picture's programs alone, and never behind a flag.
  bool ByCamera = false;

  Finding detect(const EffectInputs &In) const {
    return Lens ? findLens(In) : Detect(In);
  }

private:
  Finding findLens(const EffectInputs &In) const;
};

} // namespace vorion::splat
