#include "io/CameraLens.h"

#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace vorion::splat {

namespace {

using Json = nlohmann::json;

constexpr const char *ModelKeys[] = {"camera_model", "lens_model",
                                     "model",        "camera_type",
                                     "projection",   "projection_type"};

/// A list's key, and the names of its numbers by order.
struct ListKey {
  const char *Key;
  std::vector<std::string_view> Names;
};

class LensReader {
public:
  LensReader(const KeyFinder &Find, FourthTerm K4) : Find(Find), K4(K4) {}

  Expected<CameraModel> read() {
    readModel();
    readNumbers();
    readLists();
    if (Problem)
      return Error{"", *Problem};
    return simplified(Optics);
  }

private:
  void fail(std::string What) {
    if (!Problem)
      Problem = std::move(What);
  }

  /// The value of \p Key, unless that is null and says nothing.
  const Json *find(const char *Key) const {
    const Json *Value = Find(Key);
    return Value && !Value->is_null() ? Value : nullptr;
  }

  /// What \p Value, which \p Key has, calls the model.
  std::optional<LensModel> modelOf(const char *Key, const Json &Value) {
    const auto Known =
        Value.is_string() ? lensModelNamed(Value.get_ref<const std::string &>())
                          : std::nullopt;
    if (!Value.is_string())
      fail(fmt::format("key {} is {}, expected a camera model's name, {}", Key,
                       printable(jsonText(Value)), knownLensModels()));
    else if (!Known)
      fail(fmt::format("key {} calls for the camera model {}, which is not "
                       "supported, expected {}",
                       Key, printable(jsonText(Value)), knownLensModels()));
    else if (upperCase(Value.get<std::string>()) == "FULL_OPENCV")
      Full = true;
    // A distorted pinhole is OpenCV's; which numbers it may have depends on
    // what it is called.
    return Known == LensModel::Pinhole ? LensModel::OpenCv : Known;
  }

  void readModel() {
    const char *By = nullptr;
    for (const char *Key : ModelKeys) {
      const Json *Value = find(Key);
      if (!Value)
        continue;
      const auto Model = modelOf(Key, *Value);
      if (By && Model && *Model != Optics.Model)
        fail(fmt::format("keys {} and {} call for two camera models, expected "
                         "one",
                         By, Key));
      By = Key;
      if (Model) {
        Optics.Model = *Model;
        Called = upperCase(Value->get<std::string>());
      }
    }
    const Json *Fisheye = find("is_fisheye");
    if (!Fisheye)
      return;
    if (!Fisheye->is_boolean())
      fail(fmt::format("key is_fisheye is {}, expected true or false",
                       printable(jsonText(*Fisheye))));
    else if (!Fisheye->get<bool>())
      return;
    else if (By && Optics.Model != LensModel::Fisheye)
      fail(fmt::format("key is_fisheye calls for OPENCV_FISHEYE, but the "
                       "camera's model is {}, expected one of both",
                       Called));
    else if (!By)
      Called = name(LensModel::Fisheye);
    Optics.Model = LensModel::Fisheye;
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
                       Key, Name, Called));
  }

  void readNumbers() {
    for (const std::string_view Name : LensKeys) {
      const std::string Key(Name);
      const Json *Value = find(Key.c_str());
      if (!Value)
        continue;
      const bool IsPlain = Optics.Model == LensModel::OpenCv && !Full;
      if (IsPlain && Name == "k4" && K4 == FourthTerm::Above) {
        set("k4", "r8", *Value);
        continue;
      }
      set(Key.c_str(), Name, *Value);
      // k4 is OpenCV's first number under the fraction, and nerfstudio's fourth
      // above it.
      const auto Place = placeOf(Name);
      if (IsPlain && Place && *Place >= LensK4 && *Place < LensR8 &&
          Optics.K[*Place] != 0)
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
      const Json *Value = find(Key);
      if (!Value)
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

  const KeyFinder &Find;
  FourthTerm K4;
  CameraModel Optics{LensModel::OpenCv, {}};
  /// As the file has the model's name; without one no coefficient is wrong.
  std::string Called = "OPENCV";
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

Expected<CameraModel> readLens(const KeyFinder &Find, FourthTerm K4) {
  return LensReader(Find, K4).read();
}

} // namespace vorion::splat
