/// The knobs of `splat accuracy`, and settings of them.
#pragma once

#include "picture/Options.h"
#include "vorion/support/Expected.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// The options that a sweep varies: those of `splat render`, then those of
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
  SubpixelBits,
  MeshDepth,
  FilterBits,
  Reciprocal,
  Sum
};

/// An option that trades accuracy for time or area.
struct Knob {
  KnobId Id;
  std::string Name;                ///< the option without dashes
  std::vector<std::string> Values; ///< the default first
  std::string CoresName; ///< the option of the path `simt`; empty: none
  /// Whether the time and area of a unit that has this value are modelled.
  /// Otherwise cycles are those of kernels that compute its result.
  bool HasCost = true;
};

/// The knobs of `splat render`.
const std::vector<Knob> &allKnobs();

/// The knobs of `splat train` and `splat gradients`.
const std::vector<Knob> &trainKnobs();

/// The knob \p Id of either list.
const Knob &knob(KnobId Id);

/// The names of allKnobs().
std::vector<std::string> knobNames();

/// The knobs \p Names, in the order of allKnobs(), for pictures with \p
/// Surface, which may be null, \p Parallel if a camera is orthographic; for an
/// empty list all that apply to these. Error: a knob is unknown or does not
/// apply.
Expected<std::vector<Knob>> knobsNamed(const std::vector<std::string> &Names,
                                       const Mesh *Surface = nullptr,
                                       bool Parallel = false);

/// A knob with a value other than its default.
struct Choice {
  KnobId Id;
  std::size_t Value; ///< index of the knob's values

  bool operator==(const Choice &) const = default;
};

/// Values of some knobs, in the order of knobs; the others have their defaults.
class Setting {
public:
  Setting() = default;
  /// Adds value \p Value of \p K, which must follow the existing knobs.
  Setting with(const Knob &K, std::size_t Value) const;

  /// "default", or "exp=poly3,tile=32".
  std::string name() const;
  /// Parses a name, with knobs of allKnobs().
  static Expected<Setting> parse(const std::string &Name);

  /// Number of knobs that differ from their default.
  std::size_t size() const { return Choices.size(); }
  /// The value of \p Id, as index of the knob's values (0 for the default) and
  /// as text of the option.
  std::size_t place(KnobId Id) const;
  const std::string &value(KnobId Id) const {
    return knob(Id).Values[place(Id)];
  }
  ExpUnit exponential() const;
  BlendUnit arithmetic() const;
  Support support() const;
  /// Whether all its knobs have a modelled cost.
  bool hasCost() const;

  /// For `splat render --path raster`.
  std::vector<std::string> arguments() const;
  /// For `splat render --path simt`; empty if the cores do not support a
  /// choice.
  std::optional<std::vector<std::string>> coresArguments() const;

  bool operator==(const Setting &) const = default;

private:
  std::vector<Choice> Choices;
};

/// The default, then all single changes.
std::vector<Setting> singleChanges(const std::vector<Knob> &Knobs);

} // namespace vorion::splat
