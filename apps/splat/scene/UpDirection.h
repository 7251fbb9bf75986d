/// The up direction that scene files state.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace vorion::splat {

/// The up direction of axes in three letters ("rub"): along y. Empty for none.
std::optional<std::array<double, 3>> upOfAxes(std::string_view Axes);

/// That of a PLY's comment `Vertical Axis: VALUE`, as a unit vector; the last
/// of several. VALUE is a letter with or without sign (nerfstudio: z), or three
/// numbers. A y without sign, as Brush writes it for any scene, is -y, because
/// cameras of trainers have y down. Empty for none, and for other values.
std::optional<std::array<double, 3>>
upOfComments(std::span<const std::string> Comments);

} // namespace vorion::splat
