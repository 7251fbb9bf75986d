/// The options of `splat train` that override a setting.
#pragma once

#include "train/settings/SettingsTable.h"

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace vorion::splat {

/// The values on the command line.
struct SettingOptions {
  std::string Preset;
  std::string Method; ///< name of a method, or empty
  bool AbsoluteGradient = false;
  std::vector<std::pair<const SettingField *, double>> Values;

  /// The preset, overridden by the values on the command line. \p Own has the
  /// values of the options that are not in the table, which take precedence if
  /// \p App has them.
  Expected<TrainSettings> settings(const CLI::App &App,
                                   const TrainSettings &Own) const;
};

/// \p To must outlive the parsing.
void addSettingOptions(CLI::App &App, SettingOptions &To);

} // namespace vorion::splat
