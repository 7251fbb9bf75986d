/// FNV-1a, 64 bits: tells inputs apart in reports, guards against nobody.
/// http://www.isthe.com/chongo/tech/comp/fnv/
#pragma once

#include <string>
#include <string_view>

namespace vorion {

/// 16 hexadecimal digits.
std::string fnv1a64(std::string_view Bytes);

} // namespace vorion
