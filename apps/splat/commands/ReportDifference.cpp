#include "commands/ReportDifference.h"

#include "effects/Effect.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t MostNamed = 20;

/// No part of a result, wherever it stands.
bool isSkipped(std::string_view Key) {
  constexpr std::array<std::string_view, 3> Keys{"program", "seconds",
                                                 "picture"};
  return std::ranges::find(Keys, Key) != Keys.end();
}

/// Whether \p J is of an effect that only watched: VORION_STATS and others,
/// which a replay does without.
bool isObservation(const Json &J) {
  const auto Kind = J.find("kind");
  return Kind != J.end() && *Kind == name(EffectKind::Observation) &&
         J.contains("needed");
}

std::string textOf(const Json *J) {
  constexpr std::size_t Most = 60;
  return J ? printable(jsonText(*J), Most) : "missing";
}

class Comparison {
public:
  ReportDifference Found;

  /// Of the values at \p Path; nullptr is one that is missing.
  void compare(const std::string &Path, const Json *Was, const Json *Is) {
    if (Was && Is && Was->is_object() && Is->is_object()) {
      compareObjects(Path, *Was, *Is);
    } else if (Was && Is && Was->is_array() && Is->is_array()) {
      for (std::size_t I = 0; I < std::max(Was->size(), Is->size()); ++I)
        compare(fmt::format("{}[{}]", Path, I),
                I < Was->size() ? &(*Was)[I] : nullptr,
                I < Is->size() ? &(*Is)[I] : nullptr);
    } else {
      ++Found.Compared;
      if (Was && Is && *Was == *Is)
        return;
      if (++Found.Differing <= MostNamed)
        Found.First.push_back({Path, textOf(Is), textOf(Was)});
    }
  }

private:
  void compareObjects(const std::string &Path, const Json &Was,
                      const Json &Is) {
    if (isObservation(Was) && isObservation(Is))
      return;
    const auto Compare = [&](const std::string &Key, const Json *A,
                             const Json *B) {
      // "programs" of a render are kernels: only the head's is skipped.
      if (!isSkipped(Key))
        compare(Path.empty() ? Key : Path + "." + Key, A, B);
    };
    for (const auto &[Key, Value] : Was.items())
      Compare(Key, &Value, Is.contains(Key) ? &Is[Key] : nullptr);
    for (const auto &[Key, Value] : Is.items())
      if (!Was.contains(Key))
        Compare(Key, nullptr, &Value);
  }
};

} // namespace

ReportDifference differenceOf(const Json &Was, const Json &Is) {
  Comparison C;
  C.compare("", &Was, &Is);
  return C.Found;
}

} // namespace vorion::splat
