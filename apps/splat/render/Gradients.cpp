#include "render/Gradients.h"

#include "effects/Registry.h"
#include "picture/View.h"

namespace vorion::splat {

namespace {

/// \p Each planes of \p Planes from \p First on, interleaved.
std::vector<float> interleaved(const std::vector<float> &Planes,
                               std::size_t Count, std::size_t First,
                               std::size_t Each) {
  std::vector<float> Out(Count * Each);
  for (std::size_t I = 0; I < Count; ++I)
    for (std::size_t K = 0; K < Each; ++K)
      Out[I * Each + K] = Planes[(First + K) * Count + I];
  return Out;
}

/// The sums of Gaussians that no tile sees, which nothing writes, become 0.
void clearUnseen(Launcher &L, const Frame &F, uint32_t Words,
                 std::vector<float> &Sums) {
  const std::size_t N = F.Gaussians.Count;
  std::vector<uint32_t> Keys(N);
  L.read("depths", Keys.data(), F.Depths.Keys, 4 * N);
  for (std::size_t I = 0; I < N; ++I)
    if (Keys[I] >= CULLED)
      for (std::size_t K = 0; K < Words; ++K)
        Sums[K * N + I] = 0;
}

SceneGradients readGradients(Launcher &L, const BackwardPipeline &Back,
                             const Frame &F, RendererKind Kind,
                             int UsedDegree) {
  const std::size_t N = F.Gaussians.Count;
  const std::size_t Used = 3 * shCoefficients(UsedDegree);
  std::vector<float> Planes(GRADIENT_PLANES * N), Sh(Used * N);
  SceneGradients G;
  G.Sums.resize(recordSums(Kind) * N);
  L.read("gradients", Planes.data(), Back.gradients(), 4 * Planes.size());
  L.read("colours' gradients", Sh.data(), Back.shGradients(), 4 * Sh.size());
  L.read("sums", G.Sums.data(), Back.sums(), 4 * G.Sums.size());
  clearUnseen(L, F, recordSums(Kind), G.Sums);
  G.Means = interleaved(Planes, N, GRADIENT_MEAN, 3);
  G.Scales = interleaved(Planes, N, GRADIENT_SCALE, 3);
  G.Quats = interleaved(Planes, N, GRADIENT_QUATERNION, 4);
  G.Opacities = interleaved(Planes, N, GRADIENT_OPACITY, 1);
  G.Means2d = interleaved(Planes, N, GRADIENT_MEAN_2D, 2);
  G.Conics = interleaved(Planes, N, GRADIENT_CONIC, 3);
  G.Sh = interleaved(Sh, N, 0, Used);
  return G;
}

/// The mesh of \p F over the background, without Gaussians.
cl::Buffer meshAlone(Launcher &L, Frame F, const RenderOptions &Options) {
  std::vector<float> Clear(4 * std::size_t{F.pixels()}, 0.0F);
  for (std::size_t T = 3; T < Clear.size(); T += 4)
    Clear[T] = 1;
  F.Pixels = L.allocate("pixels without Gaussians", 4 * Clear.size());
  L.write("pixels without Gaussians", F.Pixels, Clear.data(), 4 * Clear.size());
  return resolveMesh(L, F, Options);
}

} // namespace

RenderPlan gradientPlan(const Scene &S, const Camera &C,
                        const RenderOptions &Options) {
  return planRender(
      EffectPlan::forAnyScene(
          S.ShDegree, Options,
          factsOf(S, makeView(relativeTo(C, S.Origin), Options), Options)),
      Options);
}

Expected<GradientResult> takeGradients(Launcher &L, const Scene &S,
                                       const Camera &C,
                                       const RenderOptions &Options,
                                       const BackwardOptions &Choice,
                                       const PixelGradients &U) {
  // A band of zeros has gradients too.
  const int ShDegree = S.ShDegree;
  L.beginStage(Stage::Build);
  RenderPlan Plan = gradientPlan(S, C, Options);
  for (const ProgramSpec &Program : Plan.Programs)
    L.build(Program);
  BackwardOptions Backward = Choice;
  Backward.Windows = Plan.Effects.done(effects::Windows);
  Backward.Needles = Plan.Effects.done(effects::Needles);
  buildBackward(L, ShDegree, Options, Backward);
  if (L.failure())
    return *L.failure();

  L.beginStage(Stage::Upload);
  GaussianBuffers Gaussians = uploadGaussians(L, S, ShDegree);
  const bool HasMesh = Plan.Effects.done(effects::Mesh);
  if (HasMesh)
    Gaussians.Surface = uploadMesh(L, *Options.Surface, Plan.Effects);
  const cl::Buffer ByRender =
      L.allocate("pictures' gradients", 4 * U.Render.size());
  const cl::Buffer ByAlpha =
      L.allocate("alphas' gradients", 4 * U.Alpha.size());
  L.write("pictures' gradients", ByRender, U.Render.data(),
          4 * U.Render.size());
  L.write("alphas' gradients", ByAlpha, U.Alpha.data(), 4 * U.Alpha.size());

  Pipeline Forward(L, Options, Plan.Effects);
  Forward.draw(Gaussians, C);
  BackwardPipeline Back(L, Options, Backward, ShDegree);
  L.beginStage(Stage::Upstream);
  Back.setUpstream(Forward.frame(), ByRender, ByAlpha, Options.Background,
                   HasMesh
                       ? std::optional(meshAlone(L, Forward.frame(), Options))
                       : std::nullopt);
  Back.run(Forward);

  L.beginStage(Stage::Resolve);
  const cl::Buffer Picture =
      HasMesh ? resolveMesh(L, Forward.frame(), Options)
              : resolve(L, Forward.frame(), Options.Background);
  L.beginStage(Stage::ReadBack);
  GradientResult R;
  R.Picture = readPicture(L, Forward.frame(), Picture);
  R.Gradients = readGradients(L, Back, Forward.frame(), Options.Kind, ShDegree);
  if (Options.KeepVisible)
    R.MeshShown = readVisible(L, Forward.frame(), Options);
  if (L.failure())
    return *L.failure();
  R.Visible = Forward.frame().seen();
  R.Pairs = Forward.frame().Pairs;
  R.Culled = Forward.frame().Culled;
  R.DeviceBytes = L.mostBytes();
  R.Stages = L.takeStages();
  return R;
}

} // namespace vorion::splat
