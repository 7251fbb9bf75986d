/* What the functions of subgroups share. A subgroup is a warp: the work-items
   of one pass over the group (docs/adr/0006-work-item-loops.md), each on a
   lane. The work-item with linear id i is on lane i modulo the number of lanes.

   Everything is made from the active lanes, so that a function may be called
   where only some of them are. */
#ifndef VORION_SUBGROUP_LANES_H
#define VORION_SUBGROUP_LANES_H

#include <vorion.h>

/* Stands for a lane that there is not. A shuffle from it, as from an inactive
   lane, gives the lane's own value. */
#define NO_LANE 63u

/* The types that subgroups exchange. M(type) */
#define FOR_INTEGERS(M)                                                        \
  M(char) M(uchar) M(short) M(ushort) M(int) M(uint) M(long) M(ulong)
#define FOR_FLOATS(M) __IF_FP16(M(half)) M(float) __IF_FP64(M(double))
#define FOR_NUMBERS(M) FOR_INTEGERS(M) FOR_FLOATS(M)

/* The active lanes, a bit each. */
static inline uint active_lanes(void) { return vx_vote_ballot(1); }

/* The highest lane of a mask that is not 0. A mask has at most 16 bits, which a
   float holds exactly; there is no instruction that counts zeros. */
static inline uint highest_lane(uint mask) {
  return (as_uint((float)mask) >> 23) - 127;
}

/* The lanes below lane. */
static inline uint lanes_below(uint lane) { return (1u << lane) - 1; }

/* The active lane before this one among those of mask. */
static inline uint lane_before(uint mask) {
  const uint before = mask & lanes_below(vx_thread_id());
  return before ? highest_lane(before) : NO_LANE;
}

/* The value of another lane. */
static inline uint _CL_OVERLOADABLE from_lane(uint value, uint lane) {
  const uint last = NO_LANE << 6;
  return vx_shfl_idx(value, last | (lane & NO_LANE));
}
static inline ulong _CL_OVERLOADABLE from_lane(ulong value, uint lane) {
  return upsample(from_lane((uint)(value >> 32), lane),
                  from_lane((uint)value, lane));
}
#define AS_WORD(TYPE, WORD, TO, FROM)                                          \
  static inline TYPE _CL_OVERLOADABLE from_lane(TYPE value, uint lane) {       \
    return FROM(from_lane((WORD)TO(value), lane));                             \
  }
AS_WORD(char, uint, (uchar), (char))
AS_WORD(uchar, uint, , (uchar))
AS_WORD(short, uint, (ushort), (short))
AS_WORD(ushort, uint, , (ushort))
AS_WORD(int, uint, , as_int)
AS_WORD(float, uint, as_uint, as_float)
AS_WORD(long, ulong, , as_long)
#ifdef cl_khr_fp16
static inline half _CL_OVERLOADABLE from_lane(half value, uint lane) {
  return as_half(from_lane(as_ushort(value), lane));
}
#endif
__IF_FP64(AS_WORD(double, ulong, as_ulong, as_double))
#undef AS_WORD

#endif
