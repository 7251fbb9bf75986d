#include "capture/Intrinsics.h"

#include "io/CameraLens.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

namespace vorion::splat {
namespace {

using Json = nlohmann::json;

constexpr double Degree = M_PI / 180;

/// Sets the focal length or the angle of \p To by \p Object's keys of the axis
/// \p Name. False if it has none.
Expected<bool> readFocal(const Json &Object, char Name, Intrinsics::Axis &To) {
  const std::string Focal = fmt::format("fl_{}", Name);
  if (const auto It = Object.find(Focal); It != Object.end()) {
    const auto Value = finiteNumber(*It, Focal);
    if (!Value)
      return Value.error();
    if (!(*Value > 0))
      return Error{"",
                   fmt::format("key {}: a focal length that is not positive, "
                               "expected a positive number of pixels",
                               Focal)};
    To.Focal = *Value;
    return true;
  }
  const struct {
    std::string Key;
    double Unit;
    const char *Wanted;
  } Angles[] = {
      {fmt::format("camera_angle_{}", Name), 1, "radians between 0 and pi"},
      {fmt::format("{}_fov", Name), Degree, "degrees between 0 and 180"}};
  for (const auto &[Key, Unit, Wanted] : Angles)
    if (const auto It = Object.find(Key); It != Object.end()) {
      const auto Value = finiteNumber(*It, Key);
      if (!Value || !(*Value > 0 && *Value * Unit < 3.14159))
        return Error{
            "", fmt::format("key {} is invalid, expected {}", Key, Wanted)};
      To.Angle = *Value * Unit;
      return true;
    }
  return false;
}

Expected<Intrinsics::Axis> readAxis(const std::array<const Json *, 2> &Objects,
                                    char Name, bool IsSphere) {
  Intrinsics::Axis A;
  for (const Json *Object : Objects) {
    if (IsSphere)
      break;
    const auto Found = readFocal(*Object, Name, A);
    if (!Found)
      return Found.error();
    if (*Found)
      break;
  }
  const std::string Key = fmt::format("c{}", Name);
  for (const Json *Object : Objects)
    if (const auto It = Object->find(Key); It != Object->end()) {
      const auto Value = finiteNumber(*It, Key);
      if (!Value)
        return Value.error();
      A.Centre = *Value;
      break;
    }
  return A;
}

std::optional<double> focalOf(const Intrinsics::Axis &A, int Side) {
  return A.Angle ? 0.5 * Side / std::tan(0.5 * *A.Angle) : A.Focal;
}

} // namespace

Expected<double> finiteNumber(const Json &Value, const std::string &Key) {
  if (Value.is_number() && std::isfinite(Value.get<double>()))
    return Value.get<double>();
  return Error{"",
               fmt::format("key {} is invalid, expected a finite number", Key)};
}

Expected<Intrinsics> readIntrinsics(const Json &Frame, const Json &Document,
                                    bool IsSphere) {
  const auto X = readAxis({&Frame, &Document}, 'x', IsSphere);
  if (!X)
    return X.error();
  const auto Y = readAxis({&Frame, &Document}, 'y', IsSphere);
  if (!Y)
    return Y.error();
  if (!IsSphere && !X->Focal && !X->Angle && !Y->Focal && !Y->Angle)
    return Error{"", "no focal length, expected fl_x, or camera_angle_x "
                     "between 0 and pi"};
  return Intrinsics{*X, *Y, IsSphere};
}

void complete(Camera &C, const Intrinsics &I) {
  if (I.IsSphere)
    return setSphere(C);
  const auto Fx = focalOf(I.X, C.Width), Fy = focalOf(I.Y, C.Height);
  C.Fx = Fx ? *Fx : Fy.value_or(0);
  C.Fy = Fy.value_or(C.Fx);
  C.Cx = I.X.Centre.value_or(0.5 * C.Width);
  C.Cy = I.Y.Centre.value_or(0.5 * C.Height);
}

} // namespace vorion::splat
