#include "explore/Space.h"

#include "vorion/support/Json.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// Whether \p Text has letters, digits and \p Besides, and some.
bool hasOnly(std::string_view Text, std::string_view Besides) {
  return !Text.empty() && std::ranges::all_of(Text, [&](unsigned char C) {
    return std::isalnum(C) != 0 ||
           Besides.find(static_cast<char>(C)) != Besides.npos;
  });
}

/// A value as --set and a command line have it; nothing for other than numbers
/// and names.
std::string textOf(const Json &Value) {
  if (Value.is_number())
    return jsonText(Value);
  const std::string Text = Value.is_string() ? Value.get<std::string>() : "";
  return hasOnly(Text, "-_.:/") ? Text : ""; // --pixel-unit last:1/2
}

class SpaceReader {
public:
  explicit SpaceReader(const std::string &Where) : Where(Where) {}

  Expected<Space> read(const Json &All);

private:
  Error expected(const std::string &Key, const std::string &What) const {
    return {Where, fmt::format("key {}: expected {}", Key, What)};
  }
  Expected<Parameter> parameter(const std::string &Name, const Json &Of) const;
  Expected<Parameter> ofValues(const std::string &Name, const Json &Of) const;
  Expected<Parameter> ofChoices(const std::string &Name,
                                const Json &Choices) const;

  const std::string &Where;
};

Expected<Parameter> SpaceReader::ofValues(const std::string &Name,
                                          const Json &Of) const {
  const std::string Kind = Of.contains("key") ? "key" : "option";
  const std::string Key = fmt::format("parameters.{}", Name);
  const Json &Called = Of[Kind];
  const std::string Target =
      Called.is_string() ? Called.get<std::string>() : "";
  if (!isPlainName(Target) || (Kind == "option") != Target.starts_with("--"))
    return expected(fmt::format("{}.{}", Key, Kind),
                    Kind == "key"
                        ? "a configuration key"
                        : "an option of splat render, such as --tile");
  if (!Of["values"].is_array() || Of["values"].empty())
    return expected(Key + ".values", "a list with at least one value");
  Parameter P{Name, {}};
  for (const Json &Value : Of["values"]) {
    const std::string Text = textOf(Value);
    if (Text.empty())
      return expected(Key + ".values", "numbers or names");
    if (Kind == "key")
      P.Others.push_back({Text, fmt::format("{}={}", Target, Text), {}});
    else
      P.Others.push_back({Text, "", {Target, Text}});
  }
  return P;
}

Expected<Parameter> SpaceReader::ofChoices(const std::string &Name,
                                           const Json &Choices) const {
  const std::string Key = fmt::format("parameters.{}.choices", Name);
  if (!Choices.is_object() || Choices.empty())
    return expected(Key, "an object with at least one choice");
  Parameter P{Name, {}};
  for (const auto &[Choice, Settings] : Choices.items()) {
    if (!isPlainName(Choice))
      return expected(Key, "names of letters, digits, '-', '_' and '.'");
    if (!Settings.is_object() || Settings.empty())
      return expected(fmt::format("{}.{}", Key, Choice),
                      "an object of configuration keys");
    Alternative A{Choice, "", {}};
    for (const auto &[Target, Value] : Settings.items()) {
      const std::string Text = textOf(Value);
      if (!isPlainName(Target) || Text.empty())
        return expected(fmt::format("{}.{}", Key, Choice),
                        "configuration keys with numbers or names");
      A.Settings +=
          fmt::format("{}{}={}", A.Settings.empty() ? "" : ",", Target, Text);
    }
    P.Others.push_back(std::move(A));
  }
  return P;
}

Expected<Parameter> SpaceReader::parameter(const std::string &Name,
                                           const Json &Of) const {
  if (!isPlainName(Name))
    return expected("parameters", "names of letters, digits, '-', '_' and '.'");
  const auto HasOnly = [&Of](std::initializer_list<const char *> Keys) {
    return Of.size() == Keys.size() &&
           std::ranges::all_of(
               Keys, [&Of](const char *Key) { return Of.contains(Key); });
  };
  if (Of.is_object() && HasOnly({"choices"}))
    return ofChoices(Name, Of["choices"]);
  if (Of.is_object() &&
      (HasOnly({"key", "values"}) || HasOnly({"option", "values"})))
    return ofValues(Name, Of);
  return expected("parameters." + Name,
                  "\"key\" and \"values\", \"option\" and \"values\", or "
                  "\"choices\"");
}

Expected<Space> SpaceReader::read(const Json &All) {
  if (!All.is_object() || All.size() != 1 || !All.contains("parameters") ||
      !All["parameters"].is_object() || All["parameters"].empty())
    return Error{Where, "expected an object with only the key \"parameters\", "
                        "an object with at least one parameter"};
  Space S;
  for (const auto &[Name, Of] : All["parameters"].items()) {
    auto One = parameter(Name, Of);
    if (!One)
      return One.error();
    std::set<std::string> Names{"base"};
    for (const Alternative &A : One->Others)
      if (!Names.insert(A.Name).second)
        return expected("parameters." + Name,
                        fmt::format("values with different names, found {} "
                                    "twice",
                                    A.Name));
    S.push_back(std::move(*One));
  }
  return S;
}

} // namespace

bool isPlainName(std::string_view Text) { return hasOnly(Text, "-_."); }

static Expected<Space> spaceIn(const Expected<Json> &All,
                               const std::string &Where) {
  return All ? SpaceReader(Where).read(*All) : Expected<Space>(All.error());
}

static constexpr const char *Wanted = "a design space";

Expected<Space> parseSpace(std::string_view Text, const std::string &Where) {
  return spaceIn(parseJson<Json>(Text, Where, Wanted), Where);
}

Expected<Space> readSpace(const std::string &File) {
  return spaceIn(readJson<Json>(File, Wanted), File);
}

std::string nameOf(const Space &S, const Choices &C) {
  std::string Name;
  for (std::size_t P = 0; P < S.size(); ++P)
    if (C[P] != 0)
      Name += fmt::format("{}{}={}", Name.empty() ? "" : ",", S[P].Name,
                          S[P].Others[C[P] - 1].Name);
  return Name.empty() ? "base" : Name;
}

std::string settingsOf(const Space &S, const Choices &C) {
  std::string Settings;
  for (std::size_t P = 0; P < S.size(); ++P)
    if (C[P] != 0 && !S[P].Others[C[P] - 1].Settings.empty())
      Settings += fmt::format("{}{}", Settings.empty() ? "" : ",",
                              S[P].Others[C[P] - 1].Settings);
  return Settings;
}

std::vector<std::string> argumentsOf(const Space &S, const Choices &C) {
  std::vector<std::string> All;
  for (std::size_t P = 0; P < S.size(); ++P)
    if (C[P] != 0)
      for (const std::string &Word : S[P].Others[C[P] - 1].Arguments)
        All.push_back(Word);
  return All;
}

Choices seenBy(const std::set<std::string> &Known, const Space &S, Choices C) {
  for (std::size_t P = 0; P < S.size(); ++P)
    if (C[P] != 0) {
      const auto &Arguments = S[P].Others[C[P] - 1].Arguments;
      if (!Arguments.empty() && !Known.contains(Arguments.front()))
        C[P] = 0;
    }
  return C;
}

std::vector<Choices> machinesOf(const Space &S, std::size_t Count,
                                uint64_t Seed, std::size_t &Singles) {
  std::vector<Choices> All{Choices(S.size(), 0)};
  double Most = 1;
  for (std::size_t P = 0; P < S.size(); ++P) {
    Most *= static_cast<double>(S[P].Others.size() + 1);
    for (std::size_t Value = 1; Value <= S[P].Others.size(); ++Value) {
      All.push_back(All.front());
      All.back()[P] = Value;
    }
  }
  Singles = All.size();
  std::set<Choices> Known(All.begin(), All.end());
  // The generator's numbers are the standard's; its distributions are not.
  std::mt19937_64 Random(Seed);
  while (All.size() < Count && static_cast<double>(All.size()) < Most) {
    Choices C(S.size());
    for (std::size_t P = 0; P < S.size(); ++P)
      C[P] = Random() % (S[P].Others.size() + 1);
    if (Known.insert(C).second)
      All.push_back(std::move(C));
  }
  return All;
}

} // namespace vorion::splat
