#include "render/Backward.h"

#include "effects/Registry.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace vorion::splat {

namespace {

constexpr const char *UpstreamProgram = "upstream";
constexpr const char *BlendBackwardProgram = "blend backward";
constexpr const char *ReduceProgram = "reduce";
constexpr const char *ProjectBackwardProgram = "project backward";

} // namespace

std::vector<ProgramSpec> planBackward(int ShDegree, const RenderOptions &O,
                                      const BackwardOptions &B) {
  const bool Gsplat = O.Convention == Rules::Gsplat;
  ProgramSpec Blend{BlendBackwardProgram, {"layout.h"}, tileDefines(O)};
  if (O.Blending == Path::Raster) {
    Blend.Files.insert(Blend.Files.end(), {"deal.cl", "rasterize_backward.cl"});
  } else {
    Blend.Files.insert(Blend.Files.end(), {"falloff.cl", "blend_backward.cl"});
    Blend.Defines.push_back(minPowerDefine(O));
    Blend.Defines.push_back(alphaCutoffDefine(O));
    if (Gsplat)
      Blend.Defines.emplace_back("CLAMP_STOPS");
  }
  ProgramSpec Project{ProjectBackwardProgram,
                      {"layout.h", "activate.cl", "covariance.cl", "planes.h",
                       "sh_basis.h", "sh_backward.cl"},
                      projectionDefines(ShDegree, O)};
  std::ranges::copy(lensFiles(O), std::back_inserter(Project.Files));
  Project.Files.emplace_back("project_backward.cl");
  if (const Effect *Lens = effects::lensOf(O.Optics))
    Project.Defines.push_back(fmt::format("{}=1", Lens->Macro));
  if (Gsplat)
    Project.Defines.emplace_back("LIMIT_FOLLOWS_DEPTH");
  if (B.Parameters == GradientsOf::Stored)
    Project.Defines.emplace_back("STORED_PARAMETERS");
  ProgramSpec Reduce{
      ReduceProgram, {"layout.h", "activate.cl", "reduce.cl"}, {}};
  if (B.AbsoluteSums)
    for (ProgramSpec *P : {&Blend, &Reduce})
      P->Defines.emplace_back("ABSOLUTE_SUMS=2");
  return {{UpstreamProgram, {"upstream.cl"}, {}}, Blend, Reduce, Project};
}

void BackwardPipeline::setUpstream(const Frame &F, const cl::Buffer &ByRender,
                                   const cl::Buffer &ByAlpha,
                                   const std::array<float, 3> &Background) {
  Upstream = Launch.allocate("pixels' gradients", 16 * uint64_t{F.pixels()});
  Launch.run(UpstreamProgram, "upstream", itemsFor(F.pixels()), GroupSize,
             ByRender, ByAlpha, Upstream, F.pixels(), Background[0],
             Background[1], Background[2]);
}

void BackwardPipeline::run(Pipeline &Forward) {
  const Frame &F = Forward.frame();
  Launch.beginStage(Stage::BlendBackward);
  blend(Forward);
  Launch.beginStage(Stage::Reduce);
  reduce(F);
  Launch.beginStage(Stage::ProjectBackward);
  project(F);
}

void BackwardPipeline::blend(Pipeline &Forward) {
  const Frame &F = Forward.frame();
  PairSums =
      Launch.allocate("pairs' sums", 4 * Choice.sums() * uint64_t{F.Pairs});
  if (Options.Blending == Path::Simt) {
    Launch.run(BlendBackwardProgram, "blend_backward",
               cl::NDRange(F.View.tiles[0] * Lanes, F.View.tiles[1]),
               cl::NDRange(Lanes, 1), F.Records, F.List, F.Ranges, F.Pixels,
               F.Last, Upstream, F.ByTile.Values, PairSums, F.View.size[0],
               F.View.size[1]);
    return;
  }
  // vr_backward of docs/isa.md: reciprocal unit, alpha's clamp, gather.
  const auto Backward = static_cast<uint32_t>(
      static_cast<uint32_t>(Choice.Unit) |
      (Options.Convention == Rules::Gsplat ? 1U << 3 : 0U) |
      (Choice.Order == GatherOrder::Rows ? 1U << 4 : 0U));
  const std::size_t Cores = Launch.device().computeUnits();
  const cl::Buffer Statuses = Launch.allocate("cores' statuses", 4 * Cores);
  Launch.run(BlendBackwardProgram, "rasterize_backward", Cores * Lanes, Lanes,
             F.Records, F.List, F.Ranges, F.TileOrder, F.Pixels, F.Last,
             Upstream, F.ByTile.Values, PairSums, Statuses,
             Forward.blendOptions(), Backward);
  Forward.checkStatuses(Statuses);
}

void BackwardPipeline::reduce(const Frame &F) {
  const uint32_t Count = F.drawn();
  Sums =
      Launch.allocate("Gaussians' sums", 4 * Choice.sums() * uint64_t{Count});
  Launch.run(ReduceProgram, "reduce_sums", itemsFor(F.Visible), GroupSize,
             PairSums, F.Order, F.Places, Sums, F.Visible, Count);
}

void BackwardPipeline::project(const Frame &F) {
  const uint32_t Count = F.Gaussians.Count;
  Gradients =
      Launch.allocate("gradients", 4 * GRADIENT_PLANES * uint64_t{Count});
  ShGradients = Launch.allocate(
      "colours' gradients", 4 * 3 * shCoefficients(ShDegree) * uint64_t{Count});
  Launch.run(ProjectBackwardProgram, "project_backward", itemsFor(Count),
             GroupSize, F.Camera, F.Gaussians.Geometry, F.Gaussians.Sh,
             F.Records, F.Depths.Keys, Sums, Gradients, ShGradients, Count);
}

} // namespace vorion::splat
