// Finds the blocks of Gaussians (layout.h) of which a pinhole sees none, by the
// sphere that holds their means and by their largest standard deviation.

// The exponent below which no opacity is visible.
#pragma vorion choice float MIN_POWER
// Support: every pixel with alpha of at least the cut-off.
#pragma vorion choice flag SUPPORT_EXACT
// Support: the box of 3 sigma along each axis.
#pragma vorion choice flag SUPPORT_BOX3
// Support: all tiles that INRIA's square meets.
#pragma vorion choice flag SUPPORT_OFFICIAL16

#include "covariance.cl"
#include "layout.h"
#include "near.h"
#include "tile.h"

// Deviations that a support reaches at most: 3, or where alpha is the least
// that is blended, at an opacity of 1.
#if defined(SUPPORT_EXACT)
#define MOST_DEVIATIONS (sqrt(-2.0f * (MIN_POWER)))
#else
#define MOST_DEVIATIONS 3.0f
#endif

// Pixels that rounding to whole pixels or tiles adds to an extent (support.cl).
#if defined(SUPPORT_OFFICIAL16)
#define MOST_ROUNDING ((float)TILE_SIZE + 2.0f)
#else
#define MOST_ROUNDING 2.0f
#endif

// An allowance for fp32, relative to the sum of what is added.
#define ROUNDING_SHARE 1e-5f

// Along one axis of the picture, an extent is at most
//   d (f/z |(1, ratio)| sigma + sqrt(dilation + 0.6)) + rounding,
// d the deviations and 0.6 > 2 sqrt(0.1), what INRIA's radius adds to twice the
// variance. `along` is x or y of the sphere's centre. Both sides of "the place
// less the extent is beyond the picture" times z are linear in the mean, so
// that they hold for all means of the sphere if they do at its worst point.
static bool is_beside(float along, float z, float radius, float deviation,
                      float focal, float slope, float center, float size) {
  const float deviations = MOST_DEVIATIONS;
  const float added = deviations * sqrt(DILATION + 0.6f) + MOST_ROUNDING;
  const float reach = deviations * fabs(focal) * slope * deviation;
  const float before = center + added;
  const float behind = center - size - added;
  const float place = focal * along;
  const float allowed =
      ROUNDING_SHARE * (fabs(place) + reach +
                        (fabs(before) + fabs(behind)) * (fabs(z) + radius) +
                        fabs(focal) * radius);
  return place + before * z + reach +
                 radius * sqrt(focal * focal + before * before) + allowed <
             0.0f ||
         place + behind * z - reach -
                 radius * sqrt(focal * focal + behind * behind) - allowed >
             0.0f;
}

// `bounds` has planes (layout.h); a verdict is 0 or 1 more than the reason for
// which the block's Gaussians count as culled.
__kernel void cull_blocks(__constant const splat_view *view,
                          __global const float *bounds, __global uint *verdicts,
                          uint blocks) {
  const uint i = get_global_id(0);
  if (i >= blocks)
    return;
  const float3 d =
      from_camera(view, (float3)(bounds[BOUND_CENTER * blocks + i],
                                 bounds[(BOUND_CENTER + 1) * blocks + i],
                                 bounds[(BOUND_CENTER + 2) * blocks + i]));
  const float deviation = bounds[BOUND_DEVIATION * blocks + i];
  const float radius = bounds[BOUND_RADIUS * blocks + i] +
                       ROUNDING_SHARE * (fabs(d.x) + fabs(d.y) + fabs(d.z));
  __constant const float *r = view->rotation;
  const float x = r[0] * d.x + r[1] * d.y + r[2] * d.z;
  const float y = r[3] * d.x + r[4] * d.y + r[5] * d.z;
  const float z = r[6] * d.x + r[7] * d.y + r[8] * d.z;
  const float most_x =
      fmax(fabs(view->ratio_low[0]), fabs(view->ratio_high[0]));
  const float most_y =
      fmax(fabs(view->ratio_low[1]), fabs(view->ratio_high[1]));
#if defined(SUPPORT_EXACT) || defined(SUPPORT_BOX3)
  const float slope_x = sqrt(1.0f + most_x * most_x);
  const float slope_y = sqrt(1.0f + most_y * most_y);
#else
  // A square has the longer axis's extent, whichever way that lies.
  const float ratio = view->focal[1] / view->focal[0];
  const float slope_x =
      sqrt(1.0f + most_x * most_x + ratio * ratio * (1.0f + most_y * most_y));
  const float slope_y = slope_x / fabs(ratio);
#endif
  uint verdict = 0;
  const float nearest = z + radius;
  if (!(KEEP_DEPTH(nearest)))
    verdict = 1 + CULL_NEAR;
  else if (is_beside(x, z, radius, deviation, view->focal[0], slope_x,
                     view->center[0], (float)view->size[0]) ||
           is_beside(y, z, radius, deviation, view->focal[1], slope_y,
                     view->center[1], (float)view->size[1]))
    verdict = 1 + CULL_OUTSIDE;
  // Numbers that are none have no place.
  verdicts[i] = isfinite(nearest) ? verdict : 0;
}
