/// How kernels of one work-item a thing are started.
#pragma once

#include "../device/Launcher.h"

namespace vorion::splat {

/// Work-items of a group where the kernel has no say.
inline constexpr std::uint32_t ItemGroup = 64;

/// Whole groups with a work-item for each of \p Count things.
inline cl::NDRange itemsOf(std::uint32_t Count) {
  return {(std::size_t{Count} + ItemGroup - 1) / ItemGroup * ItemGroup};
}

} // namespace vorion::splat
