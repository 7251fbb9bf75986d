/// Internal to the library: the bytes of one .npy file.
#pragma once

#include "io/Npz.h"

#include <string>

namespace vorion::splat {

/// \p A as a version 1.0 .npy file.
std::string formatNpy(const NpyArray &A);

} // namespace vorion::splat
