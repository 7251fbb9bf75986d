// A mesh of triangles that hides the Gaussians behind it, and how it looks
// (docs/meshes.md).

#include "mesh/Mesh.h"
#include "effects/Registry.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

Finding detectMesh(const EffectInputs &In) {
  const Mesh *M = In.Options.Surface.get();
  if (!M)
    return {false, "no mesh (--mesh)", false};
  return {true, fmt::format("--mesh, {} triangles", M->triangles())};
}

Finding detectTexture(const EffectInputs &In) {
  const Mesh *M = In.Options.Surface.get();
  if (!M || !M->hasTextures())
    return {false, "no mesh with textures", false};
  return {true, fmt::format("{} textures", M->Textures.size())};
}

Finding detectLayers(const EffectInputs &In) {
  const Mesh *M = In.Options.Surface.get();
  const bool HasMasks = M && M->has(AlphaMode::Mask),
             HasBlends = M && M->has(AlphaMode::Blend);
  if (!HasMasks && !HasBlends)
    return {false, "no mesh with masks or transparency", false};
  return {true, fmt::format("{}{}{}", HasMasks ? "masks" : "",
                            HasMasks && HasBlends ? ", " : "",
                            HasBlends ? "transparency" : "")};
}

Finding detectLight(const EffectInputs &In) {
  const auto &Light = In.Options.Light;
  if (!In.Options.Surface || !Light)
    return {false, "no light on a mesh (--light)", false};
  return {true, fmt::format("--light {:g},{:g},{:g}", (*Light)[0], (*Light)[1],
                            (*Light)[2])};
}

} // namespace

const Effect effects::Mesh{
    .Name = "mesh",
    .Kind = EffectKind::Scene,
    .What = "the stage mesh, which draws triangles; a limit of each pixel's "
            "list; and the kernel mesh_resolve, a pass over all pixels",
    .Macro = "USE_MESH",
    .Detect = detectMesh,
    .Neutral = false,
    .ByCamera = true};

const Effect effects::Texture{
    .Name = "texture",
    .Kind = EffectKind::Scene,
    .What = "texture coordinates, materials and texels on the device, and the "
            "texture of each pixel in mesh_resolve",
    .Macro = "USE_TEXTURE",
    .Detect = detectTexture,
    .Neutral = false,
    .ByCamera = true};

const Effect effects::Layers{
    .Name = "layers",
    .Kind = EffectKind::Scene,
    .What =
        "materials on the device; fragments that rasterizers hand over, and "
        "their order in each pixel; a pass of blending and one of the "
        "kernel mesh_compose for each layer that a pixel has",
    .Macro = "USE_LAYERS",
    .Detect = detectLayers,
    .Neutral = false,
    .ByCamera = true};

const Effect effects::Light{
    .Name = "light",
    .Kind = EffectKind::Scene,
    .What = "normals on the device, and the light of each pixel in "
            "mesh_resolve",
    .Macro = "USE_LIGHT",
    .Detect = detectLight,
    .Neutral = false,
    .ByCamera = true};

} // namespace vorion::splat
