/// An optional part of the pipeline: the condition under which a picture needs
/// it, and what it adds.
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
  Scene,      ///< decided by data; if not needed, it does not change any bit
  Machine,    ///< changes time, and at most rounding within a bound
  Observation ///< enabled by an option; changes nothing
};

std::string_view name(EffectKind K);

/// Whether an effect is needed, and the deciding figure.
struct Finding {
  bool Needed = false;
  std::string Figure;
  /// False if the options exclude it: it is then not done even with `all`.
  bool Applies = true;
};

/// The inputs of detection.
struct EffectInputs {
  const Scene &Gaussians;
  const RenderOptions &Options;
  const ViewFacts &Facts;
  bool KeepPairs = false;     ///< --pairs
  bool Depth = false;         ///< --depth
  DeviceOptions Machine = {}; ///< options of the device
  bool Normals = false;       ///< --normals
  bool Lists = false;         ///< --contributors, --depth-as median
  std::size_t Views = 1;      ///< number of views of the same run
};

/// A record of the registry, defined in its own file.
struct Effect {
  /// The name in --effects and reports.
  std::string_view Name;
  EffectKind Kind;
  /// Description: the code, unit or model that it adds.
  std::string_view What;
  /// The macro that selects its code in the kernels (device/Program.h,
  /// EffectSwitch); empty if it has no code.
  std::string_view Macro = ""; // NOLINT(readability-redundant-string-init)
  Finding (*Detect)(const EffectInputs &) = nullptr;
  /// Alternative to Detect: the lens whose cameras need it.
  const LensModel *Lens = nullptr;
  /// The effect that encloses its code, and is done if this one is. It is later
  /// in the registry.
  const Effect *Within = nullptr;
  /// It changes no bit if it is done without need. An effect that is not
  /// neutral is decided by an option; without need it is compiled only behind
  /// its flag.
  bool Neutral = true;
  /// Camera or option decide in every mode: its code is only in the programs of
  /// this picture, and never behind a flag.
  bool ByCamera = false;

  Finding detect(const EffectInputs &In) const {
    return Lens ? findLens(In) : Detect(In);
  }

private:
  Finding findLens(const EffectInputs &In) const;
};

} // namespace vorion::splat
