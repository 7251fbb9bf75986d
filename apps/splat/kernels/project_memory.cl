// What a group of project.cl keeps in local memory, and which of a scene's words
// it asks for ahead of their use.
#pragma once

// Parameters lie in blocks (layout.h), as drawing has them.
#pragma vorion choice flag SCENE_IN_BLOCKS
// Blocks with a verdict are passed over (effects/CullBlocks.cpp).
#pragma vorion choice effect USE_CULL_BLOCKS
// Pictures far from the axis (effects/Crop.cpp).
#pragma vorion choice effect USE_CROP

#include "layout.h"
#include "record.h"
#include "lens_model.cl"
#include "sh.cl"

// Work-items of a group.
#ifndef LANES
#define LANES 16
#endif

// In blocks, a lane asks for words ahead of their use, each in another line, so
// that the warp asks for all lines: of the next geometry, and, so many a time,
// of its colours (but those of lanes whose Gaussian is behind the camera).
// Never at once: 59 lines fill the L2 slice's places for misses, and whatever
// comes next waits behind them, 80 to 190 cycles for a word of the stack.
// Spread, they save 12 % of this kernel's cycles on box_sh3.
#define SH_AHEAD 3
#ifdef SCENE_IN_BLOCKS
#define ASK_FOR_SH(k)                                                          \
  ((k) * LANES < SH_PLANES ? as_uint(sh[c->lines[1 + (k)][lane]]) : 0u)
#else
#define ASK_FOR_SH(k) 0u
#endif

// What lies behind the view and the lens, if there is one.
#if HAS_LENS
#define BEHIND_LENS(camera)                                                    \
  ((__constant const uint *)((__constant const splat_lens *)((camera) + 1) + 1))
#else
#define BEHIND_LENS(camera) ((__constant const uint *)((camera) + 1))
#endif

#define WHOLE_LINES(count)                                                     \
  (((count) + LINE_WORDS - 1) / LINE_WORDS * LINE_WORDS)
// Rectangles of `count` Gaussians.
#if LENS_CLOSES
#define RECTANGLES(count) (3 * WHOLE_LINES(count))
#else
#define RECTANGLES(count) (count)
#endif

// Local memory of a group. An argument of the kernel, so that the compiler
// reaches all of it from one register. The arguments and what a lane has found
// are here because they are needed once in a Gaussian: the compiler would keep
// them on the stack, from which a word comes back after 11 cycles, and from
// here after 3. As variables, the arguments take 10 and 4 % more of this
// kernel's cycles on prototype-forwarding (guitar and box_sh3), what was found
// 15 and 17.
typedef struct {
  splat_view view;
  __global const float *geometry, *colors;
  __global uint *records, *depths;
  __global uint *rectangles;       // a plane of each word
  uint lines[1 + SH_AHEAD][LANES]; // from a lane's own word to one it asks for
  uint latest;                     // beginning of the last line with a record
  union {
    splat_record records[LANES];
    uint words[LANES * RECORD_WORDS];
  } stage;
  uint unread[LANES]; // written, so that it is known by then
  // That a tile sees; culled, by reason; without one, behind a camera whose
  // near plane is left out.
  uint found[2 + CULL_REASONS][LANES];
  uint pairs[LANES], least_key[LANES], greatest_key[LANES]; // of the first
#if USE_CULL_BLOCKS
  __global const uint *verdicts; // of cull_blocks.cl
  uint later;                    // where the next block begins
#endif
#if HAS_LENS
  splat_lens lens;
#endif
#if USE_ROLLING_SHUTTER
  splat_shutter shutter; // behind the lens
#endif
#if USE_CROP
  splat_crop crop;
#endif
#if LENS_CLOSES
  float reach[LANES]; // extents before pixel_extent, along x
#endif
} workspace;
#if USE_RAYS
_Static_assert(sizeof(workspace) <= RAYS_LOCAL_BYTES,
               "kernels/layout.h has too few");
#elif HAS_LENS || USE_CROP
_Static_assert(sizeof(workspace) <= LENS_LOCAL_BYTES,
               "kernels/layout.h has too few");
#else
_Static_assert(sizeof(workspace) <= PROJECT_LOCAL_BYTES,
               "kernels/layout.h has too few");
#endif
