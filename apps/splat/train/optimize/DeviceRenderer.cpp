#include "train/optimize/DeviceRenderer.h"

#include "effects/Registry.h"
#include "render/Renderer.h"

namespace vorion::splat {

namespace {

RenderOptions trainingOptions(Rules Convention, const Blender &By,
                              const DeviceRenderer::Look &How) {
  RenderOptions O;
  O.Convention = Convention;
  O.Kind = How.Kind;
  O.FalloffDegree = How.FalloffDegree;
  O.Blending = By.Kind;
  O.Tile = By.Tile;
  O.SimtGroup = By.SimtGroup;
  drawAs(O, {How.Antialiased, std::nullopt, {}});
  O.Near = How.Near;
  O.Optics = How.Optics;
  O.Rolling = How.Rolling;
  O.Through = How.Through;
  // Any but black makes kernels that know a background.
  O.Background = How.Several ? std::array<float, 3>{1, 1, 1} : How.Background;
  O.Training = true;
  return O;
}

} // namespace

DeviceRenderer::DeviceRenderer(Launcher &Launch, Rules Convention,
                               const Blender &By,
                               const BackwardOptions &Backward, const Look &How)
    : Launch(Launch), Choice(Backward),
      Options(trainingOptions(Convention, By, How)), Facts(How.Facts),
      Behind(How.Background),
      Drawing(Launch, Options,
              EffectPlan::forAnyScene(MaxShDegree, Options, Facts)) {
  Choice.Parameters = GradientsOf::Stored;
}

void DeviceRenderer::build(int ShDegree) {
  Launch.beginStage(Stage::Build);
  const RenderPlan Plan =
      planRender(EffectPlan::forAnyScene(ShDegree, Options, Facts), Options);
  for (const ProgramSpec &P : Plan.Programs)
    Launch.build(P);
  Choice.Windows = Plan.Effects.done(effects::Windows);
  buildBackward(Launch, ShDegree, Options, Choice);
  Back.emplace(Launch, Options, Choice, ShDegree);
  BuiltDegree = ShDegree;
}

cl::Buffer DeviceRenderer::forward(const DeviceScene &S, const Camera &C,
                                   int ShDegree) {
  if (BuiltDegree != ShDegree)
    build(ShDegree);
  Drawing.draw({S.Parameters.Geometry, S.Parameters.Sh, S.Count, {}, {}}, C);
  Launch.beginStage(Stage::Resolve);
  Picture = resolve(Launch, Drawing.frame(), Behind);
  return Picture;
}

std::vector<uint32_t> DeviceRenderer::listLengths() {
  const Frame &F = Drawing.frame();
  std::vector<std::array<uint32_t, 2>> Ranges(F.tiles());
  Launch.beginStage(Stage::ReadBack);
  Launch.read("lists' places", Ranges.data(), F.Ranges, 8 * Ranges.size());
  std::vector<uint32_t> Lengths;
  Lengths.reserve(Ranges.size());
  for (const auto &[Begin, End] : Ranges)
    Lengths.push_back(End - Begin);
  return Lengths;
}

GradientRenderer::Backward DeviceRenderer::backward(const cl::Buffer &ByRender,
                                                    const cl::Buffer &ByAlpha,
                                                    const DepthTargets &Known) {
  const Frame &F = Drawing.frame();
  Launch.beginStage(Stage::Upstream);
  Back->setUpstream(F, ByRender, ByAlpha, Behind);
  Back->run(Drawing, Known);
  return {
      {Back->gradients(), Back->shGradients()},
      {F.Records, F.Depths.Keys,
       Choice.AbsoluteSums ? Back->sums() : Back->gradients(),
       Choice.AbsoluteSums ? uint32_t{SUM_WORDS} : uint32_t{GRADIENT_MEAN_2D},
       static_cast<int>(F.View.size[0]), static_cast<int>(F.View.size[1])}};
}

} // namespace vorion::splat
