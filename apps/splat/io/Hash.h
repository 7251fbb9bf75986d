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

/// Of a scene: of the file, or of the names and contents of all files in a
/// folder, in the order of their names; a .json file stands for its folder.
Expected<std::string> hashScene(const std::string &Path);

} // namespace vorion::splat
