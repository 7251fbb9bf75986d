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
    {"max_gaussians", "most Gaussians", &S::MostGaussians, 4, 1e8, {}, false},
    {"beta1", "Adam's decay of gradients", &S::Beta1, 0, 0.999999},
    {"beta2", "Adam's decay of their squares", &S::Beta2, 0, 0.99999999},
    {"epsilon", "Adam's summand of the divisor", &S::Epsilon, 1e-30, 1},
    {"position_rate", "rate of positions at first, over the cameras' extent",
     &S::PositionRate, 1e-30, Large},
    {"last_position_rate", "the same at last", &S::LastPositionRate, 1e-30,
     Large},
    {"position_steps", "iterations from the first rate to the last",
     &S::PositionSteps, 1, Many},
    {"colour_rate", "rate of the constant band of colours", &S::ColourRate, 0,
     Large},
    {"later_colour_rate", "rate of the other bands", &S::LaterColourRate, 0,
     Large},
    {"opacity_rate", "rate of opacities", &S::OpacityRate, 0, Large},
    {"scale_rate", "rate of scales", &S::ScaleRate, 0, Large},
    {"rotation_rate", "rate of rotations", &S::RotationRate, 0, Large},
    {"exposure_rate", "rate of the pictures' exposures at first; 0 for none",
     &S::ExposureRate, 0, Large},
    {"last_exposure_rate", "the same at last", &S::LastExposureRate, 1e-30,
     Large},
    {"pose_rate", "rate of the corrections of poses at first; 0 for none",
     &S::PoseRate, 0, Large},
    {"last_pose_rate", "the same at last", &S::LastPoseRate, 1e-30, Large},
    {"dssim", "share of 1 - SSIM in the loss", &S::DSsim, 0, 1},
    {"opacity_weight", "weight of the mean opacity in the loss",
     &S::OpacityWeight, 0, Large},
    {"scale_weight", "weight of the mean scale in the loss", &S::ScaleWeight, 0,
     Large},
    {"depth_weight",
     "weight of the depths of the capture's points in the loss; 0 for none",
     &S::DepthWeight, 0, Large},
    {"sh_interval", "iterations from a band of colours to the next",
     &S::ShInterval, 1, Many},
    {"start_opacity", "opacity of the first Gaussians", &S::StartOpacity, Faint,
     Opaque},
    {"start_scale", "their scales, over the neighbours' distance",
     &S::StartScale, 1e-6, 1e6},
    {"densify_interval", "iterations from a change of density to the next",
     &S::DensifyInterval, 1, Many},
    {"densify_after", "no change of density until then", &S::DensifyAfter, 0,
     Many},
    {"densify_until", "nor from then on", &S::DensifyUntil, 0, Many},
    {"densify_gradient", "gradient above which a Gaussian grows, half pictures",
     &S::DensifyGradient, 0, Large, Classic},
    {"split_extent", "scale above which it splits, over the cameras' extent",
     &S::SplitExtent, 1e-12, Large, Classic},
    {"split_shrink", "divisor of the scales of a split's halves",
     &S::SplitShrink, 1e-3, 1e3, Classic},
    {"least_opacity", "opacity below which a Gaussian is dropped or moved",
     &S::LeastOpacity, Faint, Opaque},
    {"most_extent", "scale above which one is dropped, over the extent",
     &S::MostExtent, 1e-12, Large, Classic},
    {"most_radius", "radius above which one is dropped, pixels", &S::MostRadius,
     0, Large, Classic},
    {"reset_interval", "iterations from a reset of opacities to the next",
     &S::ResetInterval, 1, Many, Classic},
    {"reset_opacity", "opacity that a reset leaves", &S::ResetOpacity, Faint,
     Opaque, Classic},
    {"white_reset", "iteration of one more on white; 0 for none",
     &S::WhiteReset, 0, Many, Classic},
    {"grow_share", "Gaussians that a change adds, over those that there are",
     &S::GrowShare, 0, 10, Mcmc},
    {"noise_rate", "random steps, over the rate of positions", &S::NoiseRate, 0,
     Large, Mcmc}};

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
    return Error{Where, "key density is wrong, expected classic or mcmc"};
  }
  if (Key == "absgrad") {
    if (!Value.is_boolean())
      return Error{Where, "key absgrad is wrong, expected true or false"};
    To.AbsoluteGradient = Value.get<bool>();
    return Success{};
  }
  const auto Field = std::ranges::find(Fields, Key, &SettingField::Name);
  if (Field == std::end(Fields)) {
    std::vector<std::string> Known{"preset", "density", "absgrad"};
    for (const SettingField &F : Fields)
      Known.emplace_back(F.Name);
    return Error{Where, fmt::format("key {} is no setting{}", printable(Key),
                                    didYouMean(Key, Known))};
  }
  if (!Value.is_number() || !Field->takes(Value.get<double>()))
    return Error{Where, fmt::format("key {} is wrong, expected a {}number, {} "
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
    return Error{Name, "no JSON object, expected settings by name"};
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
