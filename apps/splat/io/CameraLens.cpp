#include "io/CameraLens.h"

#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vector>

namespace vorion::splat {

namespace {

using Json = nlohmann::json;

constexpr const char *ModelKeys[] = {"camera_model", "model", "camera_type",
                                     "projection", "projection_type"};

/// A list's key, and the names of its numbers by order.
struct ListKey {
  const char *Key;
  std::vector<std::string_view> Names;
};

class LensReader {
public:
  explicit LensReader(const KeyFinder &Find) : Find(Find) {}

  std::optional<std::string> read(Camera &C) {
    readModel();
    readNumbers();
    readLists();
    checkModel();
    if (Problem)
      return Problem;
    Optics = simplified(Optics);
    C.Optics = Optics;
    if (Optics.Model == LensModel::Equirectangular)
      setSphere(C);
    return std::nullopt;
  }

private:
  void fail(std::string What) {
    if (!Problem)
      Problem = std::move(What);
  }

  void readModel() {
    for (const char *Key : ModelKeys) {
      const Json *Value = Find(Key);
      if (!Value || !Value->is_string())
        continue;
      const auto Known = lensModelNamed(Value->get_ref<const std::string &>());
      if (!Known)
        return fail(fmt::format("key {} calls for the camera model {}, which "
                                "is not supported, expected {}",
                                Key, jsonText(*Value), knownLensModels()));
      // A distorted pinhole is OpenCV's; which numbers it may have depends on
      // what it is called.
      Optics.Model = *Known == LensModel::Pinhole ? LensModel::OpenCv : *Known;
      Full = upperCase(Value->get<std::string>()) == "FULL_OPENCV";
      return;
    }
    const Json *Fisheye = Find("is_fisheye");
    Optics.Model = Fisheye && *Fisheye == Json(true) ? LensModel::Fisheye
                                                     : LensModel::OpenCv;
  }

  /// The place of \p Name among the model's, or nothing.
  std::optional<std::size_t> placeOf(std::string_view Name) const {
    const auto Keys = Optics.keys();
    const auto At = std::ranges::find(Keys, Name);
    if (At == Keys.end())
      return std::nullopt;
    return static_cast<std::size_t>(At - Keys.begin());
  }

  void set(const char *Key, std::string_view Name, const Json &Value) {
    if (!Value.is_number() ||
        !(std::abs(Value.get<double>()) <= MostLensCoefficient))
      return fail(fmt::format("key {} is wrong, expected numbers from -{:g} to "
                              "{:g}",
                              Key, MostLensCoefficient, MostLensCoefficient));
    const double Number = Value.get<double>();
    const auto Place = placeOf(Name);
    if (Place)
      Optics.K[*Place] = Number;
    else if (Number != 0)
      fail(fmt::format("key {} calls for a distortion by {}, which a camera of "
                       "model {} does not have, expected 0",
                       Key, Name, name(Optics.Model)));
  }

  void readNumbers() {
    for (const std::string_view Name : LensKeys) {
      const std::string Key(Name);
      const Json *Value = Find(Key.c_str());
      // A unit's "s1" may be anything; numbers are lenses'.
      if (!Value || Value->is_null())
        continue;
      set(Key.c_str(), Name, *Value);
      // k4 is OpenCV's first number under the fraction, and nerfstudio's fourth
      // above it.
      const auto Place = placeOf(Name);
      if (Optics.Model == LensModel::OpenCv && !Full && Place &&
          *Place >= LensK4 && *Place < LensR8 && Optics.K[*Place] != 0)
        fail(fmt::format("key {} means different things to different programs, "
                         "expected camera_model FULL_OPENCV with it, or 0",
                         Key));
    }
  }

  void readLists() {
    // OpenCV's next are of a tilted sensor.
    std::vector<std::string_view> All(LensKeys.begin(),
                                      LensKeys.begin() + LensR8);
    std::vector<std::string_view> Radial{"k1", "k2", "k3", "k4", "k5", "k6"};
    if (Optics.Model == LensModel::Fisheye) {
      All.assign(FisheyeKeys.begin(), FisheyeKeys.end());
      Radial = All;
    }
    const ListKey Lists[] = {{"dist_coeffs", All},
                             {"radial_coeffs", Radial},
                             {"tangential_coeffs", {"p1", "p2"}},
                             {"thin_prism_coeffs", {"s1", "s2", "s3", "s4"}}};
    for (const auto &[Key, Names] : Lists) {
      const Json *Value = Find(Key);
      if (!Value || Value->is_null())
        continue;
      if (!Value->is_array() || Value->size() > Names.size())
        return fail(
            fmt::format("key {} is wrong, expected a list of at most {} "
                        "numbers",
                        Key, Names.size()));
      for (std::size_t I = 0; I < Value->size(); ++I)
        set(Key, Names[I], (*Value)[I]);
    }
  }

  void checkModel() {
    const Json *Fisheye = Find("is_fisheye");
    if (Fisheye && *Fisheye == Json(true) && Optics.Model != LensModel::Fisheye)
      fail(fmt::format("key is_fisheye calls for OPENCV_FISHEYE, but the "
                       "camera's model is {}, expected one of both",
                       name(Optics.Model)));
  }

  const KeyFinder &Find;
  CameraModel Optics;
  bool Full = false;
  std::optional<std::string> Problem;
};

} // namespace

Json lensJson(const CameraModel &M) {
  if (M.isPinhole())
    return nullptr;
  Json Lens{{"camera_model", name(M.Model)}};
  const auto Keys = M.keys();
  for (std::size_t K = 0; K < Keys.size(); ++K)
    Lens[std::string(Keys[K])] = M.K[K];
  return Lens;
}

void setSphere(Camera &C) {
  C.Fx = C.Width / (2 * M_PI);
  C.Fy = C.Height / M_PI;
  C.Cx = 0.5 * C.Width;
  C.Cy = 0.5 * C.Height;
}

std::optional<std::string> readLens(const KeyFinder &Find, Camera &C) {
  return LensReader(Find).read(C);
}

} // namespace vorion::splat
