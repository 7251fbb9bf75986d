/// Writing INRIA's PLY.
#pragma once

#include "scene/Drawing.h"
#include "scene/Scene.h"
#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// The properties f_rest_* for \p ShDegree in the scene's order: a file numbers
/// them channel by channel, the scene has them coefficient by coefficient.
std::vector<std::string> plyRestNames(int ShDegree);

/// \p S in the layout and property order of INRIA's trainer (with zero
/// normals), in the caller's frame: x, y and z are doubles where fp32 has too
/// few digits (\c needsDoubles()).
/// The comments of \p D, if it is not the classic way, come before the
/// elements.
std::string formatPly(const Scene &S, const Drawing &D = {});

/// Writes that to a file.
Expected<Success> writePly(const std::string &Path, const Scene &S,
                           const Drawing &D = {});

} // namespace vorion::splat
