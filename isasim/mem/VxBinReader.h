/// Vortex's raw programs: the address of the first byte and of the first byte
/// behind the last, 8 bytes each, then the bytes themselves; what they do not
/// reach is zero (Vortex v2, .vxbin).
#pragma once

#include "vorion/isasim/Image.h"

namespace vorion::isasim {

/// Errors: truncated, outside the image range, not aligned. The image is one
/// segment, code and data; it starts at its first address.
Expected<std::shared_ptr<const Image>>
parseVxBin(std::span<const std::byte> File, std::string Name);

} // namespace vorion::isasim
