/// The kernel sources of this program, put into it at build time.
#pragma once

#include <span>
#include <string_view>

namespace vorion::splat {

/// The names of the files in kernels/.
std::span<const std::string_view> kernelFiles();

/// The text of kernels/\p File; empty if there is no such file.
std::string_view kernelSource(std::string_view File);

} // namespace vorion::splat
