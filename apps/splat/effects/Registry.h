/// All effects, in the order of decisions and explanations.
#pragma once

#include "effects/Effect.h"

#include <span>

namespace vorion::splat::effects {

/// \name Scene effects
/// @{
extern const Effect Sh1, Sh2, Sh3; // ShBands.cpp
extern const Effect ViewColor;
extern const Effect Antialias;
extern const Effect NearPlane;
extern const Effect FieldOfView;
extern const Effect Faint;
extern const Effect AlphaClamp;
extern const Effect Background;
extern const Effect Unscented;
extern const Effect RollingShutter;
extern const Effect Needles;
extern const Effect Crop;
extern const Effect Windows;
extern const Effect Rays, Degree4, Surfels; // Rays.cpp
extern const Effect RayOrder;
extern const Effect Mesh, Texture, Light, Layers; // Mesh.cpp
/// @}

/// \name Machine effects
/// @{
extern const Effect IntersectTags;
extern const Effect ActivatedScene;
extern const Effect CullBlocks;
extern const Effect ZTiles;
extern const Effect PixelUnit;
extern const Effect SkipSaturated;
/// @}

/// \name Observations
/// @{
extern const Effect Clock, Numerics, Checkers, Traces,
    Debugger; // Observations.cpp
extern const Effect SortedPairs;
extern const Effect Depth;
extern const Effect Normals;
extern const Effect PixelLists;
/// @}

std::span<const Effect *const> all();

/// The effect of that name, or null.
const Effect *find(std::string_view Name);

/// The effects of camera models except pinholes, one for each model, after
/// Background.
std::span<const Effect> ofLenses();
/// The effect of camera model \p M, or null for a pinhole.
const Effect *lensOf(const LensModel &M);

} // namespace vorion::splat::effects
