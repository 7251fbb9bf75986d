// What is made of a Gaussian before it is blended: a footprint on the picture,
// or what the rays of pixels need of it.
#pragma once

// Gaussians are evaluated along rays (effects/Rays.cpp).
#pragma vorion choice effect USE_RAYS

#include "layout.h"

#if USE_RAYS
typedef splat_ray_gaussian splat_record;
#define RECORD_SUMS RAY_SUM_WORDS
#else
typedef splat_gaussian splat_record;
#define RECORD_SUMS SUM_WORDS
#endif

#define RECORD_WORDS (sizeof(splat_record) / 4)
