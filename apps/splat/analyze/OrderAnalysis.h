/// How much of a view hangs on the order of its Gaussians (docs/numerics.md,
/// "Popping").
#pragma once

#include "reference/PixelOrder.h"

namespace vorion::splat {

/// One order beside that of a view's own depths of centres.
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

/// Of \p G as \p C sees it, a pinhole: the depths that \p Other gives the
/// centres, and those along the pixels' own rays. In fp64.
OrderAnalysis analyzeOrder(const reference::Gaussians<double> &G,
                           const reference::Camera<double> &C,
                           const reference::Camera<double> &Other,
                           const reference::Options &O);

} // namespace vorion::splat
