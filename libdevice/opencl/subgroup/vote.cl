/* Votes and ballots of a subgroup. The first word of a ballot has a bit for
   each lane. */
#include "subgroup/lanes.h"

int _CL_OVERLOADABLE sub_group_all(int predicate) {
  return vx_vote_all(predicate);
}
int _CL_OVERLOADABLE sub_group_any(int predicate) {
  return vx_vote_any(predicate);
}
int _CL_OVERLOADABLE sub_group_non_uniform_all(int predicate) {
  return vx_vote_all(predicate);
}
int _CL_OVERLOADABLE sub_group_non_uniform_any(int predicate) {
  return vx_vote_any(predicate);
}

static uint first_lane(void) {
  const uint mask = active_lanes();
  return highest_lane(mask & -mask);
}

int _CL_OVERLOADABLE sub_group_elect(void) {
  return vx_thread_id() == first_lane();
}

/* Zeros of both signs are equal; a NaN equals nothing. */
#define ALL_EQUAL(TYPE)                                                        \
  int _CL_OVERLOADABLE sub_group_non_uniform_all_equal(TYPE value) {           \
    return vx_vote_all(value == from_lane(value, first_lane()));               \
  }
FOR_NUMBERS(ALL_EQUAL)

#define BROADCAST_FIRST(TYPE)                                                  \
  TYPE _CL_OVERLOADABLE sub_group_broadcast_first(TYPE value) {                \
    return from_lane(value, first_lane());                                     \
  }
FOR_NUMBERS(BROADCAST_FIRST)

uint4 _CL_OVERLOADABLE sub_group_ballot(int predicate) {
  return (uint4)(vx_vote_ballot(predicate), 0, 0, 0);
}

/* The bits of a ballot that stand for work-items of this subgroup. */
static uint counted(uint4 ballot) {
  return ballot.x & lanes_below(get_max_sub_group_size());
}

int _CL_OVERLOADABLE sub_group_inverse_ballot(uint4 ballot) {
  return ballot.x >> vx_thread_id() & 1;
}
int _CL_OVERLOADABLE sub_group_ballot_bit_extract(uint4 ballot, uint index) {
  return counted(ballot) >> index & 1;
}
uint _CL_OVERLOADABLE sub_group_ballot_bit_count(uint4 ballot) {
  return popcount(counted(ballot));
}
uint _CL_OVERLOADABLE sub_group_ballot_inclusive_scan(uint4 ballot) {
  return popcount(counted(ballot) & lanes_below(vx_thread_id() + 1));
}
uint _CL_OVERLOADABLE sub_group_ballot_exclusive_scan(uint4 ballot) {
  return popcount(counted(ballot) & lanes_below(vx_thread_id()));
}
uint _CL_OVERLOADABLE sub_group_ballot_find_lsb(uint4 ballot) {
  const uint mask = counted(ballot);
  return highest_lane(mask & -mask);
}
uint _CL_OVERLOADABLE sub_group_ballot_find_msb(uint4 ballot) {
  return highest_lane(counted(ballot));
}

static uint4 whole_subgroup(uint mask) {
  return (uint4)(mask & lanes_below(get_max_sub_group_size()), 0, 0, 0);
}

uint4 _CL_OVERLOADABLE get_sub_group_eq_mask(void) {
  return whole_subgroup(1u << vx_thread_id());
}
uint4 _CL_OVERLOADABLE get_sub_group_ge_mask(void) {
  return whole_subgroup(~lanes_below(vx_thread_id()));
}
uint4 _CL_OVERLOADABLE get_sub_group_gt_mask(void) {
  return whole_subgroup(~lanes_below(vx_thread_id() + 1));
}
uint4 _CL_OVERLOADABLE get_sub_group_le_mask(void) {
  return whole_subgroup(lanes_below(vx_thread_id() + 1));
}
uint4 _CL_OVERLOADABLE get_sub_group_lt_mask(void) {
  return whole_subgroup(lanes_below(vx_thread_id()));
}
