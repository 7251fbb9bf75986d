#include "train/settings/SettingsTable.h"

#include "io/Bytes.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;
using S = TrainSettings;

constexpr double Many = 1e7;   // iterations
constexpr double Large = 1e12; // of rates and sizes
constexpr double Faint = 1e-6, Opaque = 1 - 1e-6;
constexpr auto Classic = DensityMethod::Classic, Mcmc = DensityMethod::Mcmc;

constexpr SettingField Fields[] = {
    {"iterations", "iterations", &S::Iterations, 1, Many, {}, false},
    {"max_gaussians",
     "maximum number of Gaussians",
     &S::MostGaussians,
     4,
     1e8,
     {},
     false},
    {"beta1", "Adam's decay rate of the first moment", &S::Beta1, 0, 0.999999},
    {"beta2", "Adam's decay rate of the second moment", &S::Beta2, 0,
     0.99999999},
    {"epsilon", "Adam's epsilon in the denominator", &S::Epsilon, 1e-30, 1},
    {"position_rate",
     "initial learning rate of positions, relative to the cameras' extent",
     &S::PositionRate, 1e-30, Large},
    {"last_position_rate", "final learning rate of positions",
     &S::LastPositionRate, 1e-30, Large},
    {"position_steps", "iterations of the decay of the position rate",
     &S::PositionSteps, 1, Many},
    {"colour_rate", "learning rate of the SH coefficients of degree 0",
     &S::ColourRate, 0, Large},
    {"later_colour_rate", "learning rate of the other SH coefficients",
     &S::LaterColourRate, 0, Large},
    {"opacity_rate", "learning rate of opacities", &S::OpacityRate, 0, Large},
    {"scale_rate", "learning rate of scales", &S::ScaleRate, 0, Large},
    {"rotation_rate", "learning rate of rotations", &S::RotationRate, 0, Large},
    {"exposure_rate",
     "initial learning rate of the pictures' exposures (0: off)",
     &S::ExposureRate, 0, Large},
    {"last_exposure_rate", "final learning rate of exposures",
     &S::LastExposureRate, 1e-30, Large},
    {"pose_rate", "initial learning rate of pose corrections (0: off)",
     &S::PoseRate, 0, Large},
    {"last_pose_rate", "final learning rate of pose corrections",
     &S::LastPoseRate, 1e-30, Large},
    {"dssim", "weight of 1 - SSIM in the loss", &S::DSsim, 0, 1},
    {"opacity_weight", "weight of the mean opacity in the loss",
     &S::OpacityWeight, 0, Large},
    {"scale_weight", "weight of the mean scale in the loss", &S::ScaleWeight, 0,
     Large},
    {"depth_weight",
     "weight of the depth loss on the capture's points (0: off)",
     &S::DepthWeight, 0, Large},
    {"sh_interval", "iterations between increments of the SH degree",
     &S::ShInterval, 1, Many},
    {"size_interval",
     "iterations with photographs of a quarter of their sides, and then of "
     "half "
     "(0: none)",
     &S::SizeInterval, 0, Many},
    {"start_opacity", "initial opacity of Gaussians", &S::StartOpacity, Faint,
     Opaque},
    {"start_scale",
     "initial scale of Gaussians, relative to the distance of their neighbours",
     &S::StartScale, 1e-6, 1e6},
    {"densify_interval", "iterations between steps of density control",
     &S::DensifyInterval, 1, Many},
    {"densify_after", "iteration after which density control starts",
     &S::DensifyAfter, 0, Many},
    {"densify_until", "iteration at which density control ends",
     &S::DensifyUntil, 0, Many},
    {"densify_gradient",
     "2D position gradient above which a Gaussian is densified, per half "
     "picture",
     &S::DensifyGradient, 0, Large, Classic},
    {"split_extent",
     "scale above which it is split and not cloned, relative to the cameras' "
     "extent",
     &S::SplitExtent, 1e-12, Large, Classic},
    {"split_shrink",
     "divisor of the scales of the two parts of a split Gaussian",
     &S::SplitShrink, 1e-3, 1e3, Classic},
    {"least_opacity", "opacity below which a Gaussian is pruned or relocated",
     &S::LeastOpacity, Faint, Opaque},
    {"most_extent",
     "scale above which a Gaussian is pruned, relative to the cameras' extent",
     &S::MostExtent, 1e-12, Large, Classic},
    {"most_radius", "radius in pixels above which a Gaussian is pruned",
     &S::MostRadius, 0, Large, Classic},
    {"reset_interval", "iterations between opacity resets", &S::ResetInterval,
     1, Many, Classic},
    {"reset_opacity", "upper bound of opacities after a reset",
     &S::ResetOpacity, Faint, Opaque, Classic},
    {"white_reset",
     "iteration of an additional opacity reset on a white background (0: off)",
     &S::WhiteReset, 0, Many, Classic},
    {"grow_share",
     "Gaussians added by a step of density control, relative to their number",
     &S::GrowShare, 0, 10, Mcmc},
    {"noise_rate", "scale of the position noise, relative to the position rate",
     &S::NoiseRate, 0, Large, Mcmc}};

/// gsplat's default strategy, which drops nothing by its radius.
TrainSettings gsplatSettings() {
  TrainSettings T;
  T.MostRadius = Large;
  T.WhiteReset = 0;
  return T;
}

/// gsplat's MCMC strategy and the settings of its trainer for it.
TrainSettings mcmcSettings() {
  TrainSettings T;
  T.Method = DensityMethod::Mcmc;
  T.DensifyUntil = 25000;
  T.MostGaussians = 1000000;
  T.OpacityWeight = 0.01;
  T.ScaleWeight = 0.01;
  T.StartOpacity = 0.5;
  T.StartScale = 0.1;
  return T;
}

constexpr std::array<std::string_view, 3> Presets{"inria", "gsplat", "mcmc"};

Expected<TrainSettings> namedPreset(const std::string &Where,
                                    const std::string &Name) {
  if (Name == "inria")
    return TrainSettings();
  if (Name == "gsplat")
    return gsplatSettings();
  if (Name == "mcmc")
    return mcmcSettings();
  return Error{Where,
               fmt::format("no preset {}, expected {} or a file .json{}",
                           printable(Name), fmt::join(Presets, ", "),
                           didYouMean(Name, Presets)),
               ExitCode::Usage};
}

Expected<Success> take(const std::string &Where, const std::string &Key,
                       const Json &Value, TrainSettings &To) {
  if (Key == "density") {
    for (const DensityMethod M : {Classic, Mcmc})
      if (Value == name(M)) {
        To.Method = M;
        return Success{};
      }
    return Error{Where, "key density is invalid, expected classic or mcmc"};
  }
  if (Key == "absgrad") {
    if (!Value.is_boolean())
      return Error{Where, "key absgrad is invalid, expected true or false"};
    To.AbsoluteGradient = Value.get<bool>();
    return Success{};
  }
  const auto Field = std::ranges::find(Fields, Key, &SettingField::Name);
  if (Field == std::end(Fields)) {
    std::vector<std::string> Known{"preset", "density", "absgrad"};
    for (const SettingField &F : Fields)
      Known.emplace_back(F.Name);
    return Error{Where,
                 fmt::format("key {} is unknown, expected a hyperparameter{}",
                             printable(Key), didYouMean(Key, Known))};
  }
  if (!Value.is_number() || !Field->takes(Value.get<double>()))
    return Error{Where,
                 fmt::format("key {} is invalid, expected a {}number, {} "
                             "to {}",
                             Key, Field->isWhole() ? "whole " : "",
                             Field->Least, Field->Most)};
  const auto Given = Value.get<double>();
  if (Given != 0 && static_cast<float>(Given) == 0)
    return Error{Where, fmt::format("key {} is {:g}, which is 0 in single "
                                    "precision, expected 0 or more than {:.2g}",
                                    Key, Given,
                                    std::numeric_limits<float>::denorm_min())};
  Field->set(To, Given);
  return Success{};
}

} // namespace

double SettingField::get(const TrainSettings &From) const {
  return std::visit([&](auto M) { return static_cast<double>(From.*M); },
                    Member);
}

void SettingField::set(TrainSettings &To, double Value) const {
  if (const auto *Whole = std::get_if<unsigned TrainSettings::*>(&Member))
    To.*(*Whole) = static_cast<unsigned>(Value);
  else
    To.*std::get<double TrainSettings::*>(Member) = Value;
}

bool SettingField::takes(double Value) const {
  return Value >= Least && Value <= Most &&
         (!isWhole() || Value == std::floor(Value));
}

std::string SettingField::option() const {
  std::string Option = "--" + std::string(Name);
  std::ranges::replace(Option, '_', '-');
  return Option;
}

std::span<const SettingField> settingFields() { return Fields; }

const SettingField &settingField(std::string_view Name) {
  return *std::ranges::find(Fields, Name, &SettingField::Name);
}

std::span<const std::string_view> presetNames() { return Presets; }

Expected<TrainSettings> readPreset(const std::string &Name) {
  if (!Name.ends_with(".json"))
    return namedPreset("--preset", Name);
  const auto File = readFile(Name);
  if (!File)
    return File.error();
  const auto Read = parseJson<Json>(asText(*File), Name, "settings by name");
  if (!Read)
    return Read.error();
  if (!Read->is_object())
    return Error{Name, "not a JSON object, expected hyperparameters by name"};
  TrainSettings T;
  if (const auto Base = Read->find("preset"); Base != Read->end()) {
    auto From = namedPreset(Name, Base->is_string() ? Base->get<std::string>()
                                                    : jsonText(*Base));
    if (!From)
      return Error{Name, From.error().What};
    T = *From;
  }
  for (const auto &[Key, Value] : Read->items())
    if (Key != "preset")
      if (auto Taken = take(Name, Key, Value, T); !Taken)
        return Taken.error();
  return T;
}

namespace {

Json settingsWhere(const TrainSettings &T, bool All) {
  const TrainSettings Default;
  Json J = Json::object();
  if (All || T.Method != Default.Method)
    J["density"] = name(T.Method);
  if (All || T.AbsoluteGradient)
    J["absgrad"] = T.AbsoluteGradient;
  for (const SettingField &F : Fields) {
    if (!All && F.get(T) == F.get(Default))
      continue;
    if (F.isWhole())
      J[std::string(F.Name)] = static_cast<unsigned>(F.get(T));
    else
      J[std::string(F.Name)] = F.get(T);
  }
  return J;
}

} // namespace

Json settingsJson(const TrainSettings &T) { return settingsWhere(T, true); }

Json changedSettings(const TrainSettings &T) {
  Json J = settingsWhere(T, false);
  // A run may go on for longer, and has the other by name.
  J.erase("iterations");
  J.erase("max_gaussians");
  return J;
}

} // namespace vorion::splat
