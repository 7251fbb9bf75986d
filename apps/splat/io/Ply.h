/// Trained scenes in INRIA's PLY layout.
#pragma once

#include "Scene.h"
#include "vorion/support/Expected.h"

#include <string>

namespace vorion::splat {

/// Reads a binary little-endian PLY with the vertex properties x, y, z,
/// f_dc_0..2, f_rest_0.. (0, 9, 24 or 45 of them: degree 0 to 3), opacity,
/// scale_0..2 and rot_0..3 as floats, in any order; other properties of scalar
/// type (nx, ny, nz) are skipped. Refused, each with its reason: other
/// encodings, missing, repeated or list properties, a file shorter or longer
/// than the header says, values that are not finite, no vertex at all.
Expected<Scene> readPly(const std::string &Path);

/// Writes \p S in the layout and property order of INRIA's trainer (with zero
/// normals).
Expected<Success> writePly(const std::string &Path, const Scene &S);

} // namespace vorion::splat
