// From tile rectangles to one depth-sorted list a tile. The keys of 3DGS are
// tile << 32 | depth; a least-significant-digit sort reaches the depth digits
// first, so they are sorted before the Gaussians are duplicated (every copy
// has the same depth), and the copies, made in depth order, are sorted stably
// by tile. The lists are those of a sort by the whole key.

// Tiles of each Gaussian, in depth order.
__kernel void count_tiles(__global const uint *order,
                          __global const uint2 *rectangles,
                          __global uint *tile_counts, uint count) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const uint2 r = rectangles[order[i]];
  const uint width = (r.y & 0xffff) - (r.x & 0xffff);
  const uint height = (r.y >> 16) - (r.x >> 16);
  tile_counts[i] = width * height;
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

// What the host must know: Gaussians seen, copies, and how many were culled for
// each reason.
__kernel void totals(__global const uint *sorted_depths,
                     __global const uint *offsets, __global uint *result,
                     uint count) {
  uint first = first_from(sorted_depths, count, CULLED);
  result[0] = first;
  result[1] = offsets[count];
  for (uint reason = 0; reason < CULL_REASONS; ++reason) {
    const uint next = first_from(sorted_depths, count, CULLED + reason + 1);
    result[2 + reason] = next - first;
    first = next;
  }
}

// One (tile, list entry) pair for every tile of every Gaussian, row by row. The
// entry says whether there are several: the rasterizer's memory keeps those.
__kernel void duplicate(__global const uint *order,
                        __global const uint2 *rectangles,
                        __global const uint *offsets,
                        __global uint *pair_tiles,
                        __global uint *pair_gaussians, uint count,
                        uint tiles_x, uint effects) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const uint gaussian = order[i];
  const uint2 r = rectangles[gaussian];
  const uint width = (r.y & 0xffff) - (r.x & 0xffff);
  const uint begin = offsets[i];
  const uint end = offsets[i + 1];
  const uint entry =
      gaussian | (USE_INTERSECT_TAGS && end - begin > 1 ? SPANS_TILES : 0u);
  uint tile = (r.x >> 16) * tiles_x + (r.x & 0xffff);
  uint column = 0;
  for (uint place = begin; place < end; ++place) {
    pair_tiles[place] = tile + column;
    pair_gaussians[place] = entry;
    ++column;
    if (column == width) {
      column = 0;
      tile += tiles_x;
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
