#include "render/Backward.h"

#include "effects/Registry.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace vorion::splat {

namespace {

#include "kernels/pose.h"

constexpr const char *UpstreamProgram = "upstream";
constexpr const char *BlendBackwardProgram = "blend backward";
constexpr const char *ReduceProgram = "reduce";
constexpr const char *ProjectBackwardProgram = "project backward";
constexpr const char *DepthLossProgram = "depth loss";

} // namespace

std::vector<ProgramSpec> planBackward(int ShDegree, const RenderOptions &O,
                                      const BackwardOptions &B) {
  const bool Gsplat = O.Convention == Rules::Gsplat;
  ProgramSpec Blend{BlendBackwardProgram, "rasterize_backward.cl",
                    tileDefines(O)};
  if (B.Windows)
    Blend.Defines.push_back(fmt::format("{}=1", effects::Windows.Macro));
  if (O.Blending == Path::Simt) {
    if (B.Pixels == SimtSums::Ordered) {
      Blend.File = "blend_backward.cl";
      Blend.Defines.emplace_back("RECORD_SPACE=__global");
    } else {
      Blend.File = "blend_backward_atomics.cl";
      if (B.Pixels == SimtSums::Warp)
        Blend.Defines.emplace_back("WARP_SUMS");
      Blend.Defines.emplace_back("RECORD_SPACE=__local");
    }
    Blend.Defines.push_back(minPowerDefine(O));
    Blend.Defines.push_back(alphaCutoffDefine(O));
    if (Gsplat)
      Blend.Defines.emplace_back("CLAMP_STOPS");
  }
  ProgramSpec Project{ProjectBackwardProgram, "project_backward.cl",
                      projectionDefines(ShDegree, O)};
  const auto Has = [&Project](const Effect &E) {
    Project.Defines.push_back(fmt::format("{}=1", E.Macro));
  };
  if (const Effect *Lens = effects::lensOf(O.Optics))
    Has(*Lens);
  if (O.Rolling)
    Has(effects::RollingShutter);
  if (O.Through == Spread::Unscented) {
    Has(effects::Unscented);
    Project.Defines.push_back(keepDepthDefine(O));
  }
  if (B.Needles)
    Has(effects::Needles);
  if (Gsplat)
    Project.Defines.emplace_back("LIMIT_FOLLOWS_DEPTH");
  if (B.Parameters == GradientsOf::Stored)
    Project.Defines.emplace_back("STORED_PARAMETERS");
  if (B.Poses)
    Project.Defines.emplace_back("POSES");
  ProgramSpec Reduce{ReduceProgram, "reduce.cl", {}};
  if (B.AbsoluteSums)
    for (ProgramSpec *P : {&Blend, &Reduce})
      P->Defines.emplace_back("ABSOLUTE_SUMS=2");
  std::vector<ProgramSpec> Programs{
      {UpstreamProgram, "upstream.cl", {}}, Blend, Reduce, Project};
  if (B.Depths)
    Programs.push_back({DepthLossProgram, "depth_loss.cl", {}});
  return Programs;
}

void buildBackward(Launcher &Launch, int ShDegree, const RenderOptions &O,
                   const BackwardOptions &B) {
  const Device &D = Launch.device();
  if (O.Blending == Path::Simt && B.Pixels == SimtSums::Warp &&
      D.lanes() != Lanes)
    Launch.fail({"",
                 fmt::format("{} has warps of {}, expected {} lanes for "
                             "--simt-sums warp",
                             D.name(), counted(D.lanes(), "lane"), Lanes),
                 ExitCode::Usage});
  for (const ProgramSpec &Program : planBackward(ShDegree, O, B))
    Launch.build(Program);
}

void BackwardPipeline::setUpstream(const Frame &F, const cl::Buffer &ByRender,
                                   const cl::Buffer &ByAlpha,
                                   const std::array<float, 3> &Background) {
  Upstream = Launch.allocate("pixels' gradients", 16 * uint64_t{F.pixels()});
  Launch.run(UpstreamProgram, "upstream", itemsFor(F.pixels()), GroupSize,
             ByRender, ByAlpha, Upstream, F.pixels(), Background[0],
             Background[1], Background[2]);
}

void BackwardPipeline::run(Pipeline &Forward, const DepthTargets &Known) {
  const Frame &F = Forward.frame();
  Launch.beginStage(Stage::BlendBackward);
  Sums = sumsOf(Forward, F, Upstream, true);
  const cl::Buffer Deep =
      Known.any() ? depthSums(Forward, Known) : cl::Buffer();
  Launch.beginStage(Stage::ProjectBackward);
  project(F);
  if (Known.any())
    Launch.run(DepthLossProgram, "depth_to_mean", itemsFor(F.Gaussians.Count),
               GroupSize, F.Camera, Deep, F.Depths.Keys, Gradients,
               F.Gaussians.Count);
}

/// What blending depths gives back; of shapes it is added to \c Sums.
cl::Buffer BackwardPipeline::depthSums(Pipeline &Forward,
                                       const DepthTargets &Known) {
  const Frame &F = Forward.frame();
  const uint32_t Count = F.drawn();
  const auto Points = static_cast<uint32_t>(Known.Points->size());
  Launch.beginStage(Stage::Depth);
  const cl::Buffer Records = Launch.allocate(
      "Gaussians with depths", sizeof(splat_gaussian) * uint64_t{Count});
  Launch.run(DepthLossProgram, "depth_records", itemsFor(Count), GroupSize,
             F.Depths.Keys, F.Records, Records, Count);
  const Frame Deep = Forward.drawBeside(Records);
  const cl::Buffer Given =
      Launch.allocate("known depths", sizeof(DepthPoint) * uint64_t{Points});
  Launch.write("known depths", Given, Known.Points->data(),
               sizeof(DepthPoint) * uint64_t{Points});
  const cl::Buffer By =
      Launch.allocate("pixels' gradients", 16 * uint64_t{F.pixels()});
  Launch.run(DepthLossProgram, "depth_clear", itemsFor(F.pixels()), GroupSize,
             By, F.pixels());
  Launch.run(DepthLossProgram, "depth_loss", itemsFor(Points), GroupSize, Given,
             Points, Deep.Pixels, By, Known.Weight);
  const cl::Buffer Found = sumsOf(Forward, Deep, By, false);
  Launch.run(DepthLossProgram, "depth_add", itemsFor(Count), GroupSize, Sums,
             Found, F.Depths.Keys, Count);
  return Found;
}

/// Back through blending, from \p By, dL/d(pixels). \p AsStages: the sum over
/// tiles is a stage.
cl::Buffer BackwardPipeline::sumsOf(Pipeline &Forward, const Frame &F,
                                    const cl::Buffer &By, bool AsStages) {
  if (Choice.Pixels != SimtSums::Ordered)
    return sumsByAtomics(F, By);
  blend(Forward, F, By);
  if (AsStages)
    Launch.beginStage(Stage::Reduce);
  return reduce(F);
}

cl::Buffer BackwardPipeline::sumsByAtomics(const Frame &F,
                                           const cl::Buffer &By) {
  const uint32_t Words = Choice.sums() * F.drawn();
  cl::Buffer Found = Launch.allocate("Gaussians' sums", 4 * uint64_t{Words});
  Launch.run(BlendBackwardProgram, "clear_sums", itemsFor(Words), GroupSize,
             Found, Words);
  const uint32_t Items = Options.SimtTile * Options.SimtTile;
  Launch.run(BlendBackwardProgram, "blend_backward_atomics",
             cl::NDRange(F.View.tiles[0] * Items, F.View.tiles[1]),
             cl::NDRange(Items, 1), F.Blended, F.List, F.Ranges, F.Pixels,
             F.Last, By, Found, F.drawn(), F.View.size[0], F.View.size[1]);
  return Found;
}

void BackwardPipeline::blend(Pipeline &Forward, const Frame &F,
                             const cl::Buffer &By) {
  PairSums =
      Launch.allocate("pairs' sums", 4 * Choice.sums() * uint64_t{F.Pairs});
  if (Options.Blending == Path::Simt) {
    Launch.run(BlendBackwardProgram, "blend_backward",
               cl::NDRange(F.View.tiles[0] * Lanes, F.View.tiles[1]),
               cl::NDRange(Lanes, 1), F.Blended, F.List, F.Ranges, F.Pixels,
               F.Last, By, F.ByTile.Values, PairSums, F.View.size[0],
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
             F.Blended, F.List, F.Ranges, F.TileOrder, F.Pixels, F.Last, By,
             F.ByTile.Values, PairSums, Statuses, Forward.blendOptions(),
             Backward);
  Forward.checkStatuses(Statuses);
}

cl::Buffer BackwardPipeline::reduce(const Frame &F) {
  const uint32_t Count = F.drawn();
  cl::Buffer Found =
      Launch.allocate("Gaussians' sums", 4 * Choice.sums() * uint64_t{Count});
  Launch.run(ReduceProgram, "reduce_sums", itemsFor(F.Visible), GroupSize,
             PairSums, F.Order, F.Places, Found, F.Visible, Count);
  return Found;
}

void BackwardPipeline::project(const Frame &F) {
  const uint32_t Count = F.Gaussians.Count;
  Gradients = Launch.allocate("gradients",
                              4 *
                                  (Choice.Poses ? uint64_t{POSE_GRADIENT_PLANES}
                                                : uint64_t{GRADIENT_PLANES}) *
                                  Count);
  ShGradients = Launch.allocate(
      "colours' gradients", 4 * 3 * shCoefficients(ShDegree) * uint64_t{Count});
  Launch.run(ProjectBackwardProgram, "project_backward", itemsFor(Count),
             GroupSize, F.Camera, F.Gaussians.Geometry, F.Gaussians.Sh,
             F.Records, F.Depths.Keys, Sums, Gradients, ShGradients, Count);
}

} // namespace vorion::splat
