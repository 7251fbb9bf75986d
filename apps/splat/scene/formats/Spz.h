/// Niantic's `.spz`, versions 2 and 3.
/// https://github.com/nianticlabs/spz
#pragma once

#include "SceneFile.h"

namespace vorion::splat {

/// Decodes a gzip stream (or what is in one) of a 16-byte header and one array
/// for each parameter: positions of 24-bit fixed point, opacities, colours,
/// log scales in sixteenths, rotations (version 2: 8 bits for each of x, y, z;
/// version 3: the three smallest components, 10 bits each), harmonics of 8
/// bits. Refused: versions 1 and 4, degree 4, extensions.
Expected<SceneFile> parseSpz(const std::string &Where, Bytes File);

} // namespace vorion::splat
