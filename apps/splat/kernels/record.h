// What is made of a Gaussian before it is blended: a footprint on the picture,
// or what the rays of pixels need of it.
#pragma once

// Gaussians are evaluated along rays (effects/Rays.cpp).
#pragma vorion choice effect USE_RAYS
// Rays meet flat Gaussians (effects/Surfels.cpp).
#pragma vorion choice effect USE_SURFELS

#include "falloff_degree.h"
#include "layout.h"

#if USE_RAYS
typedef splat_ray_gaussian splat_record;
#if USE_SURFELS
#define RECORD_SUMS SURFEL_SUM_WORDS
#else
#define RECORD_SUMS RAY_SUM_WORDS
#endif
#else
typedef splat_gaussian splat_record;
#define RECORD_SUMS SUM_WORDS
#endif

#define RECORD_WORDS (sizeof(splat_record) / 4)
