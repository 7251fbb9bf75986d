#include "io/CameraLens.h"

#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
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
  std::span<const std::string_view> Names;
};

class LensReader {
public:
  LensReader(const KeyFinder &Find, FourthTerm K4) : Find(Find), K4(K4) {}

  Expected<CameraModel> read() {
    readModel();
    readNumbers();
    readLists();
    const std::string_view Range = Optics.Model->ExpectedCoefficients(Optics.K);
    if (!Range.empty())
      fail(fmt::format("the coefficients of the camera model {} are out of "
                       "range, expected {}",
                       Called, Range));
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
  const LensModel *modelOf(const char *Key, const Json &Value) {
    const LensModel *Known =
        Value.is_string() ? lensModelNamed(Value.get_ref<const std::string &>())
                          : nullptr;
    if (!Value.is_string())
      fail(fmt::format("key {} is {}, expected a camera model's name, {}", Key,
                       printable(jsonText(Value)), knownLensModels()));
    else if (!Known)
      fail(fmt::format("key {} selects the camera model {}, which is not "
                       "supported, expected {}",
                       Key, printable(jsonText(Value)), knownLensModels()));
    // Which numbers a distorted pinhole may have depends on what it is called.
    if (Known && Known->WithCoefficients)
      Known = Known->WithCoefficients;
    if (Known && upperCase(Value.get<std::string>()) == Known->Name)
      ByOwnName = true;
    return Known;
  }

  void readModel() {
    const char *By = nullptr;
    for (const char *Key : ModelKeys) {
      const Json *Value = find(Key);
      if (!Value)
        continue;
      const LensModel *Model = modelOf(Key, *Value);
      if (By && Model && Model != Optics.Model)
        fail(fmt::format(
            "keys {} and {} select different camera models, expected one model",
            By, Key));
      By = Key;
      if (Model) {
        Optics.Model = Model;
        Called = upperCase(Value->get<std::string>());
      }
    }
    for (const LensModel *Model : lenses::all())
      if (!Model->Flag.empty())
        readFlag(*Model, By != nullptr);
  }

  void readFlag(const LensModel &Model, bool HasName) {
    const Json *Value = find(std::string(Model.Flag).c_str());
    if (!Value)
      return;
    if (!Value->is_boolean())
      fail(fmt::format("key {} is {}, expected true or false", Model.Flag,
                       printable(jsonText(*Value))));
    else if (!Value->get<bool>())
      return;
    else if (HasName && Optics.Model != &Model)
      fail(fmt::format("key {} selects {}, but the camera model is {}, "
                       "expected consistent keys",
                       Model.Flag, Model.Name, Called));
    else if (!HasName)
      Called = Model.Name;
    Optics.Model = &Model;
  }

  /// The place of \p Name among the model's, or nothing.
  std::optional<std::size_t> placeOf(std::string_view Name) const {
    const auto Keys = Optics.Model->Keys;
    const auto At = std::ranges::find(Keys, Name);
    if (At == Keys.end())
      return std::nullopt;
    return static_cast<std::size_t>(At - Keys.begin());
  }

  void set(const char *Key, std::string_view Name, const Json &Value) {
    if (!Value.is_number() ||
        !(std::abs(Value.get<double>()) <= MostLensCoefficient))
      return fail(
          fmt::format("key {} is invalid, expected numbers from -{:g} to "
                      "{:g}",
                      Key, MostLensCoefficient, MostLensCoefficient));
    const double Number = Value.get<double>();
    const auto Place = placeOf(Name);
    if (Place)
      Optics.K[*Place] = Number;
    else if (Number != 0)
      fail(fmt::format("key {} sets the distortion coefficient {}, which the "
                       "camera model {} does not have, expected 0",
                       Key, Name, Called));
  }

  void readNumbers() {
    const LensModel &Model = *Optics.Model;
    for (const std::string_view Name : keysOfNumbers()) {
      const std::string Key(Name);
      const Json *Value = find(Key.c_str());
      if (!Value)
        continue;
      if (!ByOwnName && Name == "k4" && K4 == FourthTerm::Above &&
          !Model.KeyOfFourthTerm.empty()) {
        set("k4", Model.KeyOfFourthTerm, *Value);
        continue;
      }
      set(Key.c_str(), Name, *Value);
      const auto Place = placeOf(Name);
      if (!ByOwnName && Place && Optics.K[*Place] != 0 &&
          std::ranges::find(Model.AmbiguousKeys, Name) !=
              Model.AmbiguousKeys.end())
        fail(fmt::format("key {} is ambiguous between programs, expected "
                         "camera_model {}, or 0",
                         Key, Model.Name));
    }
  }

  /// Those that a pinhole may have, whichever the model is, so that it is said
  /// of what it does not have; and the model's own.
  std::vector<std::string_view> keysOfNumbers() const {
    const auto Usual = WithoutName.Keys, Own = Optics.Model->Keys;
    std::vector<std::string_view> All(Usual.begin(), Usual.end());
    std::ranges::copy_if(Own, std::back_inserter(All), [&](auto Key) {
      return std::ranges::find(Usual, Key) == Usual.end();
    });
    return All;
  }

  void readLists() {
    static constexpr std::string_view Tangential[] = {"p1", "p2"},
                                      ThinPrism[] = {"s1", "s2", "s3", "s4"};
    const ListKey Lists[] = {{"dist_coeffs", Optics.Model->ListKeys},
                             {"radial_coeffs", Optics.Model->RadialListKeys},
                             {"tangential_coeffs", Tangential},
                             {"thin_prism_coeffs", ThinPrism}};
    for (const auto &[Key, Names] : Lists) {
      const Json *Value = find(Key);
      if (!Value)
        continue;
      if (!Value->is_array() || Value->size() > Names.size())
        return fail(
            fmt::format("key {} is invalid, expected a list of at most {} "
                        "numbers",
                        Key, Names.size()));
      for (std::size_t I = 0; I < Value->size(); ++I)
        set(Key, Names[I], (*Value)[I]);
    }
  }

  const KeyFinder &Find;
  FourthTerm K4;
  /// Without a model's name coefficients are those of a pinhole.
  const LensModel &WithoutName = *CameraModel().Model->WithCoefficients;
  CameraModel Optics{&WithoutName};
  /// As the file has the model's name; without one no coefficient is wrong.
  std::string Called = "OPENCV";
  bool ByOwnName = false; ///< of the model: no key is ambiguous
  std::optional<std::string> Problem;
};

} // namespace

Json lensJson(const CameraModel &M) {
  if (M.isPinhole())
    return nullptr;
  Json Lens{{"camera_model", M.Model->Name}};
  const auto Keys = M.Model->Keys;
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
