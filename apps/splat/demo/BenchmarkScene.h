/// The benchmark set: scenes whose work for a renderer is that of real ones.
#pragma once

#include "demo/BenchmarkWorld.h"
#include "scene/Scene.h"

namespace vorion::splat::demo {

/// How the Gaussians of a place are spread, made and seen: what
/// bench/benchmark_fit.py fits to real scenes. A "spread" is the standard
/// deviation of a logarithm.
struct BenchmarkShape {
  double Distance;      ///< of the first view's camera, as a factor
  double Second, Third; ///< of the others' cameras
  double Behind;  ///< density of Gaussians on hidden parts; 0: no such parts
  double Nowhere; ///< the same of parts that no view shows
  double Back;    ///< the same of surfaces that face away from the first view
  double Fading;  ///< exponent of the falloff of density away from the subject
  double Clumps;  ///< spread of the number of Gaussians per area
  double Size;    ///< larger deviation, median, in spacings of neighbours
  double SizeSpread;  ///< its spread within a block of cells
  double BlockSize;   ///< its spread between blocks
  double Stretch;     ///< spread of the ratio of the two deviations
  double Large;       ///< share of Gaussians that fill in
  double LargeSize;   ///< by what factor these are larger
  double Depth;       ///< deviation of their places across a surface, spacings
  double Opaque;      ///< share of opacity 0.99
  double BlockOpaque; ///< spread of that between blocks
  double Most;        ///< largest opacity of the others
  double Faint; ///< their opacity: Most times a uniform number to this power
  double BlockFaint; ///< spread of that between blocks

  std::array<double, 3> distances() const { return {Distance, Second, Third}; }
};

/// The fitted one for about so many Gaussians.
const BenchmarkShape &benchmarkShape(BenchmarkKind K, int Gaussians);

/// A scene of exactly \p Gaussians (at least 1000) of degree 3, bit-identical
/// on every host. \p Seed selects the random numbers, below 1000; the scenes of
/// the set have seed 0.
Scene makeBenchmark(BenchmarkKind K, const BenchmarkShape &Shape, int Gaussians,
                    unsigned Seed = 0);

} // namespace vorion::splat::demo
