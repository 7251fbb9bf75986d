// Who draws what, by what tiles were to the rasterizers in the last frame:
// those of the most work first, to the rasterizers that have the least. Tiles
// without a Gaussian are dealt in turn behind the others. So each rasterizer
// writes its share of them when it comes to an end, and they do not take the
// memory from those that still blend (docs/ideas.md, "Dealing by the last
// frame").
#pragma once

#include <vorion.h>

// A warp ranks and deals.
#define DEAL_LANES 16

// Tiles that are compared with one after the other.
#define RANK_BATCH 256
#define RANK_UNROLL 8

// Control words of shuffles among all lanes.
#define SHUFFLE_ALL ((DEAL_LANES - 1) << 6)

// Far beyond what a tile takes. Where sums of it wrap, the deal is worse, and no
// picture is another.
#define MOST_WORK 0x1p26f

static uint length_of(uint2 range) { return range.y - range.x; }

// Of a tile, about the cycles of its rasterizer: 16 lanes take 16 fragments a
// cycle, if no two of them meet in a bank, which costs a fourth more; and eight
// cycles a Gaussian are waited for. A list that has grown or shrunk since the
// last frame takes more or less of both. A tile that was empty, or is in the
// first frame, has its list for this.
static uint work_of(uint2 range, uint2 last_range, uint2 counts) {
  const uint length = length_of(range);
  const uint before = length_of(last_range);
  const uint then = 8 * counts.x + counts.y / 16 + counts.y / 64;
  const float work = counts.x != 0 ? (float)then * (float)length / (float)before
                                   : 8.0f * (float)length;
  return length != 0 ? max((uint)fmin(work, MOST_WORK), 1u) : 0;
}

// Tiles with their work, by falling work, equal ones by number: ranked[rank] =
// (work, tile). There are few tiles, so each is compared with all, a batch of
// them at a time; those behind the last have no work, and come before none.
__kernel __attribute__((reqd_work_group_size(DEAL_LANES, 1, 1))) void
rank_tiles(__global const uint2 *ranges, __global const uint2 *last_ranges,
           __global const uint2 *counts, __global uint2 *ranked, uint tiles) {
  __local uint works[RANK_BATCH];
  const uint lane = get_local_id(0);
  const uint tile = get_global_id(0);
  const uint own = min(tile, tiles - 1);
  const uint work = work_of(ranges[own], last_ranges[own], counts[own]);
  uint rank = 0;
  for (uint first = 0; first < tiles; first += RANK_BATCH) {
    const uint batch = min((uint)RANK_BATCH, tiles - first);
    for (uint k = lane; k < batch + RANK_UNROLL; k += DEAL_LANES)
      if (k < RANK_BATCH)
        works[k] = k < batch
                       ? work_of(ranges[first + k], last_ranges[first + k],
                                 counts[first + k])
                       : 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint group = 0; group < batch; group += RANK_UNROLL)
#pragma unroll
      for (uint k = group; k < group + RANK_UNROLL; ++k)
        rank += works[k] + (first + k < tile ? 1 : 0) > work ? 1 : 0;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (tile < tiles)
    ranked[rank] = (uint2)(work, tile);
}

// Those that get tiles: each has a lane of a warp. What a machine has beyond
// them gets nothing.
static uint dealt_to(void) {
  return min(vx_num_sockets(), min(vx_num_threads(), (uint)DEAL_LANES));
}

// The place of row `row` of a rasterizer's tiles, which are behind their
// number.
static uint place_of(uint rasterizer, uint row, uint tiles) {
  return rasterizer * (tiles + 1) + 1 + row;
}

// One group, to whose lanes the rasterizers belong. Tiles with work go out in
// hands, one to each rasterizer of the less busy half. Those busiest pass, so
// that a tile as long as many others together is its rasterizer's only one.
__kernel __attribute__((reqd_work_group_size(DEAL_LANES, 1, 1))) void
deal_tiles(__global const uint2 *ranked, __global uint *dealt, uint tiles) {
  const uint lane = get_local_id(0);
  const uint rasterizers = dealt_to();
  const uint hand = (rasterizers + 1) / 2;
  uint rows = 0; // of the lane's rasterizer
  // Work * DEAL_LANES + rasterizer, no two of which are equal; the largest word
  // where there is no rasterizer.
  uint busy = lane < rasterizers ? lane : ~0u;
  uint full = 0; // tiles that have work
  for (uint first = 0; first < tiles; first += hand) {
    uint less_busy = 0; // than the lane's, how many
#pragma unroll 4
    for (uint k = 0; k < rasterizers; ++k)
      less_busy += vx_shfl_idx(busy, SHUFFLE_ALL | k) < busy ? 1 : 0;
    const uint rank = first + less_busy;
    uint2 tile = (uint2)(0, 0);
    if (lane < rasterizers && less_busy < hand && rank < tiles)
      tile = ranked[rank];
    if (tile.x != 0) {
      dealt[place_of(lane, rows, tiles)] = tile.y;
      ++rows;
      busy += tile.x * DEAL_LANES;
    }
    const uint taken = popcount(vx_vote_ballot(tile.x != 0));
    full += taken;
    if (taken != hand)
      break;
  }
  if (lane < rasterizers) {
    for (uint rank = full + lane; rank < tiles; rank += rasterizers) {
      dealt[place_of(lane, rows, tiles)] = ranked[rank].y;
      ++rows;
    }
    dealt[lane * (tiles + 1)] = rows;
  }
}

typedef struct {
  uint job; // its place in what deal_tiles has left
  uint end; // of the rasterizer's
} deal;

// This core's jobs: the cores of a socket take its rasterizer's tiles in turn.
static deal first_job(__global const uint *dealt, uint tiles) {
  const uint cores = vx_num_cores() / vx_num_sockets();
  const uint own = vx_core_id() / cores;
  deal d = {0, 0};
  if (own < dealt_to()) {
    d.job = place_of(own, vx_core_id() % cores, tiles);
    d.end = place_of(own, dealt[own * (tiles + 1)], tiles);
  }
  return d;
}

static deal next_job(deal d) {
  d.job += vx_num_cores() / vx_num_sockets();
  return d;
}
