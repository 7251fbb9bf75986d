/// Writers of the compressed formats. Each returns a file's bytes, quantized as
/// documented by the format, rounded to the nearest step, in the order of the
/// scene. docs/scenes.md lists the steps. INRIA's PLY: Ply.h.
#pragma once

#include "scene/Drawing.h"
#include "scene/Scene.h"

#include <map>
#include <string>

namespace vorion::splat {

/// Bounds are those of each 256 Gaussians, so a scene should be in Morton
/// order (MortonOrder.h). Older programs wrote no \p ColorBounds, and have
/// colours from 0 to 1 only.
std::string compressedPlyOf(const Scene &S, const Drawing &D = {},
                            bool ColorBounds = true);

/// Drops spherical harmonics, and clamps colours to 0 to 1.
std::string splatOf(const Scene &S);

/// Whether every mean of \p S is in the range of `.spz`.
bool fitsSpz(const Scene &S);

/// The uncompressed contents of an `.spz` of \p Version 2 or 3. Steps of
/// positions are as fine as the scene's extent permits, at most 1/4096. Log
/// scales are clamped to -10 to 5.94, spherical harmonics to -1 to 1. Requires
/// fitsSpz(S).
std::string spzBodyOf(const Scene &S, int Version, const Drawing &D = {});

/// The files of a SOG of version 2, by name: codebooks of 256 values, and
/// harmonics in a palette of at most 65,536 entries (Codebook.h). Dilations are
/// not said.
Expected<std::map<std::string, std::string>> sogFilesOf(const Scene &S,
                                                        const Drawing &D = {});

/// The same in a zip archive: a `.sog`.
Expected<std::string> sogArchiveOf(const Scene &S, const Drawing &D = {});

} // namespace vorion::splat
