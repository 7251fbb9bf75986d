// How the density along rays falls with q, the square of the distance in
// standard deviations: exp(-q / 2), or as 3DGRT's exp(-q^2 / 18)
// (docs/primitives.md, "Rays").
#pragma once

// Gaussians of degree 4 (effects/Rays.cpp).
#pragma vorion choice effect USE_DEGREE4

#if USE_DEGREE4
#define POWER_AT(q) (-1.0f / 18.0f * (q) * (q))
// The q at which the density is e^-fall.
#define SQUARE_AT(fall) sqrt(18.0f * (fall))
// The derivative of the exponent by q is this times that of degree 2, -1/2, and
// times q, which the sums over pixels contain.
#define MOMENT_FACTOR (2.0f / 9.0f)
#else
#define POWER_AT(q) (-0.5f * (q))
#define SQUARE_AT(fall) (2.0f * (fall))
#define MOMENT_FACTOR 1.0f
#endif
