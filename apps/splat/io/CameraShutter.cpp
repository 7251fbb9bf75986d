#include "io/CameraShutter.h"

#include "vorion/support/Json.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {

namespace {

using Json = nlohmann::json;
using Three = std::array<double, 3>;

struct NamedShutter {
  std::string_view Name;
  Three Moments;
};
/// gsplat's names.
constexpr NamedShutter Shutters[] = {
    {"GLOBAL", {0.5, 0, 0}},
    {"ROLLING_TOP_TO_BOTTOM", {0, 0, 1}},
    {"ROLLING_BOTTOM_TO_TOP", {1, 0, -1}},
    {"ROLLING_LEFT_TO_RIGHT", {0, 1, 0}},
    {"ROLLING_RIGHT_TO_LEFT", {1, -1, 0}},
};

std::optional<Three> threeOf(const Json &J, double Most) {
  Three V{};
  if (!J.is_array() || J.size() != V.size())
    return std::nullopt;
  for (std::size_t I = 0; I < V.size(); ++I) {
    if (!J[I].is_number() || !(std::abs(J[I].get<double>()) <= Most))
      return std::nullopt;
    V[I] = J[I].get<double>();
  }
  return V;
}

std::optional<Three> momentsOf(const Json &J) {
  if (!J.is_string())
    return shutterMoments(J);
  const auto *const Found = std::ranges::find(
      Shutters, std::string_view(J.get_ref<const std::string &>()),
      &NamedShutter::Name);
  if (Found == std::ranges::end(Shutters))
    return std::nullopt;
  return Found->Moments;
}

} // namespace

std::optional<Three> shutterMoments(const Json &J) {
  return threeOf(J, MostShutterMoment);
}

std::optional<std::string> readShutter(const KeyFinder &Find, Camera &C) {
  const auto Has = [&](const char *Key) {
    const Json *J = Find(Key);
    return J && !J->is_null() ? J : nullptr;
  };
  RollingShutter S;
  const Json *Moments = Has("rolling_shutter");
  if (Moments) {
    const auto Read = momentsOf(*Moments);
    if (!Read)
      return fmt::format(
          "key rolling_shutter is invalid, expected start, across "
          "and down from -{:g} to {:g}, GLOBAL, or ROLLING_ "
          "with TOP_TO_BOTTOM, BOTTOM_TO_TOP, LEFT_TO_RIGHT or "
          "RIGHT_TO_LEFT",
          MostShutterMoment, MostShutterMoment);
    S.Start = (*Read)[0];
    S.Across = (*Read)[1];
    S.Down = (*Read)[2];
  }
  constexpr double MostMotion = 1e9;
  if (const Json *J = Has("rolling_motion")) {
    const auto Read = threeOf(*J, MostMotion);
    if (!Read)
      return fmt::format(
          "key rolling_motion is invalid, expected three numbers "
          "from -{:g} to {:g}",
          MostMotion, MostMotion);
    S.Motion = *Read;
  }
  if (const Json *J = Has("rolling_turn")) {
    const auto Read = threeOf(*J, MostShutterTurn);
    if (!Read ||
        std::hypot((*Read)[0], (*Read)[1], (*Read)[2]) > MostShutterTurn)
      return "key rolling_turn is invalid, expected an axis times an angle of "
             "at "
             "most pi / 2";
    S.Turn = *Read;
  }
  const bool Moves = S.Motion != Three{} || S.Turn != Three{};
  if (Moves && !Moments)
    return "keys rolling_motion and rolling_turn need rolling_shutter, "
           "expected the exposure times of rows";
  if (Moves)
    C.Optics.Shutter = S;
  return std::nullopt;
}

} // namespace vorion::splat
