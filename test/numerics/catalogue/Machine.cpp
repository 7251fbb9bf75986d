#include "Machine.h"

#include "effects/ViewFacts.h"
#include "picture/View.h"

#include <cstdio>

namespace vorion::test {

namespace {

/// With flags, so that cases share programs; that effects left out change
/// nothing is for test/render/effects.test.
splat::RenderPlan planFor(const HardCase &C, const splat::RenderOptions &O,
                          bool Layers) {
  const splat::ViewFacts Facts =
      splat::factsOf(C.Scene, splat::makeView(C.View, O), O);
  splat::EffectRequest Flags;
  Flags.Selection = splat::EffectRequest::Mode::Flags;
  return splat::planRender(
      splat::EffectPlan(Flags, {C.Scene,
                                O,
                                Facts,
                                false,
                                Layers,
                                {},
                                Layers,
                                Layers && splat::hasPixelLists(O)}),
      O);
}

} // namespace

Expected<Machine> Machine::open(const splat::DeviceOptions &Options) {
  auto D = splat::Device::open("", Options);
  if (!D)
    return D.error();
  return Machine(std::move(*D));
}

Expected<splat::RenderResult> Machine::render(const HardCase &C,
                                              const splat::RenderOptions &O,
                                              const std::string &KernelFolder,
                                              bool Layers) {
  splat::Launcher L = launcher(KernelFolder);
  auto R = splat::render(L, planFor(C, O, Layers), C.Scene, C.View, O,
                         /*KeepPairs=*/false);
  if (!R && !L.buildLog().empty())
    std::fputs(L.buildLog().c_str(), stderr);
  return R;
}

} // namespace vorion::test
