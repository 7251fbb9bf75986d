/// What `splat accuracy` may choose, and what was chosen.
#pragma once

#include "vorion/support/Expected.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vorion::splat {

/// An option of `splat render` that buys accuracy with time or area.
struct Knob {
  std::string Name;                ///< the option without its dashes
  std::vector<std::string> Values; ///< the default first
  std::string CoresName; ///< the cores' path's option; empty: it has none
};

/// All of them.
const std::vector<Knob> &allKnobs();

/// Options of `splat train` and `splat gradients` likewise.
const std::vector<Knob> &trainKnobs();

/// Those of \p Names, in the order of allKnobs(); all for an empty list.
Expected<std::vector<Knob>> knobsNamed(const std::vector<std::string> &Names);

/// Values of some knobs, in the order of allKnobs(); the other knobs have their
/// defaults. No knob is listed with its default.
class Setting {
public:
  Setting() = default;
  /// \p Value of \p K added; \p K comes after those that are there.
  Setting with(const Knob &K, const std::string &Value) const;

  /// "default", or "exp=poly3,tile=32".
  std::string name() const;
  /// Reads a name, with knobs of allKnobs().
  static Expected<Setting> parse(const std::string &Name);

  std::size_t size() const { return Choices.size(); }
  /// The chosen value of knob \p Name, or its default.
  std::string value(const std::string &Name) const;
  /// For `splat render --path raster`.
  std::vector<std::string> arguments() const;
  /// For `splat render --path simt`, or nothing if the cores lack a choice.
  std::optional<std::vector<std::string>> coresArguments() const;

  bool operator==(const Setting &) const = default;
  auto operator<=>(const Setting &) const = default;

private:
  std::vector<std::pair<std::string, std::string>> Choices;
};

/// The default, then each other value of each knob alone.
std::vector<Setting> oneAtATime(const std::vector<Knob> &Knobs);

} // namespace vorion::splat
