/// Dependence of a view on the blend order of its Gaussians (docs/numerics.md,
/// "Popping").
#pragma once

#include "reference/PixelOrder.h"

namespace vorion::splat {

/// Another blend order, compared with that by the depths of centres.
struct OrderChange {
  uint64_t Turned = 0; ///< of \c OrderAnalysis::Pairs
  /// PSNR of the picture in that order, linear with peak 1; infinity if it is
  /// the same.
  double Db = 0;
};

struct OrderAnalysis {
  uint64_t Pairs = 0; ///< of Gaussians that a pixel blends, over all pixels
  OrderChange ByOtherView, AlongRays;
};

/// Analyzes the view \p C, a pinhole, of \p G: the order by depths of centres
/// in the view \p Other, and by depths along the pixels' rays. In fp64.
OrderAnalysis analyzeOrder(const reference::Gaussians<double> &G,
                           const reference::Camera<double> &C,
                           const reference::Camera<double> &Other,
                           const reference::Options &O);

} // namespace vorion::splat
