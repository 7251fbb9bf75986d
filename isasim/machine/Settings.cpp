// The settings of a list, KEY=VALUE,..., as --set and VORION_SET have them.
#include "machine/ConfigKeys.h"
#include "machine/KeyLimits.h"
#include "machine/ShortKeys.h"
#include "vorion/support/Json.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace vorion::isasim {

/// The keys that --set takes \p Name for: itself, what it is short for, or
/// those that it is the end of.
static std::vector<const Key *> keysNamed(const std::string &Name) {
  if (const Key *K = findKey(Name))
    return {K};
  if (const ShortKey *S = findShortKey(Name); S && !S->Set)
    return {findKey(std::string(S->Key))};
  static const std::vector<std::string> Paths = [] {
    std::vector<std::string> All;
    for (const Key &K : keys())
      All.push_back(K.Path);
    return All;
  }();
  std::vector<const Key *> Found;
  for (const std::string &Path : keysEndingWith(Name, Paths))
    Found.push_back(findKey(Path));
  return Found;
}

static std::string unknownKey(const std::string &Path) {
  if (const auto Names = namesIn(Path + "."); !Names.empty())
    return fmt::format(
        "'{0}' is an object and not a key, expected '{0}.' and one of {1}",
        Path, fmt::join(Names, ", "));
  // What stands in the innermost object that there is.
  std::string Prefix = Path;
  do
    Prefix.resize(Prefix.find_last_of('.') == std::string::npos
                      ? 0
                      : Prefix.find_last_of('.'));
  while (!Prefix.empty() && namesIn(Prefix + ".").empty());
  const std::string Inside = Prefix.empty() ? "" : Prefix + ".";
  std::vector<std::string> Names = namesIn(Inside);
  if (Prefix.empty())
    for (const ShortKey &S : shortKeys())
      Names.emplace_back(S.Name);
  return fmt::format("unknown key '{}', expected {}one of {}{}", Path,
                     Prefix.empty() ? "" : "in " + Prefix + " ",
                     fmt::join(Names, ", "),
                     didYouMean(Path.substr(Inside.size()), Names));
}

static Error wrongSetting(std::string What) {
  return {"configuration", std::move(What), ExitCode::Usage};
}

static Expected<uint64_t> numberIn(std::string_view Path, std::string_view Text,
                                   uint64_t Low, uint64_t High) {
  uint64_t Value = 0;
  const auto Read =
      std::from_chars(Text.data(), Text.data() + Text.size(), Value);
  if (Read.ec != std::errc() || Read.ptr != Text.data() + Text.size())
    return wrongSetting(
        fmt::format("{} is '{}', expected a whole number, {} to {}", Path, Text,
                    Low, High));
  return Value;
}

namespace {

/// One of a list of settings.
struct Setting {
  std::string_view Name, Value;
  bool hasValue() const { return Value.data() != nullptr; }
};

} // namespace

static Setting settingOf(std::string_view Assignment) {
  const size_t Equals = Assignment.find('=');
  if (Equals == std::string_view::npos)
    return {Assignment, {}};
  return {Assignment.substr(0, Equals), Assignment.substr(Equals + 1)};
}

static std::vector<Setting> settingsOf(std::string_view List) {
  std::vector<Setting> All;
  while (!List.empty()) {
    const size_t Comma = std::min(List.find(','), List.size());
    All.push_back(settingOf(List.substr(0, Comma)));
    List.remove_prefix(std::min(Comma + 1, List.size()));
  }
  return All;
}

/// \p KeepsSockets: as of ShortKey::Set.
static Expected<Success> setValue(Config &C, const Setting &Of,
                                  bool KeepsSockets) {
  const auto Fail = wrongSetting;
  const std::string Name(Of.Name);
  const std::string_view Text = Of.Value;
  if (!Of.hasValue())
    return Fail(fmt::format("'{}', expected KEY=VALUE", Name));
  if (const ShortKey *S = findShortKey(Name); S && S->Set) {
    const auto Number = numberIn(Name, Text, 1, MaxCores);
    if (!Number)
      return Number.error();
    std::string Wrong = S->Set(C, *Number, KeepsSockets);
    return Wrong.empty() ? Expected<Success>(Success{})
                         : Fail(std::move(Wrong));
  }
  const std::vector<const Key *> Named = keysNamed(Name);
  if (Named.empty())
    return Fail(unknownKey(Name));
  if (Named.size() > 1) {
    std::vector<std::string> Paths;
    Paths.reserve(Named.size());
    for (const Key *K : Named)
      Paths.push_back(K->Path);
    return Fail(fmt::format("'{}' is ambiguous, expected one of {}", Name,
                            fmt::join(Paths, ", ")));
  }
  const Key *const K = Named.front();
  if (K->WordOf) {
    K->WordOf(C.Timing) = Text;
    return Success{};
  }
  if (!K->Names.empty()) {
    const std::optional<uint64_t> Number = valueOf(*K, Text);
    if (!Number)
      return Fail(wrongName(*K, Text));
    K->Set(C, *Number);
    return Success{};
  }
  const auto Value = numberIn(K->Path, Text, K->Low, K->High);
  if (!Value)
    return Value.error();
  if (std::string Wrong = checkRange(*K, *Value); !Wrong.empty())
    return Fail(std::move(Wrong));
  K->Set(C, *Value);
  return Success{};
}

/// What a name sets may not undo what another setting says: those of names come
/// first, in the order of keys(), of which a machine is the first. What makes
/// several keys' values goes by the others, and comes last.
static ptrdiff_t placeOf(std::string_view Name) {
  if (const ShortKey *S = findShortKey(Name); S && S->Set)
    return std::ssize(keys()) + 1 + (S - shortKeys().data());
  const auto Named = keysNamed(std::string(Name));
  return Named.size() == 1 && !Named.front()->Names.empty()
             ? Named.front() - keys().data()
             : std::ssize(keys());
}

Expected<Success> setValues(Config &C, std::string_view List) {
  std::multimap<ptrdiff_t, Setting> ByPlace;
  bool KeepsSockets = false;
  for (const Setting &S : settingsOf(List)) {
    ByPlace.emplace(placeOf(S.Name), S);
    KeepsSockets |= S.Name == "rasterizers" || S.Name == "sockets_per_cluster";
  }
  for (const auto &[Place, S] : ByPlace)
    if (Expected<Success> Ok = setValue(C, S, KeepsSockets); !Ok)
      return Ok;
  return validate(C);
}

static std::string textOf(const Key &K, const Config &C) {
  const auto Value = valueOf(K, C);
  return Value.is_string() ? Value.get<std::string>() : jsonText(Value);
}

std::vector<std::string> idleSettings(const Config &Before, const Config &After,
                                      std::string_view List) {
  std::vector<std::string> Said;
  for (const Setting &S : settingsOf(List)) {
    const auto Named = keysNamed(std::string(S.Name));
    if (Named.size() != 1 || !Named.front()->Get || isOfRun(*Named.front()))
      continue;
    const Key &K = *Named.front();
    const std::string Is = fmt::format("{}={}", K.Path, textOf(K, After));
    if (textOf(K, Before) == textOf(K, After)) {
      Said.push_back(
          fmt::format("{} has no effect: it is the machine's value", Is));
      continue;
    }
    for (const KeyLimit &L : limitsOf(K, Before, After))
      Said.push_back(fmt::format("{} has no effect on cycles{}{}: {} is {}", Is,
                                 L.Of.empty() ? "" : " of ", L.Of, L.By->Path,
                                 textOf(*L.By, After)));
  }
  return Said;
}

} // namespace vorion::isasim
