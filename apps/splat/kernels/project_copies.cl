// The picture closes: what leaves it on one side comes back on the other. So a
// Gaussian stands there once more on either side, a picture's width away, where
// it reaches in. `x` is its own place.
#pragma once

// Gaussians of several tiles are marked (effects/IntersectTags.cpp).
#pragma vorion choice effect USE_INTERSECT_TAGS

#include "layout.h"
#include "project_memory.cl"
#include "rectangle.cl"
#include "support.cl"

static uint project_again(__local const workspace *c, float x, uint key,
                          uint number, uint lane, uint effects,
                          __local splat_gaussian *g, uint2 *rectangle) {
  uint x0, x1;
  const uint y0 = first_row(*rectangle), y1 = (*rectangle).y >> 16;
  tile_span(x, c->reach[lane], TILE_SIZE, c->view.size[0], c->view.tiles[0],
            &x0, &x1);
  if (x0 >= x1)
    return CULLED + CULL_OUTSIDE;
  g->mean[0] = x;
  g->tag = USE_INTERSECT_TAGS && (x1 - x0 > 1 || y1 - y0 > 1)
               ? number | SPANS_TILES
               : number;
  *rectangle = make_rectangle(x0, y0, x1, y1);
  return key;
}
