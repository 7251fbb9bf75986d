// From tile rectangles to one depth-sorted list a tile. The keys of 3DGS are
// tile << 32 | depth; a least-significant-digit sort reaches the depth digits
// first, so they are sorted before the Gaussians are duplicated (every copy
// has the same depth), and the copies, made in depth order, are sorted stably
// by tile. The lists are those of a sort by the whole key.

// Training: the places of each Gaussian's pairs are kept.
#pragma vorion choice flag KEEP_PLACES
// Gaussians of several tiles are marked (effects/IntersectTags.cpp).
#pragma vorion choice effect USE_INTERSECT_TAGS

#include "layout.h"
#include "rectangle.cl"

// Loads in flight of each work-item.
#define BATCH 4

// What rectangles become in the order of depths: a plane of first tiles, and
// one of sizes, width | height << 16.
static uint size_tiles(uint size) { return (size & 0xffff) * (size >> 16); }

// Puts rectangle `from` of `rectangles`, whose first word is `word`, to place
// `to`, and gives its tiles.
static uint put(__global const uint *rectangles, uint stride, uint from,
                uint word, __global uint *ordered, uint count, uint to,
                uint tiles_x) {
  const uint2 r = (uint2)(word, 0);
  const uint x0 = first_column(r), y0 = first_row(r);
  uint size = ((word >> 24 & 0xf) + 1) | ((word >> 28) + 1) << 16;
  if (word >> 24 == LONG_RECTANGLE)
    size = rectangles[stride + from] - (x0 | y0 << 16);
  ordered[to] = y0 * tiles_x + x0;
  ordered[count + to] = size;
  return size_tiles(size);
}

// Each group has a stretch of `chunk` Gaussians of the depth order. Brings
// their rectangles, of which there are `stride`, into that order, and adds up
// each work-item's tiles.
__kernel void count_tiles(__global const uint *order,
                          __global const uint *rectangles, uint stride,
                          __global uint *ordered, __global uint *sums,
                          uint count, uint chunk, uint tiles_x) {
  const uint begin = min((uint)get_group_id(0) * chunk, count);
  const uint end = min(begin + chunk, count);
  const uint lanes = get_local_size(0);
  uint sum = 0;
  const uint lane = get_local_id(0);
  uint line = begin;
  for (; line + BATCH * lanes <= end; line += BATCH * lanes) {
    const uint i = line + lane;
    uint word[BATCH];
    uint o[BATCH];
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      o[k] = order[i + k * lanes];
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      word[k] = rectangles[o[k]];
#pragma unroll
    for (uint k = 0; k < BATCH; ++k)
      sum += put(rectangles, stride, o[k], word[k], ordered, count,
                 i + k * lanes, tiles_x);
  }
  for (uint i = line + lane; i < end; i += lanes)
    sum += put(rectangles, stride, order[i], rectangles[order[i]], ordered,
               count, i, tiles_x);
  sums[get_global_id(0)] = sum;
}

#define MOST_LANES 16

// The sum of `own` over the lanes before, and of all lanes in `all`. The first
// MOST_LANES words of `sums` are 0, so that no lane has to ask whether there
// are so many before it. Needs lanes to be a power of two.
static uint sum_before(__local uint *sums, uint own, uint *all) {
  const uint lane = get_local_id(0);
  const uint lanes = get_local_size(0);
  uint sum = own;
#pragma unroll
  for (uint distance = 1; distance < MOST_LANES; distance *= 2) {
    barrier(CLK_LOCAL_MEM_FENCE);
    sums[MOST_LANES + lane] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    sum += sums[MOST_LANES + lane - distance];
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  sums[MOST_LANES + lane] = sum;
  barrier(CLK_LOCAL_MEM_FENCE);
  *all = sums[MOST_LANES + lanes - 1];
  return sum - own;
}

// One (tile, list entry) pair for every tile of every Gaussian, row by row, in
// depth order; stretches as in count_tiles. The entry says whether there are
// several tiles: the rasterizer's memory keeps those. With KEEP_PLACES,
// `places` says where each Gaussian's pairs begin, and behind the last one how
// many there are.
__kernel void duplicate(__global const uint *order,
                        __global const uint *ordered, __global const uint *sums,
                        __global uint *pair_tiles,
                        __global uint *pair_gaussians, __global uint *places,
                        uint count, uint chunk, uint tiles_x, uint effects) {
  __local uint lane_sums[2 * MOST_LANES];
  const uint lane = get_local_id(0);
  const uint lanes = get_local_size(0);
  const uint begin = min((uint)get_group_id(0) * chunk, count);
  const uint end = min(begin + chunk, count);
  for (uint k = lane; k < MOST_LANES; k += lanes)
    lane_sums[k] = 0;
  // Pairs of the groups before.
  uint share = 0;
  for (uint i = lane; i < get_group_id(0) * lanes; i += lanes)
    share += sums[i];
  uint next;
  sum_before(lane_sums, share, &next);
  for (uint first = begin; first < end; first += lanes) {
    const uint i = first + lane;
    uint tile = i < end ? ordered[i] : 0u;
    const uint size = i < end ? ordered[count + i] : 0u;
    const uint own = size_tiles(size);
    const uint entry = (i < end ? order[i] : 0u) |
                       (USE_INTERSECT_TAGS && own > 1 ? SPANS_TILES : 0u);
    uint all;
    uint place = next + sum_before(lane_sums, own, &all);
    next += all;
#ifdef KEEP_PLACES
    if (i < end)
      places[i] = place;
    if (i + 1 == count)
      places[count] = next;
#endif
    const uint width = size & 0xffff;
    uint column = 0;
    for (const uint last = place + own; place < last; ++place) {
      pair_tiles[place] = tile + column;
      pair_gaussians[place] = entry;
      ++column;
      if (column == width) {
        column = 0;
        tile += tiles_x;
      }
    }
  }
}

// 0, 1, 2, ...
__kernel void number(__global uint *values, uint count) {
  const uint i = get_global_id(0);
  if (i < count)
    values[i] = i;
}

__kernel void look_up(__global const uint *places, __global const uint *values,
                      __global uint *found, uint count) {
  const uint i = get_global_id(0);
  if (i < count)
    found[i] = values[places[i]];
}

// The first of the sorted keys that is not below `key`.
static uint first_from(__global const uint *keys, uint count, uint key) {
  uint low = 0, high = count;
  while (low < high) {
    const uint middle = (low + high) / 2;
    if (keys[middle] < key)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

// Where each tile's list begins and ends in the sorted pairs.
__kernel void tile_ranges(__global const uint *pair_tiles,
                          __global uint2 *ranges, uint pairs, uint tiles) {
  const uint tile = get_global_id(0);
  if (tile >= tiles)
    return;
  ranges[tile] = (uint2)(first_from(pair_tiles, pairs, tile),
                         first_from(pair_tiles, pairs, tile + 1));
}

// Tiles by falling length of their lists, equal ones by number: the order in
// which the rasterizers get them. There are few tiles, so each is compared with
// all.
__kernel void order_tiles(__global const uint2 *ranges, __global uint *order,
                          uint tiles) {
  const uint tile = get_global_id(0);
  if (tile >= tiles)
    return;
  const uint length = ranges[tile].y - ranges[tile].x;
  uint rank = 0;
  for (uint other = 0; other < tiles; ++other) {
    const uint theirs = ranges[other].y - ranges[other].x;
    rank += theirs > length || (theirs == length && other < tile) ? 1 : 0;
  }
  order[rank] = tile;
}
