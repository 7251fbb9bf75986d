/// The stages that work on the device is accounted to.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace vorion::splat {

enum class Stage {
#define STAGE(ID, NAME, OF_THE_FRAME) ID,
#include "device/Stages.def"
};

/// As reports have it: "sort by depth".
constexpr std::string_view name(Stage S) {
  constexpr std::array Names{
#define STAGE(ID, NAME, OF_THE_FRAME) std::string_view(NAME),
#include "device/Stages.def"
  };
  return Names[static_cast<std::size_t>(S)];
}

/// Whether the time of a frame, or of an iteration, has it.
constexpr bool isFrameStage(Stage S) {
  constexpr std::array OfTheFrame{
#define STAGE(ID, NAME, OF_THE_FRAME) OF_THE_FRAME,
#include "device/Stages.def"
  };
  return OfTheFrame[static_cast<std::size_t>(S)];
}

} // namespace vorion::splat
