/// Trained scenes in INRIA's PLY layout.
#pragma once

#include "SceneFile.h"

namespace vorion::splat {

/// Reads a binary little-endian PLY whose one element, vertex, has the
/// properties x, y, z, f_dc_0..2, f_rest_0.. (0, 9, 24 or 45 of them: degree 0
/// to 3), opacity, scale_0..2 and rot_0..3 as floats, in any order; other
/// scalar properties (nx, ny, nz) are skipped. A file that has an element
/// `chunk` is read as CompressedPly.h says. Refused, each with its reason:
/// other encodings, missing, repeated or list properties, a file shorter or
/// longer than the header says, values that are not finite, no vertex at all.
Expected<SceneFile> parsePly(const std::string &Where, Bytes File);

/// The properties f_rest_* for \p ShDegree in the scene's order: a file numbers
/// them channel by channel, the scene has them coefficient by coefficient.
std::vector<std::string> plyRestNames(int ShDegree);

/// \p S in the layout and property order of INRIA's trainer (with zero
/// normals).
/// The comments of \p D, if it is not the classic way, come before the
/// elements.
std::string formatPly(const Scene &S, const Drawing &D = {});

/// Writes that to a file.
Expected<Success> writePly(const std::string &Path, const Scene &S,
                           const Drawing &D = {});

} // namespace vorion::splat
