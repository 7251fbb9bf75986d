// What every blending kernel of the cores has: the density's exponential, and
// which alphas and transmittances count.
#pragma once

// gsplat: a pixel is done at a transmittance of the cut-off, not only below it.
#pragma vorion choice flag STOP_AT_EQUAL
// The least alpha that is blended, in 1/255.
#pragma vorion choice float ALPHA_CUTOFF
// The exponent below which no opacity is visible.
#pragma vorion choice float MIN_POWER
// Opacities above 0.99 (effects/AlphaClamp.cpp).
#pragma vorion choice effect USE_ALPHA_CLAMP

#ifdef EXP_DEGREE
#include "units.cl"
#else
#include "falloff.cl"
#endif

// True if a pixel with this transmittance takes no more.
#ifdef STOP_AT_EQUAL
#define SATURATED(t) ((t) <= cutoff)
#else
#define SATURATED(t) ((t) < cutoff)
#endif

// Below MIN_POWER alpha is under the cut-off whatever the opacity.
#define IS_VISIBLE_POWER(power) ((power) >= MIN_POWER)

static float clamped_alpha(float alpha, uint effects) {
  return USE_ALPHA_CLAMP ? fmin(0.99f, alpha) : alpha;
}
