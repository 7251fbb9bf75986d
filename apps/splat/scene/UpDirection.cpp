#include "scene/UpDirection.h"

#include "vorion/support/Letters.h"

#include <charconv>
#include <cmath>

namespace vorion::splat {
namespace {

using Vector = std::array<double, 3>;

std::optional<Vector> axisOf(std::string_view Word) {
  const bool HasSign = Word.starts_with('-') || Word.starts_with('+');
  const std::string_view Letter = HasSign ? Word.substr(1) : Word;
  if (Letter.size() != 1 || Letter[0] < 'x' || Letter[0] > 'z')
    return std::nullopt;
  const bool IsDown = HasSign ? Word[0] == '-' : Letter[0] == 'y';
  Vector Up{};
  Up[static_cast<std::size_t>(Letter[0] - 'x')] = IsDown ? -1 : 1;
  return Up;
}

std::optional<Vector> numbersOf(std::string_view Text) {
  Vector Up{};
  for (double &Value : Up) {
    Text = trimmed(Text, " \t,[]()");
    const auto [End, Status] =
        std::from_chars(Text.data(), Text.data() + Text.size(), Value);
    if (Status != std::errc() || !std::isfinite(Value))
      return std::nullopt;
    Text.remove_prefix(static_cast<std::size_t>(End - Text.data()));
  }
  const double Length = std::hypot(Up[0], Up[1], Up[2]);
  if (!(Length > 0) || !std::isfinite(Length))
    return std::nullopt;
  for (double &Value : Up)
    Value /= Length;
  return Up;
}

} // namespace

std::optional<Vector> upOfAxes(std::string_view Axes) {
  if (Axes.size() != 3)
    return std::nullopt;
  return Vector{0, Axes[1] == 'd' ? -1.0 : 1.0, 0};
}

std::optional<Vector> upOfComments(std::span<const std::string> Comments) {
  constexpr std::string_view Key = "vertical axis:";
  std::optional<Vector> Up;
  for (const std::string &Comment : Comments) {
    const std::string Lower = lowerCase(std::string(trimmed(Comment)));
    if (!Lower.starts_with(Key))
      continue;
    const std::string_view Value =
        trimmed(std::string_view(Lower).substr(Key.size()));
    const auto Axis = axisOf(Value.substr(0, Value.find_first_of(" \t(,")));
    if (const auto Stated = Axis ? Axis : numbersOf(Value))
      Up = Stated;
  }
  return Up;
}

} // namespace vorion::splat
