#include "DeviceRenderer.h"

#include "../render/Renderer.h"

namespace vorion::splat {

namespace {

RenderOptions trainingOptions(Rules Convention, Path Blending,
                              const std::array<float, 3> &Background) {
  RenderOptions O;
  O.Convention = Convention;
  O.Blending = Blending;
  O.Background = Background;
  O.Training = true;
  return O;
}

} // namespace

DeviceRenderer::DeviceRenderer(Launcher &Launch, Rules Convention,
                               Path Blending, const BackwardOptions &How,
                               const std::array<float, 3> &Background)
    : L(Launch), Choice(How),
      Options(trainingOptions(Convention, Blending, Background)),
      Drawing(Launch, Options, EffectPlan::forAnyScene(MaxShDegree, Options)) {
  Choice.Parameters = GradientsOf::Stored;
}

void DeviceRenderer::build(int ShDegree) {
  L.beginStage("build");
  for (const ProgramSpec &P : planRender(ShDegree, Options).Programs)
    L.build(P);
  for (const ProgramSpec &P : planBackward(ShDegree, Options, Choice))
    L.build(P);
  Back.emplace(L, Options, Choice, ShDegree);
  BuiltDegree = ShDegree;
}

cl::Buffer DeviceRenderer::forward(const DeviceScene &S, const Camera &C,
                                   int ShDegree) {
  if (BuiltDegree != ShDegree)
    build(ShDegree);
  Drawing.draw({S.Parameters.Geometry, S.Parameters.Sh, S.Count}, C);
  L.beginStage("resolve");
  Picture = resolve(L, Drawing.frame(), Options.Background);
  return Picture;
}

GradientRenderer::Backward DeviceRenderer::backward(const cl::Buffer &ByRender,
                                                    const cl::Buffer &ByAlpha) {
  const Frame &F = Drawing.frame();
  L.beginStage("upstream");
  Back->setUpstream(F, ByRender, ByAlpha);
  Back->run(Drawing);
  return {{Back->gradients(), Back->shGradients()},
          {F.Records, F.Depths.Keys, Back->gradients(), GRADIENT_MEAN_2D,
           static_cast<int>(F.View.size[0]), static_cast<int>(F.View.size[1])}};
}

} // namespace vorion::splat
