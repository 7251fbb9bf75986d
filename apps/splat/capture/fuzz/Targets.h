/// Targets of the capture fuzzers, also replayed by a test. Any input must
/// yield a complete result or an error of one line; otherwise the program
/// aborts.
#pragma once

#include "io/Bytes.h"

#include <string>
#include <utility>
#include <vector>

namespace vorion::splat::fuzz {

/// A COLMAP model: a byte that is 1 for text, then cameras, images and points,
/// each preceded by its size in 16 bits.
void readColmap(Bytes Input);
/// A transforms.json, and a point cloud.
void readTransforms(Bytes Input);
/// A PNG, JPEG or WebP.
void readPhoto(Bytes Input);
/// An OpenEXR picture.
void readExr(Bytes Input);

/// Small valid inputs, by name.
using Seeds = std::vector<std::pair<std::string, std::string>>;
Seeds colmapSeeds();
Seeds transformsSeeds();
Seeds photoSeeds();
Seeds exrSeeds();

} // namespace vorion::splat::fuzz
