// Of Gaussian i: a plane of its geometry, and coefficient k, of those that are
// there, of channel c, which is in plane 3 k + c. In blocks (layout.h)
// `geometry` and `sh` are where its words of the first planes are.
#pragma once

// Parameters lie in blocks (layout.h), as drawing has them.
#pragma vorion choice flag SCENE_IN_BLOCKS

#include "layout.h"

#ifdef SCENE_IN_BLOCKS
#define GEOMETRY(plane) geometry[(plane) * LINE_WORDS]
#define SH(k, c) sh[(3 * (k) + (c)) * LINE_WORDS]
#else
#define GEOMETRY(plane) geometry[(plane) * count + i]
#define SH(k, c) sh[(3 * (k) + (c)) * count + i]
#endif
