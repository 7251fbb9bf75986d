/// The blend arithmetics that vr_options.blend chooses between (docs/abi.md,
/// "Rasterizer"). Their code is in BlendVector.h; what they cost is in
/// timing/DatapathUnits.cpp.
#pragma once

#include "raster/RasterTables.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace vorion::raster {

/// What a blend arithmetic is.
struct BlendUnit {
  std::uint32_t Option; ///< value of vr_options.blend
  std::string_view Name;
  unsigned SignificandBits; ///< of a multiplication's operands
};

/// How many there are: options 0 to BlendUnitCount - 1.
inline constexpr std::size_t BlendUnitCount = 3;

inline constexpr BlendUnit BlendUnits[BlendUnitCount] = {
    {VR_BLEND_FP32, "fp32", 24},
    {VR_BLEND_BF16, "bf16", 8},
    {VR_BLEND_FP16, "fp16", 11},
};

/// The units that exist, by option; any other option is VR_BAD_MODE.
inline std::span<const BlendUnit> blendUnits() { return BlendUnits; }

} // namespace vorion::raster
