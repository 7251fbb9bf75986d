/* Tiles for the rasterizer of the core's socket (docs/rasterizer.md), for
   kernels in OpenCL C or C. Addresses are those of the device; all active lanes
   pass the same values. */
#ifndef VORION_RASTER_H
#define VORION_RASTER_H

#include <vorion.h>

/* What the tiles of a picture share: vx_gaussian records at `gaussians`, the
   cut-off of the transmittance, vr_options, bytes of an output row. Also sets
   the mode: index lists in memory, pixels to memory, no z-tiles. */
static inline void vx_raster_setup(uint gaussians, float cutoff, uint options,
                                   uint pitch) {
  union {
    float value;
    uint bits;
  } word = {cutoff};
  vr_mode_set(0);
  vr_ztile_set(0);
  vr_options_set(options);
  vr_cutoff_set(word.bits);
  vr_gaussians_set(gaussians);
  vr_output_pitch_set(pitch);
}

/* Queues the tile of width x height pixels at picture coordinates x, y: the
   `count` records that the depth-sorted list names. `output` is the address of
   the tile's first pixel. Returns at once; vr_wait() gives the status. */
static inline void vx_raster_render(uint list, uint count, uint x, uint y,
                                    uint width, uint height, uint output) {
  vr_list_set(list);
  vr_count_set(count);
  vr_tile_origin_set(x << VR_TILE_ORIGIN_X_SHIFT | y << VR_TILE_ORIGIN_Y_SHIFT);
  vr_tile_shape_set(width << VR_TILE_SHAPE_WIDTH_SHIFT |
                    height << VR_TILE_SHAPE_HEIGHT_SHIFT);
  vr_output_set(output);
  vr_start_set(1);
}

/* For training, after vx_raster_setup: tiles rendered from here on leave each
   pixel's last contributor at `last` + 4 bytes a pixel. The other addresses are
   of a tile's first pixel, as `output` of vx_raster_render. */
static inline void vx_raster_keep_last(uint last) {
  vr_mode_set(1 << VR_MODE_KEEP_LAST_SHIFT);
  vr_last_set(last);
}

/* After vx_raster_setup: a tile rendered from here on leaves at `counts`,
   8-byte aligned, how many Gaussians and fragments it took: two words. */
static inline void vx_raster_keep_counts(uint counts) {
  vr_mode_set(1 << VR_MODE_KEEP_COUNTS_SHIFT);
  vr_last_set(counts);
}

/* After vx_raster_setup, and after vx_raster_keep_last where that is used:
   tiles rendered from here on blend into each pixel only the entries of the
   list before its limit, a word a pixel, from `limit` on as `output` of
   vx_raster_render. `first` is the number that limits give the first entry. */
static inline void vx_raster_limit(uint limit, uint first) {
  vr_mode_set(vr_mode() | 1 << VR_MODE_LIMITED_SHIFT);
  vr_index_set(VR_WORD_LIMIT);
  vr_word_set(limit);
  vr_index_set(VR_WORD_LIMIT_FIRST);
  vr_word_set(first);
}

/* Likewise: into each pixel only the entries from its first on, a word a pixel
   from `from` on. After vx_raster_limit, whose `first` holds here, too. */
static inline void vx_raster_from(uint from) {
  vr_mode_set(vr_mode() | 1 << VR_MODE_FROM_SHIFT);
  vr_index_set(VR_WORD_FROM);
  vr_word_set(from);
}

/* After vx_raster_setup, and after vx_raster_keep_last or vx_raster_keep_counts
   where that is used: the records are vx_ray_gaussian. */
static inline void vx_raster_rays(void) {
  vr_mode_set(vr_mode() | VR_PRIMITIVE_RAY << VR_MODE_PRIMITIVE_SHIFT);
}

/* After vx_raster_setup, for a list that several commands blend, one after the
   other. With `load` tiles from here on begin with the pixels at `output`; with
   `keep` they mark those that are saturated, which the next command needs. */
static inline void vx_raster_sequence(uint load, uint keep) {
  vr_mode_set((vr_mode() & ~(VR_MODE_LOAD_MASK | VR_MODE_KEEP_SATURATED_MASK)) |
              load << VR_MODE_LOAD_SHIFT |
              keep << VR_MODE_KEEP_SATURATED_SHIFT);
}

static inline void vx_raster_backward_of(uint primitive, uint list, uint count,
                                         uint x, uint y, uint width,
                                         uint height, uint output, uint last,
                                         uint upstream, uint options) {
  vr_mode_set(1 << VR_MODE_BACKWARD_SHIFT | primitive
                                                << VR_MODE_PRIMITIVE_SHIFT);
  vr_last_set(last);
  vr_upstream_set(upstream);
  vr_backward_set(options);
  vx_raster_render(list, count, x, y, width, height, output);
}

/* For training: queues the way back through a tile that vx_raster_render has
   left at `output` with its last contributors at `last`; `upstream` has the
   pixels' gradients, `options` is vr_backward. The core has to take what is
   handed over with vr_grad_next() until that is 0. */
static inline void vx_raster_backward(uint list, uint count, uint x, uint y,
                                      uint width, uint height, uint output,
                                      uint last, uint upstream, uint options) {
  vx_raster_backward_of(VR_PRIMITIVE_CONIC, list, count, x, y, width, height,
                        output, last, upstream, options);
}

/* Likewise, where the records are vx_ray_gaussian. */
static inline void vx_raster_rays_backward(uint list, uint count, uint x,
                                           uint y, uint width, uint height,
                                           uint output, uint last,
                                           uint upstream, uint options) {
  vx_raster_backward_of(VR_PRIMITIVE_RAY, list, count, x, y, width, height,
                        output, last, upstream, options);
}

/* After vx_raster_setup with options 0: the records are vx_triangle
   (vorion_triangles.h), and a pixel at `output` a vx_visibility. `depth` is
   VR_WORD_DEPTH, `clear` the depth with which a tile begins. With `fragments`
   a tile writes no pixels, and the core has to take its fragments with
   vr_grad_next() until that is 0. */
static inline void vx_raster_triangles(uint depth, float clear,
                                       uint fragments) {
  union {
    float value;
    uint bits;
  } word = {clear};
  vr_mode_set(VR_PRIMITIVE_TRIANGLE << VR_MODE_PRIMITIVE_SHIFT |
              fragments << VR_MODE_FRAGMENTS_SHIFT);
  vr_index_set(VR_WORD_DEPTH);
  vr_word_set(depth);
  vr_index_set(VR_WORD_DEPTH_CLEAR);
  vr_word_set(word.bits);
}

#endif
