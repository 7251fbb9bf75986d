/// `.splat`: 32 bytes a Gaussian and nothing else.
/// https://github.com/antimatter15/splat
#pragma once

#include "SceneFile.h"

namespace vorion::splat {

/// Decodes records of three floats of position, three of scale (not its
/// logarithm), four bytes r, g, b, opacity, and four bytes of a quaternion w,
/// x, y, z, where 128 is zero. Degree 0. The format has no mark by which to
/// know it, so positions and scales beyond 1e9 and negative scales, which no
/// scene has but text and other files soon do, are errors. A scale of zero
/// becomes the smallest normal float, whose logarithm is finite.
Expected<SceneFile> parseSplat(const std::string &Where, Bytes File,
                               const ReadOptions &Options = {});

} // namespace vorion::splat
