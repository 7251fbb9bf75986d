/// The options of `splat train` that set one of its settings.
#pragma once

#include "train/settings/SettingsTable.h"

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace vorion::splat {

/// What was given on the command line.
struct SettingOptions {
  std::string Preset;
  std::string Method; ///< a name, or empty
  bool AbsoluteGradient = false;
  std::vector<std::pair<const SettingField *, double>> Values;

  /// The settings: what was given over the preset. \p Own have the options
  /// that the table does not make; they stay where \p App was given them.
  Expected<TrainSettings> settings(const CLI::App &App,
                                   const TrainSettings &Own) const;
};

/// \p To must outlive the parsing.
void addSettingOptions(CLI::App &App, SettingOptions &To);

} // namespace vorion::splat
