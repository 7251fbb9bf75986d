/// The options of a render that a case must hold under, by their names on
/// `splat render`'s command line.
#pragma once

#include "picture/Options.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vorion::test {

struct Knob {
  std::string Flags; ///< as on the command line
  /// What of the machine it turns; one of each is turned at a time.
  std::string Dimension;
  std::optional<splat::Path> Only; ///< the path that has it
  std::function<void(splat::RenderOptions &)> Turn;
  /// How far the picture of a scene of \p Gaussians may move, in parts of its
  /// largest colour, beyond the bound of the reference, which follows every
  /// option that it has.
  double (*Allowance)(const splat::RenderOptions &, std::size_t Gaussians);
};

const std::vector<Knob> &knobs();

/// Some of the knobs, turned together.
using Setting = std::vector<const Knob *>;

/// "--path raster --ztiles 2".
std::string flagsOf(splat::Path Path, const Setting &S);

/// \p Base on \p Path with \p S turned.
splat::RenderOptions turned(splat::RenderOptions Base, splat::Path Path,
                            const Setting &S);

/// Of the multiplications' operands.
double unitRoundoff(splat::BlendUnit B);

/// The sum of the allowances of \p S under \p O, of a scene of so many
/// Gaussians.
double allowanceOf(const Setting &S, const splat::RenderOptions &O,
                   std::size_t Gaussians);

/// Every knob of \p Path alone, after none.
std::vector<Setting> eachAlone(splat::Path Path);

/// A random combination of knobs of \p Path: each dimension with even odds.
Setting combination(splat::Path Path, uint32_t Seed);

} // namespace vorion::test
