/// Writing INRIA's PLY.
#pragma once

#include "scene/Drawing.h"
#include "scene/Scene.h"
#include "scene/SceneFile.h"
#include "vorion/support/Expected.h"

#include <functional>
#include <string>
#include <vector>

namespace vorion::splat {

/// As parsePly() of Formats.h. \p Done is called with each part of \p File
/// that is not read again.
Expected<SceneFile> parsePly(const std::string &Where, Bytes File,
                             const ReadOptions &Options,
                             const std::function<void(Bytes)> &Done);

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
