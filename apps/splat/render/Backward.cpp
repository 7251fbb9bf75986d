#include "render/Backward.h"

#include "effects/Registry.h"
#include "kernels/blend_backward.cl.h"
#include "kernels/blend_backward_atomics.cl.h"
#include "kernels/depth_loss.cl.h"
#include "kernels/project_backward.cl.h"
#include "kernels/rasterize_backward.cl.h"
#include "kernels/reduce.cl.h"
#include "kernels/upstream.cl.h"
#include "render/Choices.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace vorion::splat {

namespace {

#include "kernels/pose.h"

} // namespace

std::vector<ProgramSpec> planBackward(int ShDegree, const RenderOptions &O,
                                      const BackwardOptions &B) {
  const EffectSwitch On = EffectSwitch::compiled();
  std::vector<ProgramSpec> Programs{kernels::upstream::Program{
      .USE_MESH = O.Surface ? On : EffectSwitch::absent()}};
  const std::optional<cl_uint> AbsoluteSums =
      B.AbsoluteSums ? std::optional(2U) : std::nullopt;
  const EffectSwitch Rays = hasRayRecords(O.Kind) ? On : EffectSwitch::absent();
  const EffectSwitch Surfels =
      O.Kind == RendererKind::Surfel ? On : EffectSwitch::absent();
  const EffectSwitch Degree4 =
      O.FalloffDegree == 4 ? On : EffectSwitch::absent();
  const auto AddBlending = [&](auto Program) {
    choose(Program, O);
    Program.USE_RAYS = Rays;
    Program.USE_SURFELS = Surfels;
    if constexpr (requires { Program.USE_DEGREE4; })
      Program.USE_DEGREE4 = Degree4;
    if (B.Windows)
      Program.USE_WINDOWS = On;
    if constexpr (requires { Program.ABSOLUTE_SUMS; })
      Program.ABSOLUTE_SUMS = AbsoluteSums;
    Programs.push_back(Program);
  };
  if (O.Blending == Path::Raster)
    AddBlending(kernels::rasterize_backward::Program{});
  else if (B.Pixels == SimtSums::Ordered)
    AddBlending(kernels::blend_backward::Program{});
  else
    AddBlending(kernels::blend_backward_atomics::Program{
        .WARP_SUMS = B.Pixels == SimtSums::Warp});
  Programs.push_back(kernels::reduce::Program{
      .ABSOLUTE_SUMS = AbsoluteSums, .USE_RAYS = Rays, .USE_SURFELS = Surfels});
  kernels::project_backward::Program Project{
      .SH_DEGREE = static_cast<cl_uint>(ShDegree),
      .STORED_PARAMETERS = B.Parameters == GradientsOf::Stored,
      .POSES = B.Poses,
      .USE_DEGREE4 = Degree4,
      .USE_RAYS = Rays,
      .USE_SURFELS = Surfels};
  choose(Project, O);
  if (const Effect *Lens = effects::lensOf(*O.Optics))
    compile(Project, *Lens);
  if (O.Rolling)
    Project.USE_ROLLING_SHUTTER = On;
  if (O.Through == Spread::Unscented)
    Project.USE_UNSCENTED = On;
  if (B.Needles)
    Project.USE_NEEDLES = On;
  Programs.push_back(Project);
  if (B.Depths)
    Programs.push_back(kernels::depth_loss::Program{});
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
                                   const std::array<float, 3> &Background,
                                   const std::optional<cl::Buffer> &Behind) {
  Upstream = Launch.allocate("pixels' gradients", 16 * uint64_t{F.pixels()});
  Launch.run(itemsFor(F.pixels()), GroupSize,
             kernels::upstream::upstream{.by_render = ByRender,
                                         .by_alpha = ByAlpha,
                                         .gradients = Upstream,
                                         .count = F.pixels(),
                                         .behind = Behind,
                                         .red = Background[0],
                                         .green = Background[1],
                                         .blue = Background[2]});
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
    Launch.run(itemsFor(F.Gaussians.Count), GroupSize,
               kernels::depth_loss::depth_to_mean{.view = F.Camera,
                                                  .deep = Deep,
                                                  .depths = F.Depths.Keys,
                                                  .gradients = Gradients,
                                                  .count = F.Gaussians.Count});
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
  Launch.run(itemsFor(Count), GroupSize,
             kernels::depth_loss::depth_records{.depths = F.Depths.Keys,
                                                .records = F.Records,
                                                .to = Records,
                                                .count = Count});
  const Frame Deep = Forward.drawBeside(Records);
  const cl::Buffer Given =
      Launch.allocate("known depths", sizeof(DepthPoint) * uint64_t{Points});
  Launch.write("known depths", Given, Known.Points->data(),
               sizeof(DepthPoint) * uint64_t{Points});
  const cl::Buffer By =
      Launch.allocate("pixels' gradients", 16 * uint64_t{F.pixels()});
  Launch.run(
      itemsFor(F.pixels()), GroupSize,
      kernels::depth_loss::depth_clear{.upstream = By, .pixels = F.pixels()});
  Launch.run(itemsFor(Points), GroupSize,
             kernels::depth_loss::depth_loss{.points = Given,
                                             .count = Points,
                                             .pixels = Deep.Pixels,
                                             .upstream = By,
                                             .weight = Known.Weight});
  const cl::Buffer Found = sumsOf(Forward, Deep, By, false);
  Launch.run(itemsFor(Count), GroupSize,
             kernels::depth_loss::depth_add{.sums = Sums,
                                            .deep = Found,
                                            .depths = F.Depths.Keys,
                                            .count = Count});
  return Found;
}

/// Back through blending, from \p By, dL/d(pixels). \p AsStages: the sum over
/// tiles is a stage.
cl::Buffer BackwardPipeline::sumsOf(Pipeline &Forward, const Frame &F,
                                    const cl::Buffer &By, bool AsStages) {
  if (Choice.Pixels != SimtSums::Ordered)
    return sumsByAtomics(F, By);
  blend(Forward, F, By);
  // The reduction then adds in the same order in all processes.
  if (TileDivision *const Division = Forward.division())
    Division->completePairs(F, PairSums, Choice.sums(Options.Kind));
  if (AsStages)
    Launch.beginStage(Stage::Reduce);
  return reduce(F);
}

cl::Buffer BackwardPipeline::sumsByAtomics(const Frame &F,
                                           const cl::Buffer &By) {
  const uint32_t Words = Choice.sums(Options.Kind) * F.drawn();
  cl::Buffer Found = Launch.allocate("Gaussians' sums", 4 * uint64_t{Words});
  Launch.run(itemsFor(Words), GroupSize,
             kernels::blend_backward_atomics::clear_sums{.sums = Found,
                                                         .words = Words});
  const uint32_t Items = Options.tileSize() * Options.tileSize();
  Launch.run(cl::NDRange(F.View.tiles[0] * Items, F.View.tiles[1]),
             cl::NDRange(Items, 1),
             kernels::blend_backward_atomics::blend_backward_atomics{
                 .records = F.Blended,
                 .list = F.List,
                 .ranges = F.Ranges,
                 .pixels = F.Pixels,
                 .last = F.Last,
                 .upstream = By,
                 .sums = Found,
                 .count = F.drawn(),
                 .width = F.View.size[0],
                 .height = F.View.size[1]});
  return Found;
}

void BackwardPipeline::blend(Pipeline &Forward, const Frame &F,
                             const cl::Buffer &By) {
  PairSums = Launch.allocate("pairs' sums",
                             4 * Choice.sums(Options.Kind) * uint64_t{F.Pairs});
  if (Options.Blending == Path::Simt) {
    Launch.run(
        cl::NDRange(F.View.tiles[0] * Lanes, F.View.tiles[1]),
        cl::NDRange(Lanes, 1),
        kernels::blend_backward::blend_backward{.records = F.Blended,
                                                .list = F.List,
                                                .ranges = F.Ranges,
                                                .pixels = F.Pixels,
                                                .last = F.Last,
                                                .upstream = By,
                                                .places = F.ByTile.Values,
                                                .sums = PairSums,
                                                .width = F.View.size[0],
                                                .height = F.View.size[1]});
    return;
  }
  // vr_backward of docs/isa.md: reciprocal unit, alpha's clamp, gather.
  const auto Backward = static_cast<uint32_t>(
      static_cast<uint32_t>(Choice.Unit) |
      (Options.Convention == Rules::Gsplat ? 1U << 3 : 0U) |
      (Choice.Order == GatherOrder::Rows ? 1U << 4 : 0U));
  const std::size_t Cores = Launch.device().computeUnits();
  const cl::Buffer Statuses = Launch.allocate("cores' statuses", 4 * Cores);
  Launch.run(Cores * Lanes, Lanes,
             kernels::rasterize_backward::rasterize_backward{
                 .records = F.Blended,
                 .list = F.List,
                 .ranges = F.Ranges,
                 .tile_order = F.TileOrder,
                 .pixels = F.Pixels,
                 .last = F.Last,
                 .upstream = By,
                 .places = F.ByTile.Values,
                 .sums = PairSums,
                 .statuses = Statuses,
                 .options = Forward.blendOptions(),
                 .backward = Backward});
  Forward.checkStatuses(Statuses);
}

cl::Buffer BackwardPipeline::reduce(const Frame &F) {
  const uint32_t Count = F.drawn();
  cl::Buffer Found = Launch.allocate(
      "Gaussians' sums", 4 * Choice.sums(Options.Kind) * uint64_t{Count});
  Launch.run(itemsFor(F.Visible), GroupSize,
             kernels::reduce::reduce_sums{.pair_sums = PairSums,
                                          .order = F.Order,
                                          .offsets = F.Places,
                                          .sums = Found,
                                          .seen = F.Visible,
                                          .count = Count});
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
  Launch.run(itemsFor(Count), GroupSize,
             kernels::project_backward::project_backward{
                 .view = F.Camera,
                 .geometry = F.Gaussians.Geometry,
                 .sh = F.Gaussians.Sh,
                 .records = F.Records,
                 .depths = F.Depths.Keys,
                 .sums = Sums,
                 .gradients = Gradients,
                 .sh_gradients = ShGradients,
                 .count = Count});
}

} // namespace vorion::splat
