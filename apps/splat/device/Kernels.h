/// The kernel sources of this program, put into it at build time.
#pragma once

#include <string_view>

namespace vorion::splat {

/// The text of kernels/\p File; empty if there is no such file.
std::string_view kernelSource(std::string_view File);

} // namespace vorion::splat
