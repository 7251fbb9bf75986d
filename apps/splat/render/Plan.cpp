#include "render/Plan.h"

#include "effects/Registry.h"
#include "kernels/activate_scene.cl.h"
#include "kernels/blend.cl.h"
#include "kernels/blend_by_ray.cl.h"
#include "kernels/bvh.cl.h"
#include "kernels/cull_blocks.cl.h"
#include "kernels/depth.cl.h"
#include "kernels/merge.cl.h"
#include "kernels/mesh.cl.h"
#include "kernels/mesh_fragments.cl.h"
#include "kernels/mesh_fragments_simt.cl.h"
#include "kernels/mesh_layers.cl.h"
#include "kernels/mesh_raster.cl.h"
#include "kernels/mesh_simt.cl.h"
#include "kernels/mirror.cl.h"
#include "kernels/normals.cl.h"
#include "kernels/project.cl.h"
#include "kernels/rasterize.cl.h"
#include "kernels/ray_frames.cl.h"
#include "kernels/resolve.cl.h"
#include "kernels/scan.cl.h"
#include "kernels/sort.cl.h"
#include "kernels/tiles.cl.h"
#include "kernels/trace.cl.h"
#include "kernels/trace_rays.cl.h"
#include "kernels/trace_shapes.cl.h"
#include "kernels/windows.cl.h"
#include "render/Choices.h"

#include <utility>

namespace vorion::splat {

/// From Gaussians to pixels by lists of tiles.
template <typename Function>
static void addLists(const Function &Add, const EffectPlan &Effects,
                     const RenderOptions &Options) {
  Add(kernels::project::Program{});
  Add(kernels::sort::Program{});
  Add(kernels::tiles::Program{});
  const bool ByRay = Effects.done(effects::RayOrder);
  if (Options.Blending == Path::Raster)
    Add(kernels::rasterize::Program{});
  else if (ByRay)
    Add(kernels::blend_by_ray::Program{});
  else
    Add(kernels::blend::Program{});
  if (ByRay)
    Add(kernels::ray_frames::Program{});
  if (Effects.done(effects::Mesh)) {
    Add(kernels::scan::Program{});
    Add(kernels::mesh::Program{});
    if (Options.Blending == Path::Raster)
      Add(kernels::mesh_raster::Program{});
    else
      Add(kernels::mesh_simt::Program{});
    if (Effects.done(effects::Layers)) {
      Add(kernels::mesh_layers::Program{});
      if (Options.Blending == Path::Raster)
        Add(kernels::mesh_fragments::Program{});
      else
        Add(kernels::mesh_fragments_simt::Program{});
    }
  }
  if (Effects.done(effects::Windows))
    Add(kernels::windows::Program{});
}

/// From Gaussians to pixels by rays through a tree.
template <typename Function>
static void addTracing(const Function &Add, const EffectPlan &Effects) {
  Add(kernels::trace_shapes::Program{});
  Add(kernels::sort::Program{});
  Add(kernels::bvh::Program{});
  Add(kernels::trace_rays::Program{});
  Add(kernels::trace::Program{});
  if (Effects.done(effects::Mesh)) {
    Add(kernels::tiles::Program{});
    Add(kernels::scan::Program{});
    Add(kernels::mesh::Program{});
    Add(kernels::mesh_simt::Program{});
    Add(kernels::mirror::Program{});
  }
}

RenderPlan planRender(EffectPlan Effects, const RenderOptions &Options) {
  RenderPlan Plan{std::move(Effects), {}};
  const auto Add = [&](auto Program) {
    choose(Program, Options);
    Plan.Effects.choose(Program);
    Plan.Programs.push_back(Program);
  };
  if (Options.Kind == RendererKind::Trace)
    addTracing(Add, Plan.Effects);
  else
    addLists(Add, Plan.Effects, Options);
  if (Plan.Effects.done(effects::ActivatedScene))
    Add(kernels::activate_scene::Program{});
  if (Plan.Effects.done(effects::CullBlocks))
    Add(kernels::cull_blocks::Program{});
  if (Plan.Effects.compiled(effects::ZTiles))
    Add(kernels::merge::Program{});
  if (Plan.Effects.compiled(effects::Background))
    Add(kernels::resolve::Program{});
  if (Plan.Effects.done(effects::Depth))
    Add(kernels::depth::Program{});
  if (Plan.Effects.done(effects::Normals))
    Add(kernels::normals::Program{});
  return Plan;
}

RenderPlan planRender(int ShDegree, const RenderOptions &Options) {
  return planRender(EffectPlan::forAnyScene(ShDegree, Options), Options);
}

} // namespace vorion::splat
