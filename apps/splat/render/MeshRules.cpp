#include "render/MeshRules.h"

#include "mesh/Mesh.h"

#include <fmt/format.h>

namespace vorion::splat {

Expected<Success> checkMeshCamera(const RenderOptions &O,
                                  const std::string &Cameras) {
  if (!O.Surface ||
      (!O.Rolling && (O.Optics->isPinhole() || O.Optics->IsParallel)))
    return Success{};
  return Error{Cameras,
               fmt::format("--mesh: a camera of model {}{}, expected a pinhole "
                           "or orthographic camera with a global shutter",
                           O.Optics->Name,
                           O.Rolling ? " with a rolling shutter" : ""),
               ExitCode::Usage};
}

Expected<Success> checkMeshPrecision(const RenderOptions &O,
                                     const std::string &Cameras) {
  const RenderOptions Default;
  if (!O.Surface && (O.SubpixelBits != Default.SubpixelBits ||
                     O.MeshDepth != Default.MeshDepth))
    return Error{"",
                 "--subpixel-bits and --mesh-depth apply to a mesh only, "
                 "expected --mesh",
                 ExitCode::Usage};
  if (O.FilterBits && !(O.Surface && O.Surface->hasTextures()))
    return Error{"",
                 "--filter-bits applies to textures only, expected a mesh with "
                 "some",
                 ExitCode::Usage};
  if (O.Optics->IsParallel && O.MeshDepth != Default.MeshDepth)
    return Error{Cameras,
                 fmt::format("--mesh-depth {} is of depths that fall with 1/z, "
                             "expected fp32 with a camera of model {}",
                             name(O.MeshDepth), O.Optics->Name),
                 ExitCode::Usage};
  return Success{};
}

Expected<Success> checkTransparency(const RenderOptions &O, bool WantsDepths,
                                    bool Overlaps) {
  const char *Expected = O.ZTiles != 1                  ? "--ztiles 1"
                         : O.Deal == Dealing::LastFrame ? "--deal lists"
                         : Overlaps                     ? "no --overlap"
                         : WantsDepths                  ? "no --depth"
                                                        : nullptr;
  if (!Expected || !O.Surface || !O.Surface->has(AlphaMode::Blend))
    return Success{};
  return Error{O.Surface->file(),
               fmt::format("transparent surfaces are drawn between ranges of "
                           "whole lists, expected {}",
                           Expected),
               ExitCode::Usage};
}

Error layersBesideMesh() {
  return {"",
          "--mesh has no normals and contributors beside the picture, expected "
          "none of --normals, --contributors and --depth-as median",
          ExitCode::Usage};
}

Expected<Success> checkOpaque(const RenderOptions &O) {
  if (!O.Surface ||
      (!O.Surface->has(AlphaMode::Mask) && !O.Surface->has(AlphaMode::Blend)))
    return Success{};
  return Error{O.Surface->file(),
               "gradients are computed in front of opaque surfaces, expected a "
               "mesh without masks and transparency",
               ExitCode::Usage};
}

} // namespace vorion::splat
