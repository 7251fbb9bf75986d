/// PlayCanvas's SOG, versions 1 and 2: parameters as planes of WebP pictures.
/// https://developer.playcanvas.com/user-manual/gaussian-splatting/formats/sog
#pragma once

#include "scene/SceneFile.h"

#include <functional>
#include <vector>

namespace vorion::splat {

/// Gives the content of a file of a data set by its name.
using FileSource =
    std::function<Expected<std::vector<std::byte>>(const std::string &Name)>;

/// Decodes the data set that \p Meta, the content of meta.json, describes:
/// positions of 16 bits between bounds of sign(x) ln(|x| + 1); log scales,
/// colours and harmonics by codebooks of 256 numbers, harmonics in a palette
/// of up to 65,536 entries; rotations of 8 bits for each of the three smallest
/// components; opacity of 8 bits. Version 1 has even steps between bounds where
/// version 2 has codebooks, and logits of opacities. \p Where names the data
/// set in messages, \p MetaWhere its description. Refused: planes smaller than
/// the count, of different sizes, or out of proportion to their files or to the
/// count, indices outside codebook or palette, models other than default and
/// antialiased.
Expected<SceneFile> parseSogData(const std::string &Where,
                                 const std::string &MetaWhere, Bytes Meta,
                                 const FileSource &Read,
                                 const ReadOptions &Options = {});

} // namespace vorion::splat
