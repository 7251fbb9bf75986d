/// The settings of training by name, for options, presets and reports.
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

/// A numeric member of \c TrainSettings.
struct SettingField {
  std::string_view Name; ///< in JSON: position_rate
  std::string_view What; ///< description for the help
  std::variant<double TrainSettings::*, unsigned TrainSettings::*> Member;
  double Least, Most; ///< inclusive limits
  /// The only method that it affects.
  std::optional<DensityMethod> Only = std::nullopt;
  /// Whether its option is generated from the table; otherwise it is declared
  /// elsewhere.
  bool HasOption = true;

  bool isWhole() const { return Member.index() == 1; }
  double get(const TrainSettings &S) const;
  void set(TrainSettings &S, double Value) const;
  /// Whether \p Value is valid.
  bool takes(double Value) const;
  std::string option() const; ///< --position-rate
};
std::span<const SettingField> settingFields();
/// The setting \p Name, which must exist.
const SettingField &settingField(std::string_view Name);

/// Names of the built-in presets.
std::span<const std::string_view> presetNames();

/// The preset \p Name: one of \c presetNames, or a file with the extension
/// .json. The file has values by name, `density` for the method, `absgrad`, and
/// `preset` for the preset that it modifies (default: inria).
Expected<TrainSettings> readPreset(const std::string &Name);

/// All of \p S by name.
nlohmann::ordered_json settingsJson(const TrainSettings &S);
/// The values of \p S that differ from the defaults.
nlohmann::ordered_json changedSettings(const TrainSettings &S);

} // namespace vorion::splat
