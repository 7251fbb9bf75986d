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

/* For training: queues the way back through a tile that vx_raster_render has
   left at `output` with its last contributors at `last`; `upstream` has the
   pixels' gradients, `options` is vr_backward. The core has to take what is
   handed over with vr_grad_next() until that is 0. */
static inline void vx_raster_backward(uint list, uint count, uint x, uint y,
                                      uint width, uint height, uint output,
                                      uint last, uint upstream, uint options) {
  vr_mode_set(1 << VR_MODE_BACKWARD_SHIFT);
  vr_last_set(last);
  vr_upstream_set(upstream);
  vr_backward_set(options);
  vx_raster_render(list, count, x, y, width, height, output);
}

#endif
