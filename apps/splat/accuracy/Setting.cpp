#include "Setting.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

namespace vorion::splat {

const std::vector<Knob> &allKnobs() {
  static const std::vector<Knob> All{
      {"exp",
       {"exact", "table", "table32", "table64", "poly2", "poly3", "poly4",
        "linear", "schraudolph"},
       "exp"},
      {"blend", {"fp32", "bf16", "fp16"}, ""},
      {"alpha-cutoff", {"1", "2", "4", "8"}, "alpha-cutoff"},
      {"cutoff", {"0.0001", "0.001", "0.003", "0.01", "0.03"}, "cutoff"},
      {"tile", {"64", "32", "16"}, ""},
      {"support", {"exact", "box3", "square3"}, "support"},
      {"sh-degree", {"3", "2", "1", "0"}, "sh-degree"},
      {"depth-bits", {"32", "24", "20", "16", "12"}, "depth-bits"},
      {"ztiles", {"1", "2", "4", "8"}, ""},
      {"pixel-unit", {"off", "last:1/4", "last:1/2", "occluded:0.9"}, ""},
      {"skip-saturated", {"off", "on"}, ""},
  };
  return All;
}

const std::vector<Knob> &trainKnobs() {
  static const std::vector<Knob> All{
      {"reciprocal",
       {"exact", "even-left", "even-best", "log-left", "log-best", "mantissa-2",
        "mantissa-3"},
       ""},
      {"sum", {"tree", "rows"}, ""},
  };
  return All;
}

static const Knob *findIn(const std::vector<Knob> &Knobs,
                          const std::string &Name) {
  for (const Knob &K : Knobs)
    if (K.Name == Name)
      return &K;
  return nullptr;
}

static bool isValue(const Knob &K, const std::string &Value) {
  return std::find(K.Values.begin(), K.Values.end(), Value) != K.Values.end();
}

static std::string knobNames() {
  std::vector<std::string> Names;
  Names.reserve(allKnobs().size());
  for (const Knob &K : allKnobs())
    Names.push_back(K.Name);
  return fmt::format("{}", fmt::join(Names, ", "));
}

Expected<std::vector<Knob>> knobsNamed(const std::vector<std::string> &Names) {
  for (const std::string &Name : Names)
    if (!findIn(allKnobs(), Name))
      return Error{"",
                   fmt::format("--knobs {}: no such knob, expected some of {}",
                               Name, knobNames()),
                   ExitCode::Usage};
  std::vector<Knob> Found;
  for (const Knob &K : allKnobs())
    if (Names.empty() ||
        std::find(Names.begin(), Names.end(), K.Name) != Names.end())
      Found.push_back(K);
  return Found;
}

Setting Setting::with(const Knob &K, const std::string &Value) const {
  Setting S = *this;
  if (Value != K.Values.front())
    S.Choices.emplace_back(K.Name, Value);
  return S;
}

std::string Setting::name() const {
  std::string Text;
  for (const auto &[Name, Value] : Choices)
    Text += fmt::format("{}{}={}", Text.empty() ? "" : ",", Name, Value);
  return Text.empty() ? "default" : Text;
}

Expected<Setting> Setting::parse(const std::string &Name) {
  const auto Wrong = [&](const std::string &What) {
    return Error{"",
                 fmt::format("setting '{}': {}, expected default or "
                             "KNOB=VALUE,... with knobs of {}",
                             Name, What, knobNames()),
                 ExitCode::Usage};
  };
  if (Name == "default")
    return Setting();
  std::vector<std::pair<const Knob *, std::string>> Parts;
  std::istringstream In(Name);
  for (std::string Part; std::getline(In, Part, ',');) {
    const std::size_t Equals = Part.find('=');
    const Knob *K = findIn(allKnobs(), Part.substr(0, Equals));
    if (Equals == std::string::npos || !K ||
        !isValue(*K, Part.substr(Equals + 1)))
      return Wrong(fmt::format("'{}' is no choice", Part));
    Parts.emplace_back(K, Part.substr(Equals + 1));
  }
  // One order, so that a setting has one name; knobs lie in one array.
  std::sort(Parts.begin(), Parts.end());
  Setting S;
  for (std::size_t I = 0; I < Parts.size(); ++I) {
    if (I > 0 && Parts[I - 1].first == Parts[I].first)
      return Wrong(fmt::format("{} is there twice", Parts[I].first->Name));
    S = S.with(*Parts[I].first, Parts[I].second);
  }
  return S;
}

std::string Setting::value(const std::string &Name) const {
  for (const auto &[Chosen, Value] : Choices)
    if (Chosen == Name)
      return Value;
  const Knob *K = findIn(allKnobs(), Name);
  if (!K)
    K = findIn(trainKnobs(), Name);
  return K ? K->Values.front() : std::string();
}

/// A flag has the values off and on.
static void append(std::vector<std::string> &To, const std::string &Option,
                   const std::string &Value) {
  To.push_back("--" + Option);
  if (Value != "on")
    To.push_back(Value);
}

std::vector<std::string> Setting::arguments() const {
  std::vector<std::string> Out{"--path", "raster"};
  for (const auto &[Name, Value] : Choices)
    append(Out, Name, Value);
  return Out;
}

std::optional<std::vector<std::string>> Setting::coresArguments() const {
  std::vector<std::string> Out{"--path", "simt"};
  for (const auto &[Name, Value] : Choices) {
    const Knob *K = findIn(allKnobs(), Name);
    if (K->CoresName.empty() || (Name == "exp" && Value.starts_with("table")))
      return std::nullopt;
    append(Out, K->CoresName, Value);
  }
  return Out;
}

std::vector<Setting> oneAtATime(const std::vector<Knob> &Knobs) {
  std::vector<Setting> All{Setting()};
  for (const Knob &K : Knobs)
    for (std::size_t V = 1; V < K.Values.size(); ++V)
      All.push_back(Setting().with(K, K.Values[V]));
  return All;
}

} // namespace vorion::splat
