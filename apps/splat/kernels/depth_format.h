// The depths that a mesh's triangles are tested by.
#pragma once

// They are integers: this over z (--mesh-depth). Without it floats: 1 over z.
#pragma vorion choice optional float DEPTH_SCALE

#ifdef DEPTH_SCALE
#define DEPTH_IS_INTEGER 1
#else
#define DEPTH_SCALE 1.0f
#define DEPTH_IS_INTEGER 0
#endif
