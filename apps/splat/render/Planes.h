/// Device layouts of scenes: one plane of values for each parameter, so that
/// the lanes of a warp read neighbouring words; or blocks with the planes of 16
/// Gaussians (kernels/layout.h).
#pragma once

#include "scene/Scene.h"

#include <functional>
#include <span>
#include <vector>

namespace vorion::splat {

/// Planes of layout.h's GEOMETRY_PLANES.
std::vector<float> geometryPlanes(const Scene &S);

/// Plane 3 k + c holds coefficient k of channel c, up to \p Degree.
std::vector<float> shPlanes(const Scene &S, int Degree);

/// Words of the blocks of \p Count Gaussians with \p Planes planes each.
std::size_t blockWords(std::size_t Count, std::size_t Planes);

/// Write the same in blocks to \p To, which has \c blockWords() words and may
/// be uninitialized. Of the colour planes, only \p Planes are written,
/// zero-filled if the scene lacks them. Unused entries of the last block are
/// zeros.
void writeGeometryBlocks(const Scene &S, std::span<float> To);
/// \p Read, if set, is called in any thread for each range of Gaussians whose
/// colours are not read again.
void writeShBlocks(const Scene &S, const std::vector<std::size_t> &Planes,
                   std::span<float> To,
                   const std::function<void(std::size_t First, std::size_t End)>
                       &Read = nullptr);

/// The bounds of each block's Gaussians, in layout.h's BOUND_PLANES. A block
/// with a NaN has an infinite radius.
std::vector<float> blockBounds(const Scene &S);

/// The scene of degree \p Degree with these planes.
Scene sceneOfPlanes(const std::vector<float> &Geometry,
                    const std::vector<float> &Sh, int Degree);

} // namespace vorion::splat
