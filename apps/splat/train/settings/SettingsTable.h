/// The settings of training by name: for options, presets and reports.
#pragma once

#include "train/settings/Settings.h"
#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace vorion::splat {

/// A number of \c TrainSettings.
struct SettingField {
  std::string_view Name; ///< as JSON has it: position_rate
  std::string_view What; ///< for people
  std::variant<double TrainSettings::*, unsigned TrainSettings::*> Member;
  double Least, Most; ///< both are taken
  /// Without an effect on other methods.
  std::optional<DensityMethod> Only = std::nullopt;
  /// Whether the table makes its option; others have one elsewhere.
  bool HasOption = true;

  bool isWhole() const { return Member.index() == 1; }
  double get(const TrainSettings &S) const;
  void set(TrainSettings &S, double Value) const;
  /// That \p Value may be set.
  bool takes(double Value) const;
  std::string option() const; ///< --position-rate
};
std::span<const SettingField> settingFields();
/// The one that is called \p Name, which there is.
const SettingField &settingField(std::string_view Name);

/// Names of the settings that come with the program.
std::span<const std::string_view> presetNames();

/// The settings that are called \p Name: one of \c presetNames, or a file of
/// JSON, whose name ends so. It has values by name, `density` for the method,
/// `absgrad`, and `preset` for the settings that it changes (default: inria).
Expected<TrainSettings> readPreset(const std::string &Name);

/// All of \p S by name.
nlohmann::ordered_json settingsJson(const TrainSettings &S);
/// What of \p S is not the default.
nlohmann::ordered_json changedSettings(const TrainSettings &S);

} // namespace vorion::splat
