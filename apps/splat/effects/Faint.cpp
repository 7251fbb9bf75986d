// Gaussians too transparent to reach the alpha cut-off anywhere have no
// support.

#include "effects/Registry.h"
#include "scene/Activation.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

/// Logits within this of a threshold count as beyond it: activation rounds the
/// opacity once.
constexpr float LogitSlack = 1e-5F;

Finding detect(const EffectInputs &In) {
  if (In.Options.Reach != Support::Exact)
    return {false, "a rule of --support exact", false};
  if (In.Options.Antialiased)
    return {true, "antialias lowers opacities by a view-dependent factor"};
  const float Limit = opacityLogit(In.Options.AlphaCutoff / 255.0);
  return {!(In.Facts.LeastLogit > Limit + LogitSlack),
          fmt::format("least logit of an opacity {:.6g}, of {}/255 {:.6g}",
                      In.Facts.LeastLogit, In.Options.AlphaCutoff, Limit)};
}

} // namespace

const Effect effects::Faint{
    .Name = "faint",
    .Kind = EffectKind::Scene,
    .What = "the test of each opacity against the alpha cut-off",
    .Macro = "USE_FAINT",
    .Detect = detect};

} // namespace vorion::splat
