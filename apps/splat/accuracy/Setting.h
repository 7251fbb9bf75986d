/// What `splat accuracy` may choose, and what was chosen.
#pragma once

#include "picture/Options.h"
#include "vorion/support/Expected.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// The options that a sweep tries: those of `splat render`, then those of
/// `splat train` and `splat gradients`.
enum class KnobId {
  Exp,
  Blend,
  AlphaCutoff,
  Cutoff,
  Tile,
  Support,
  ShDegree,
  DepthBits,
  ZTiles,
  PixelUnit,
  SkipSaturated,
  Reciprocal,
  Sum
};

/// An option that buys accuracy with time or area.
struct Knob {
  KnobId Id;
  std::string Name;                ///< the option without its dashes
  std::vector<std::string> Values; ///< the default first
  std::string CoresName; ///< the cores' path's option; empty: it has none
};

/// All of `splat render`.
const std::vector<Knob> &allKnobs();

/// Those of `splat train` and `splat gradients` likewise.
const std::vector<Knob> &trainKnobs();

/// The one of either list.
const Knob &knob(KnobId Id);

/// Of allKnobs().
std::vector<std::string> knobNames();

/// Those of \p Names, in the order of allKnobs(); all for an empty list.
Expected<std::vector<Knob>> knobsNamed(const std::vector<std::string> &Names);

/// A knob at another value than its default.
struct Choice {
  KnobId Id;
  std::size_t Value; ///< place among the knob's values

  bool operator==(const Choice &) const = default;
};

/// Values of some knobs, in the order of the knobs; the others have their
/// defaults.
class Setting {
public:
  Setting() = default;
  /// Value \p Value of \p K added; \p K comes after those that are there.
  Setting with(const Knob &K, std::size_t Value) const;

  /// "default", or "exp=poly3,tile=32".
  std::string name() const;
  /// Reads a name, with knobs of allKnobs().
  static Expected<Setting> parse(const std::string &Name);

  /// Knobs that do not have their default.
  std::size_t size() const { return Choices.size(); }
  /// The chosen value of \p Id as its place among the knob's values, 0 for the
  /// default; and as the option has it.
  std::size_t place(KnobId Id) const;
  const std::string &value(KnobId Id) const {
    return knob(Id).Values[place(Id)];
  }
  ExpUnit exponential() const;
  BlendUnit arithmetic() const;
  Support support() const;

  /// For `splat render --path raster`.
  std::vector<std::string> arguments() const;
  /// For `splat render --path simt`, or nothing if the cores lack a choice.
  std::optional<std::vector<std::string>> coresArguments() const;

  bool operator==(const Setting &) const = default;

private:
  std::vector<Choice> Choices;
};

/// The default, then each other value of each knob alone.
std::vector<Setting> singleChanges(const std::vector<Knob> &Knobs);

} // namespace vorion::splat
