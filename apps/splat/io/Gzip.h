/// Gzip streams in memory.
#pragma once

#include "Bytes.h"
#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion::splat {

bool isGzip(Bytes File);

/// The content of a file that is one gzip stream, checksum included.
Expected<std::vector<std::byte>> unpackGzip(const std::string &Where,
                                            Bytes File);

} // namespace vorion::splat
