/// Which programs a picture needs, and what is compiled into them.
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

/// The programs for \p Effects under \p Options. Each is built with its own
/// choices alone, so that it is not built again for those of another.
RenderPlan planRender(EffectPlan Effects, const RenderOptions &Options);
/// Of training, which knows no scene and decides nothing by data: harmonics up
/// to \p ShDegree, whatever they are, and all guards.
RenderPlan planRender(int ShDegree, const RenderOptions &Options);

} // namespace vorion::splat
