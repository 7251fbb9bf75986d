/// The stages of work on the device.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace vorion::splat {

enum class Stage {
#define STAGE(ID, NAME, OF_THE_FRAME) ID,
#include "device/Stages.def"
};

/// The name in reports: "sort by depth".
constexpr std::string_view name(Stage S) {
  constexpr std::array Names{
#define STAGE(ID, NAME, OF_THE_FRAME) std::string_view(NAME),
#include "device/Stages.def"
  };
  return Names[static_cast<std::size_t>(S)];
}

/// Whether the stage is part of the time of a frame or an iteration.
constexpr bool isFrameStage(Stage S) {
  constexpr std::array OfTheFrame{
#define STAGE(ID, NAME, OF_THE_FRAME) OF_THE_FRAME,
#include "device/Stages.def"
  };
  return OfTheFrame[static_cast<std::size_t>(S)];
}

} // namespace vorion::splat
