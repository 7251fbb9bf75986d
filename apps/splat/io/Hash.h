/// FNV-1a, 64 bits: tells inputs apart in reports, guards against nobody.
/// http://www.isthe.com/chongo/tech/comp/fnv/
#pragma once

#include "vorion/support/Expected.h"

#include <string>
#include <string_view>

namespace vorion::splat {

/// 16 hexadecimal digits.
std::string fnv1a64(std::string_view Bytes);

/// Of all of \p File; an Error if it cannot be read.
Expected<std::string> hashFile(const std::string &File);

} // namespace vorion::splat
