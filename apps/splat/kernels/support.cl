// Which pixels and tiles a Gaussian may reach. One of SUPPORT_EXACT,
// SUPPORT_BOX3, SUPPORT_SQUARE3, SUPPORT_OFFICIAL16 is defined. Extents and
// tiles are those of reference/Projection.h and Tiles.h.
#pragma once

// Support: every pixel with alpha of at least the cut-off.
#pragma vorion choice flag SUPPORT_EXACT
// Support: the box of 3 sigma along each axis.
#pragma vorion choice flag SUPPORT_BOX3
// Support: INRIA's radius as a square.
#pragma vorion choice flag SUPPORT_SQUARE3
// Support: all tiles that INRIA's square meets.
#pragma vorion choice flag SUPPORT_OFFICIAL16
// The least alpha that is blended, in 1/255.
#pragma vorion choice float ALPHA_CUTOFF
// Gaussians too faint for any pixel (effects/Faint.cpp).
#pragma vorion choice effect USE_FAINT

#include "covariance.cl"
#include "tile.h"

// The half sides of the box in pixels; false if nothing can be reached.
static bool support_extent(screen_covariance s, float opacity, uint effects,
                           float2 *extent) {
#if defined(SUPPORT_EXACT)
  // alpha >= 1/255 needs d^2 <= 2 ln(255 o) S_ii along each axis; a higher
  // cut-off likewise.
  const float ratio = 255.0f / ALPHA_CUTOFF * opacity;
  if (USE_FAINT && !(ratio >= 1.0f))
    return false;
  // The maximum goes before the logarithm, whose guards for what is below 0 or
  // no number it makes needless; where that test is absent they would cost more.
  const float deviations = sqrt(2.0f * log(fmax(1.0f, ratio)));
  *extent = (float2)(deviations * sqrt(s.xx), deviations * sqrt(s.yy));
#elif defined(SUPPORT_BOX3)
  *extent = (float2)(3.0f * sqrt(s.xx), 3.0f * sqrt(s.yy));
#elif defined(SUPPORT_SQUARE3) || defined(SUPPORT_OFFICIAL16)
  // INRIA's radius, with mid^2 - det written as a sum of squares: the
  // difference's rounding would move the radius of large round Gaussians.
  const float mid = (s.xx + s.yy) / 2.0f;
  const float half_difference = (s.xx - s.yy) / 2.0f;
  const float spread = half_difference * half_difference + s.xy * s.xy;
  const float radius = ceil(3.0f * sqrt(mid + sqrt(fmax(0.1f, spread))));
  *extent = (float2)(radius, radius);
#endif
  return true;
}

// The extent for the blending kernels' test of each pixel.
static float pixel_extent(float extent) {
#if defined(SUPPORT_EXACT)
  // The alpha test decides; rounding of the box must lose none of its pixels.
  return extent * 1.000001f + 1e-4f;
#elif defined(SUPPORT_OFFICIAL16)
  return INFINITY; // every pixel of the tiles
#else
  return extent;
#endif
}

// The floor of v within [0, most]; NaN gives 0. What is not negative a
// conversion rounds down.
static uint clamped_floor(float v, uint most) {
  return (uint)fmin(fmax(v, 0.0f), (float)most);
}

// Tiles [first, last), `tile` pixels each, along one axis of a picture of so
// many pixels.
static void tile_span(float mean, float extent, float tile, uint size,
                      uint tiles, uint *first, uint *last) {
#if defined(SUPPORT_OFFICIAL16)
  // As the CUDA code counts them, for which pixels sit at whole numbers.
  const float m = mean - 0.5f;
  *first = clamped_floor((m - extent) / tile, tiles);
  *last = clamped_floor((m + extent + (tile - 1.0f)) / tile, tiles);
#else
  // Tiles whose area meets the box. That is half a pixel more than the pixel
  // centres need, so tiles of any size leave the same pixels. The last tile may
  // reach beyond the picture; a box that meets only that is outside.
  if (!(mean - extent < (float)size)) {
    *first = *last = tiles;
    return;
  }
  *first = clamped_floor((mean - extent) / tile, tiles);
  *last = clamped_floor(floor((mean + extent) / tile) + 1.0f, tiles);
#endif
}
