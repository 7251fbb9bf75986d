/// The programs of a picture, and their compile-time choices.
#pragma once

#include "device/Launcher.h"
#include "effects/EffectPlan.h"
#include "picture/Options.h"

#include <vector>

namespace vorion::splat {

struct RenderPlan {
  EffectPlan Effects;
  std::vector<ProgramSpec> Programs;
};

/// The programs for \p Effects with \p Options. Each is compiled with its own
/// choices only, so that choices of other programs do not recompile it.
RenderPlan planRender(EffectPlan Effects, const RenderOptions &Options);
/// The plan of training, which does not depend on the scene: harmonics up to \p
/// ShDegree, and all guards.
RenderPlan planRender(int ShDegree, const RenderOptions &Options);

} // namespace vorion::splat
