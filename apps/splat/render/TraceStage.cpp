// The stages of traced rays: shapes of Gaussians, a tree of their boxes, rays
// through it, and those that a mirror reflects.
#include "effects/Registry.h"
#include "kernels/bvh.cl.h"
#include "kernels/mirror.cl.h"
#include "kernels/trace.cl.h"
#include "kernels/trace_rays.cl.h"
#include "kernels/trace_shapes.cl.h"
#include "mesh/Mesh.h"
#include "picture/View.h"
#include "render/Pipeline.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace vorion::splat {

/// Bits of a Morton code.
static constexpr uint32_t CodeBits = 30;

static splat_tree treeOf(uint32_t Gaussians) {
  splat_tree T{4, Gaussians, 2};
  while (T.leaves < Gaussians)
    T.leaves *= 4;
  T.gap = T.leaves / 2;
  return T;
}

void Pipeline::trace(const Camera &C) {
  if (!Launch.device().isVorion())
    return Launch.fail({"", "--renderer trace: a device without Vorion's "
                            "headers, expected a Vorion"});
  if (Launch.failure())
    return;
  Launch.beginStage(Stage::Project);
  writeCamera(C);
  shape(C);
  if (Launch.failure())
    return;
  Launch.beginStage(Stage::BuildTree);
  buildTree();
  if (Launch.failure())
    return;
  if (Plan.done(effects::Mesh)) {
    Launch.beginStage(Stage::Mesh);
    showMesh();
  }
  if (Launch.failure())
    return;
  Launch.beginStage(Stage::Trace);
  traceRays(C);
}

void Pipeline::shape(const Camera &C) {
  const uint32_t Count = Current.Gaussians.Count;
  TraceFrame &To = Current.Traced;
  To.Shapes = Launch.allocate("Gaussians for rays",
                              sizeof(splat_traced) * uint64_t{Count});
  To.Boxes = words("boxes", BOX_WORDS * uint64_t{Count});
  To.Colors = Launch.allocate("colours for rays", 16 * uint64_t{Count});
  Current.Depths.Keys = words("codes", Count);
  const std::size_t Items = Launch.device().groupsAtOnce() * Lanes;
  const cl::Buffer Seen =
      Launch.allocate("what is met", sizeof(splat_shapes_seen) * Items);
  Launch.run(Items, Lanes,
             kernels::trace_shapes::trace_shapes{
                 .view = Current.Camera,
                 .geometries = Current.Gaussians.Geometry,
                 .colors_of_planes = Current.Gaussians.Sh,
                 .shapes = To.Shapes,
                 .boxes = To.Boxes,
                 .colors = To.Colors,
                 .keys = Current.Depths.Keys,
                 .items = Seen,
                 .count = Count,
                 .slack = rayOriginRounding(C)});
  std::vector<splat_shapes_seen> Host(Items);
  Launch.read("what is met", Host.data(), Seen,
              sizeof(splat_shapes_seen) * Items);
  double Distance = 0;
  for (const splat_shapes_seen &One : Host) {
    Current.Visible += One.gaussians;
    Distance += One.distance;
    for (std::size_t R = 0; R < Current.Culled.size(); ++R)
      Current.Culled[R] += One.culled[R];
  }
  // A coordinate's mean, and in fp32's range.
  To.Distance = static_cast<float>(std::clamp(
      Distance / (3.0 * std::max(1U, Current.Visible)), 1e-30, 1e30));
}

void Pipeline::buildTree() {
  TraceFrame &To = Current.Traced;
  const uint32_t Count = Current.Gaussians.Count;
  Launch.run(itemsFor(Count), GroupSize,
             kernels::bvh::bvh_codes{.view = Current.Camera,
                                     .shapes = To.Shapes,
                                     .keys = Current.Depths.Keys,
                                     .count = Count,
                                     .distance = To.Distance});
  Current.Order = Sort.sortKept(Current.Depths.Keys, {Count, Current.Visible, 0,
                                                      (1U << CodeBits) - 1, 0});
  To.Tree = treeOf(Current.Visible);
  const splat_tree &T = To.Tree;
  const uint32_t Leaves = (T.count + 3) / 4 * 4;
  To.Nodes = words("tree", BOX_WORDS * (uint64_t{T.leaves} - T.gap + Leaves));
  To.Leaves = words("leaves", Count);
  if (T.count == 0)
    return;
  Launch.run(itemsFor(Leaves), GroupSize,
             kernels::bvh::bvh_leaves{.order = Current.Order,
                                      .boxes = To.Boxes,
                                      .nodes = To.Nodes,
                                      .leaves = To.Leaves,
                                      .tree = T});
  uint32_t Below = Leaves;
  for (uint32_t First = T.leaves / 4; First != 0; First /= 4) {
    Launch.run(
        itemsFor(First), GroupSize,
        kernels::bvh::bvh_level{
            .nodes = To.Nodes, .first = First, .below = Below, .tree = T});
    Below = (Below + 3) / 4;
  }
}

/// Rays that are affine in the pixel are computed, others are a table.
void Pipeline::castRays(const Camera &C) {
  const uint32_t Rays = Current.pixels();
  const cl::Buffer To = Current.Traced.Rays =
      words("rays", RAY_PLANES * uint64_t{Rays});
  if (!hasAffineRays(C)) {
    const std::vector<float> Table = makeRayTable(C, Options.nearLimit());
    return Launch.write("rays", To, Table.data(), 4 * Table.size());
  }
  const splat_ray_source From = makeRays(C);
  const cl::Buffer Source = Launch.allocate("source of rays", sizeof From);
  Launch.write("source of rays", Source, &From, sizeof From);
  Launch.run(itemsFor(Rays), GroupSize,
             kernels::trace_rays::trace_rays{.source = Source,
                                             .rays = To,
                                             .width = Current.View.size[0],
                                             .count = Rays,
                                             .nearest = Options.nearLimit()});
}

void Pipeline::traceRays(const Camera &C) {
  TraceFrame &To = Current.Traced;
  castRays(C);
  const uint32_t Rays = Current.pixels();
  Current.Pixels = Launch.allocate("pixels", 16 * uint64_t{Rays});
  To.Work =
      Launch.allocate("work of rays", sizeof(splat_ray_work) * uint64_t{Rays});
  const bool HasMirror = Plan.done(effects::Mesh);
  const cl::Buffer Reflected = HasMirror ? reflect(Rays) : cl::Buffer();
  traceThrough(To.Rays, /*Onward=*/false);
  if (HasMirror)
    traceThrough(Reflected, /*Onward=*/true);
}

/// What the rays of a buffer take becomes pixels, or is added to them.
void Pipeline::traceThrough(const cl::Buffer &Rays, bool Onward) {
  const TraceFrame &To = Current.Traced;
  // A warp takes 4x4 rays.
  const auto Blocks = [](uint32_t Pixels) {
    return std::size_t{Pixels + 3} / 4;
  };
  Launch.run(cl::NDRange(Blocks(Current.View.size[0]) * Lanes,
                         Blocks(Current.View.size[1])),
             cl::NDRange(Lanes, 1),
             kernels::trace::trace{.rays = Rays,
                                   .nodes = To.Nodes,
                                   .order = Current.Order,
                                   .leaves = To.Leaves,
                                   .shapes = To.Shapes,
                                   .colors = To.Colors,
                                   .pixels = Current.Pixels,
                                   .work = To.Work,
                                   .tree = To.Tree,
                                   .width = Current.View.size[0],
                                   .height = Current.View.size[1],
                                   .cutoff = Options.Cutoff,
                                   .effects = Current.View.effects,
                                   .onward = cl_uint{Onward}});
}

/// The mesh ends rays, and reflects them into a buffer of their own.
cl::Buffer Pipeline::reflect(uint32_t Rays) {
  const MeshBuffers &M = Current.Gaussians.Surface;
  const cl::Buffer Reflected =
      words("reflected rays", RAY_PLANES * uint64_t{Rays});
  Launch.run(itemsFor(Rays), GroupSize,
             kernels::mirror::mirror{.camera = Current.Camera,
                                     .points = Current.Surface.Points,
                                     .corners = M.Corners,
                                     .normals = *M.Normals,
                                     .visible = Current.Surface.Visible,
                                     .rays = Current.Traced.Rays,
                                     .reflected = Reflected,
                                     .count = Rays});
  return Reflected;
}

RayWork readRayWork(Launcher &Launch, const Frame &F) {
  std::vector<splat_ray_work> Rays(F.pixels());
  Launch.read("work of rays", Rays.data(), F.Traced.Work,
              sizeof(splat_ray_work) * Rays.size());
  RayWork Sum;
  Sum.Rays = Rays.size();
  for (const splat_ray_work &R : Rays) {
    Sum.Nodes += R.nodes;
    Sum.Evaluated += R.evaluated;
    Sum.Blended += R.blended;
    Sum.Restarts += std::max(1U, R.passes) - 1;
    Sum.MostBlended = std::max(Sum.MostBlended, R.blended);
  }
  return Sum;
}

} // namespace vorion::splat
