/// Pictures and depths as OpenEXR has them.
#pragma once

#include "io/Bytes.h"
#include "io/Image.h"

#include <string>

namespace vorion::splat {

/// Reads the colour and, where it has one, the alpha of a still picture. Its
/// size is that of the display window; what lies outside the data window is 0.
/// Values stay as the file has them, of 16 or 32 bits. Deep pictures, those
/// without R, G and B, and those whose channels have fewer pixels than others
/// are errors.
Expected<ExactImage> decodeExr(const std::string &Where, Bytes File);

/// \p I with every value as it is; as 16-bit floats if \p Half.
Expected<std::string> encodeExr(const Image &I, bool Half);

/// \p D as the channel Z, and where there is alpha, that as A, in 32 bits.
Expected<std::string> encodeExr(const DepthMap &D);

} // namespace vorion::splat
