#include "commands/TrainSettingOptions.h"

#include "vorion/support/CommandLine.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorion::splat {

void addSettingOptions(CLI::App &App, SettingOptions &To) {
  constexpr const char *Group = "Hyperparameters of training";
  takesNameOrFile(
      App.add_option("--preset", To.Preset,
                     fmt::format("Hyperparameters to start from: {} or a "
                                 "file .json (default {})",
                                 fmt::join(presetNames(), ", "),
                                 presetNames().front())),
      {presetNames().begin(), presetNames().end()}, {".json"})
      ->group(Group);
  App.add_option("--density", To.Method,
                 "Density control: classic (Kerbl et al. 2023), or mcmc "
                 "(Kheradmand et al. 2024) (default classic)")
      ->option_text("classic|mcmc")
      ->check(isOneOf({std::string(name(DensityMethod::Classic)),
                       std::string(name(DensityMethod::Mcmc))}))
      ->group(Group);
  App.add_flag("--absgrad", To.AbsoluteGradient,
               "Densify by absolute gradients (AbsGS, Ye et al. 2024); needs "
               "--path simt")
      ->group(Group);
  const TrainSettings Default;
  for (const SettingField &F : settingFields()) {
    if (!F.HasOption)
      continue;
    std::string What(F.What);
    What.front() = static_cast<char>(std::toupper(What.front()));
    App.add_option_function<double>(
           F.option(),
           [&To, &F](double Value) { To.Values.emplace_back(&F, Value); },
           fmt::format("{} (default {})", What, F.get(Default)))
        ->option_text(F.isWhole() ? "N" : "X")
        ->check(CLI::Validator(
            [&F](const std::string &Text) {
              double Value = 0;
              return CLI::detail::lexical_cast(Text, Value) && F.takes(Value)
                         ? std::string()
                         : fmt::format("{}: expected a {}number, {} to {}",
                                       Text, F.isWhole() ? "whole " : "",
                                       F.Least, F.Most);
            },
            ""))
        ->group(Group);
  }
}

Expected<TrainSettings>
SettingOptions::settings(const CLI::App &App, const TrainSettings &Own) const {
  TrainSettings S;
  if (!Preset.empty()) {
    auto Read = readPreset(Preset);
    if (!Read)
      return Read.error();
    S = *Read;
  }
  for (const SettingField &F : settingFields())
    if (!F.HasOption && App.count(F.option()) != 0)
      F.set(S, F.get(Own));
  if (!Method.empty())
    S.Method = Method == name(DensityMethod::Mcmc) ? DensityMethod::Mcmc
                                                   : DensityMethod::Classic;
  S.AbsoluteGradient = S.AbsoluteGradient || AbsoluteGradient;
  if (S.AbsoluteGradient && S.Method != DensityMethod::Classic)
    return Error{"", "--absgrad: expected --density classic", ExitCode::Usage};
  for (const auto &[Field, Value] : Values) {
    if (Field->Only && *Field->Only != S.Method)
      return Error{"",
                   fmt::format("{}: expected --density {}", Field->option(),
                               name(*Field->Only)),
                   ExitCode::Usage};
    Field->set(S, Value);
  }
  // A last rate says nothing where the first one is 0, for none.
  constexpr std::string_view Last = "last_";
  for (const auto &[Field, Value] : Values) {
    if (!Field->Name.starts_with(Last))
      continue;
    const SettingField &First = settingField(Field->Name.substr(Last.size()));
    if (First.get(S) == 0)
      return Error{"",
                   fmt::format("{}: expected {} above 0", Field->option(),
                               First.option()),
                   ExitCode::Usage};
  }
  return S;
}

} // namespace vorion::splat
