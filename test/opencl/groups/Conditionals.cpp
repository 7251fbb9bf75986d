/// Barriers within conditionals, which a whole group takes one way or the
/// other.

#include "Kernels.h"

namespace vorion::test {

namespace {

const char *const Conditional = R"(
// The whole group goes one way or the other, group by group.
kernel void conditional(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, r;
  t[l] = l * 5;
  if (get_group_id(0) & 1) {
    barrier(CLK_LOCAL_MEM_FENCE);
    r = t[n - 1 - l];
    if (l & 1)
      r += 100;
  } else {
    r = -l;
    barrier(CLK_LOCAL_MEM_FENCE);
    r += t[(l + 2) % n];
    barrier(CLK_LOCAL_MEM_FENCE);
    t[l] = r;
    barrier(CLK_LOCAL_MEM_FENCE);
    r += t[(l + 1) % n];
  }
  out[get_group_id(0) * n + l] = r;
}
)";

Values conditional(U N, U Group) {
  Values R(N), Out(N);
  for (U L = 0; L < N; ++L)
    R[L] =
        Group & 1 ? (N - 1 - L) * 5 + (L & 1 ? 100 : 0) : (L + 2) % N * 5 - L;
  for (U L = 0; L < N; ++L)
    Out[L] = Group & 1 ? R[L] : R[L] + R[(L + 1) % N];
  return Out;
}

const char *const BranchAfterBarrier = R"(
// After the last barrier of a conditional, work-items part and meet only where the
// conditional ends.
kernel void branch_after_barrier(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, r = l * 6;
  if (k & 1) {
    t[l] = r;
    barrier(CLK_LOCAL_MEM_FENCE);
    r = t[(l + 4) % n];
    barrier(CLK_LOCAL_MEM_FENCE);
    if (l & 1) {
      if (r % (l | 1) & 1)
        r = 45 | l;
      for (uint i = 0; i < l % 5; i++)
        r = r * 3 + 1;
    }
  }
  out[get_group_id(0) * n + l] = r;
}
)";

Values branchAfterBarrier(U N, U) {
  static_assert(Rounds & 1);
  Values R(N);
  for (U L = 0; L < N; ++L) {
    R[L] = (L + 4) % N * 6;
    if (!(L & 1))
      continue;
    if (R[L] % (L | 1) & 1)
      R[L] = 45 | L;
    for (U I = 0; I < L % 5; ++I)
      R[L] = R[L] * 3 + 1;
  }
  return R;
}

const char *const MergedTails = R"(
// LLVM makes one store of the two at the ends of the conditionals. Some work-items
// of a group pass it on the way to the next barrier, others go around it.
kernel void merged_tails(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, z = get_group_id(0), a[4] = {1, l, n, 4};
  if (z & 2) {
    t[l] = l * 3;
    barrier(CLK_LOCAL_MEM_FENCE);
    z ^= t[(l + 1) % n];
    barrier(CLK_LOCAL_MEM_FENCE);
    if (l & 1)
      a[z & 3] = l + 9;
  } else {
    if (k & 1)
      a[n & 3] = z;
  }
  t[l] = a[1];
  barrier(CLK_LOCAL_MEM_FENCE);
  out[get_group_id(0) * n + l] = z + a[l & 3] * 5 + t[(l + 1) % n];
}
)";

Values mergedTails(U N, U Group) {
  static_assert(Rounds & 1);
  Values Z(N, Group), Own(N), T(N), Out(N);
  for (U L = 0; L < N; ++L) {
    U A[4] = {1, L, N, 4};
    if (Group & 2) {
      Z[L] ^= (L + 1) % N * 3;
      if (L & 1)
        A[Z[L] & 3] = L + 9;
    } else {
      A[N & 3] = Group;
    }
    T[L] = A[1];
    Own[L] = A[L & 3];
  }
  for (U L = 0; L < N; ++L)
    Out[L] = Z[L] + Own[L] * 5 + T[(L + 1) % N];
  return Out;
}

const char *const ConditionalInLoop = R"(
// Where the branch ends, a value comes from either side.
kernel void conditional_in_loop(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, r = 0;
  t[l] = l;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = 0; i < k; i++) {
    if (i % 3 == 1) {
      r += t[(l + i) % n];
      barrier(CLK_LOCAL_MEM_FENCE);
      t[l] = r;
      barrier(CLK_LOCAL_MEM_FENCE);
    } else if (l % 2)
      r += i;
    r = r * 3 + l;
  }
  out[get_group_id(0) * n + l] = r;
}
)";

Values conditionalInLoop(U N, U) {
  Values T(N), R(N, 0);
  for (U L = 0; L < N; ++L)
    T[L] = L;
  for (U I = 0; I < Rounds; ++I) {
    if (I % 3 == 1) {
      for (U L = 0; L < N; ++L)
        R[L] += T[(L + I) % N];
      T = R;
    } else {
      for (U L = 1; L < N; L += 2)
        R[L] += I;
    }
    for (U L = 0; L < N; ++L)
      R[L] = R[L] * 3 + L;
  }
  return R;
}

const char *const ManyConditionals = R"(
// Twenty conditions in a row: a million ways from the start to the end.
#define STEP(bit) \
  if (ways & 1u << (bit)) { \
    t[l] = r; \
    barrier(CLK_LOCAL_MEM_FENCE); \
    r += t[(l + (bit) + 1) % n] * 3; \
    barrier(CLK_LOCAL_MEM_FENCE); \
  }
#define FIVE_STEPS(bit) STEP(bit) STEP(bit + 1) STEP(bit + 2) STEP(bit + 3) STEP(bit + 4)
kernel void many_conditionals(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, r = l, ways = (get_group_id(0) + k) * 2654435761u;
  FIVE_STEPS(0) FIVE_STEPS(5) FIVE_STEPS(10) FIVE_STEPS(15)
  out[get_group_id(0) * n + l] = r;
}
)";

Values manyConditionals(U N, U Group) {
  Values T(N), R(N);
  for (U L = 0; L < N; ++L)
    R[L] = L;
  const U Ways = (Group + Rounds) * 2654435761U;
  for (U Bit = 0; Bit < 20; ++Bit) {
    if (!(Ways >> Bit & 1))
      continue;
    T = R;
    for (U L = 0; L < N; ++L)
      R[L] += T[(L + Bit + 1) % N] * 3;
  }
  return R;
}

const char *const PartingInConditional = R"(
// Before the first of a conditional's barriers work-items part, and meet again;
// behind it, too.
kernel void parting_in_conditional(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, r = l;
  global uint *mine = out + get_group_id(0) * n + l;
  for (uint i = 0; i < k; i++)
    if ((i + get_group_id(0)) & 1) {
      t[l] = l & 1 ? *mine + i : r * 3;
      barrier(CLK_LOCAL_MEM_FENCE);
      r += t[(l + 1) % n];
      if (l % 3)
        r += *mine;
      barrier(CLK_LOCAL_MEM_FENCE);
    }
  *mine = r;
}
)";

Values partingInConditional(U N, U Group) {
  Values T(N), R(N);
  for (U L = 0; L < N; ++L)
    R[L] = L;
  for (U I = 0; I < Rounds; ++I) {
    if (!((I + Group) & 1))
      continue;
    for (U L = 0; L < N; ++L)
      T[L] = L & 1 ? Untouched + I : R[L] * 3;
    for (U L = 0; L < N; ++L)
      R[L] += T[(L + 1) % N] + (L % 3 ? Untouched : 0);
  }
  return R;
}

} // namespace

std::vector<GroupKernel> kernelsWithConditionals() {
  return {
      {"conditional", Conditional, conditional},
      {"branch_after_barrier", BranchAfterBarrier, branchAfterBarrier},
      {"merged_tails", MergedTails, mergedTails},
      {"conditional_in_loop", ConditionalInLoop, conditionalInLoop},
      {"many_conditionals", ManyConditionals, manyConditionals},
      {"parting_in_conditional", PartingInConditional, partingInConditional}};
}

} // namespace vorion::test
