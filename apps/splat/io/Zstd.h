/// Zstandard frames in memory.
#pragma once

#include "io/Bytes.h"
#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// Unpacks \p Frame, one complete frame, to exactly \p Size bytes. Memory is
/// limited to \c unpackLimit of the frame, whatever \p Size is.
Expected<std::vector<std::byte>> unpackZstd(const std::string &Where,
                                            Bytes Frame, std::size_t Size);

/// \p Content as one frame.
std::string zstdOf(const std::string &Content);

} // namespace vorion::splat
