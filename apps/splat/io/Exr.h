/// Pictures and depths in OpenEXR files.
#pragma once

#include "io/Bytes.h"
#include "io/Image.h"

#include <string>

namespace vorion::splat {

/// Reads the colour and, if present, the alpha of a picture. Its size is that
/// of the display window; pixels outside the data window are 0. Values of 16 or
/// 32 bits are not converted. Errors: deep data, no R, G and B, subsampled
/// channels.
Expected<ExactImage> decodeExr(const std::string &Where, Bytes File);

/// \p I with unmodified values; as 16-bit floats if \p Half.
Expected<std::string> encodeExr(const Image &I, bool Half);

/// \p D as the channel Z, and where there is alpha, that as A, in 32 bits.
Expected<std::string> encodeExr(const DepthMap &D);

} // namespace vorion::splat
