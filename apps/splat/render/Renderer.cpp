#include "Renderer.h"

#include "../effects/Registry.h"
#include "Pipeline.h"

#include <fmt/format.h>
#include <limits>

namespace vorion::splat {

namespace {

using std::uint32_t;
using std::uint64_t;

SortedPairs readPairs(Launcher &L, const Frame &F) {
  SortedPairs P;
  P.Tiles.resize(F.Pairs);
  P.Gaussians.resize(F.Pairs);
  std::vector<uint32_t> Bits(F.Gaussians.Count);
  L.read("tiles of pairs", P.Tiles.data(), F.ByTile.Keys,
         4 * uint64_t{F.Pairs});
  L.read("Gaussians of pairs", P.Gaussians.data(), F.List,
         4 * uint64_t{F.Pairs});
  L.read("depths", Bits.data(), F.Depths.Keys, 4 * uint64_t{F.Gaussians.Count});
  P.DepthBits.reserve(F.Pairs);
  for (uint32_t &G : P.Gaussians) {
    G &= ~SPANS_TILES;
    P.DepthBits.push_back(Bits[G]);
  }
  return P;
}

} // namespace

cl::Buffer resolve(Launcher &L, const Frame &F,
                   const std::array<float, 3> &Background) {
  cl::Buffer Picture = L.allocate("picture", 16 * uint64_t{F.pixels()});
  L.run(ResolveProgram, "resolve", L.device().computeUnits() * Lanes, Lanes,
        F.Pixels, Picture, 4 * F.pixels(), Background[0], Background[1],
        Background[2], F.View.effects);
  return Picture;
}

Image readPicture(Launcher &L, const Frame &F, const cl::Buffer &Picture,
                  bool Resolved) {
  Image I;
  I.Width = static_cast<int>(F.View.size[0]);
  I.Height = static_cast<int>(F.View.size[1]);
  std::vector<float> Rgba(4 * std::size_t{F.pixels()});
  L.read("picture", Rgba.data(), Picture, 4 * Rgba.size());
  I.Render.resize(3 * std::size_t{F.pixels()});
  I.Alpha.resize(F.pixels());
  for (std::size_t P = 0; P < F.pixels(); ++P) {
    for (std::size_t K = 0; K < 3; ++K)
      I.Render[3 * P + K] = Rgba[4 * P + K];
    I.Alpha[P] = Resolved ? Rgba[4 * P + 3] : 1 - Rgba[4 * P + 3];
  }
  return I;
}

Expected<RenderResult> render(Launcher &L, const RenderPlan &Plan,
                              const Scene &S, const Camera &C,
                              const RenderOptions &Options, bool KeepPairs) {
  if (S.size() > std::numeric_limits<std::int32_t>::max())
    return Error{"", "more than 2^31 - 1 Gaussians, whose numbers have 31 bits",
                 ExitCode::LimitReached};
  L.beginStage("build");
  for (const ProgramSpec &Program : Plan.Programs)
    L.build(Program);

  L.beginStage("upload");
  const GaussianBuffers Gaussians = uploadGaussians(L, S, Plan.Effects);
  Pipeline P(L, Options, Plan.Effects);
  P.draw(Gaussians, C);
  // Without a background the pixels are the picture, but for 1 - T.
  const bool Resolved = Plan.Effects.done(effects::Background);
  cl::Buffer Picture = P.frame().Pixels;
  if (Resolved) {
    L.beginStage("resolve");
    Picture = resolve(L, P.frame(), Options.Background);
  }
  L.beginStage("read back");
  RenderResult R;
  R.Visible = P.frame().Visible;
  R.Pairs = P.frame().Pairs;
  R.Culled = P.frame().Culled;
  R.Picture = readPicture(L, P.frame(), Picture, Resolved);
  if (KeepPairs)
    R.Sorted = readPairs(L, P.frame());
  if (L.failure())
    return *L.failure();
  R.DeviceBytes = L.allocatedBytes();
  R.Stages = L.takeStages();
  return R;
}

} // namespace vorion::splat
