/// PlayCanvas's compressed PLY: chunks of 256 Gaussians, each with its bounds,
/// and four 32-bit words a Gaussian.
/// https://github.com/playcanvas/splat-transform (compressed PLY)
#pragma once

#include "PlyHeader.h"
#include "SceneFile.h"

namespace vorion::splat {

/// Decodes the elements chunk, vertex and, from degree 1, sh. Between a
/// chunk's bounds, positions and log scales have 11, 10 and 11 bits, colours 8;
/// rotations have 10 bits for each of the three components that are not the
/// largest, opacity 8, harmonics 8 for -4 to 4. Older files have no bounds of
/// the colour, which then goes from 0 to 1.
Expected<SceneFile> parseCompressedPly(const std::string &Where, Bytes File,
                                       const PlyHeader &Header);

} // namespace vorion::splat
