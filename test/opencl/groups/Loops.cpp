/// Barriers within loops, behind loops, and loops around them.

#include "Kernels.h"

namespace vorion::test {

namespace {

const char *const Loop = R"(
kernel void loop(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, s = l;
  t[l] = l;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = 0; i < k; i++) {
    uint v = t[(l + i) % n];
    barrier(CLK_LOCAL_MEM_FENCE);
    s = s * 3 + v;
    t[l] = s;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  out[get_group_id(0) * n + l] = s + t[n - 1 - l];
}
)";

Values loop(U N, U) {
  Values T(N), S(N), Out(N);
  for (U L = 0; L < N; ++L)
    T[L] = S[L] = L;
  for (U I = 0; I < Rounds; ++I) {
    for (U L = 0; L < N; ++L)
      S[L] = S[L] * 3 + T[(L + I) % N];
    T = S;
  }
  for (U L = 0; L < N; ++L)
    Out[L] = S[L] + T[N - 1 - L];
  return Out;
}

const char *const NestedLoops = R"(
// A loop with barriers in another, ahead of them one without.
kernel void nested_loops(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, v = l * 3, w = l;
  for (uint i = 0; i < 4; i++)
    for (uint j = 0; j < i % 3; j++) {
      for (uint m = 0; m < k % 3; m++)
        w = w * 5 + 14;
      t[l] = v;
      barrier(CLK_LOCAL_MEM_FENCE);
      v = t[(l + 7) % n] + w;
      barrier(CLK_LOCAL_MEM_FENCE);
    }
  out[get_group_id(0) * n + l] = v;
}
)";

Values nestedLoops(U N, U) {
  Values V(N), W(N), T(N);
  for (U L = 0; L < N; ++L) {
    V[L] = L * 3;
    W[L] = L;
  }
  for (U I = 0; I < 4; ++I)
    for (U J = 0; J < I % 3; ++J) {
      for (U M = 0; M < Rounds % 3; ++M)
        for (U &Value : W)
          Value = Value * 5 + 14;
      T = V;
      for (U L = 0; L < N; ++L)
        V[L] = T[(L + 7) % N] + W[L];
    }
  return V;
}

const char *const GuardedLoop = R"(
// A loop that the group may pass by lies in another: what its rounds share is
// computed in front of it, behind the condition.
kernel void guarded_loop(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, x = l * 7 + k;
  for (uint i = 0; i < 2; i++)
    if (k & 1) {
      for (uint j = k & 3; j > 0; j--) {
        t[l] = 1000000 % (x | 1);
        barrier(CLK_LOCAL_MEM_FENCE);
      }
      barrier(CLK_LOCAL_MEM_FENCE);
    }
  out[get_group_id(0) * n + l] = t[l];
}
)";

Values guardedLoop(U N, U) {
  Values V(N);
  for (U L = 0; L < N; ++L)
    V[L] = 1000000 % ((L * 7 + Rounds) | 1);
  return V;
}

const char *const EndlessIfReached = R"(
// The innermost loop would not end for a value that i never has; what follows is
// reached all the same, by all lanes together.
kernel void endless_if_reached(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, v = l * 3, w = l, p[4] = {0, 0, 0, 0};
  for (uint i = 0; i < k % 5; i++) {
    for (uint j = 0; j < l % 5; j++) {
      for (uint m = 0; m < (i & 5) % 5; m++)
        p[1] = 70;
      w += p[v & 3];
    }
    t[l] = v + w;
    barrier(CLK_LOCAL_MEM_FENCE);
    v = t[(l + 8) % n];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  out[get_group_id(0) * n + l] = v + w;
}
)";

Values endlessIfReached(U N, U) {
  Values V(N), W(N), Seen(N, 0), T(N), Out(N);
  for (U L = 0; L < N; ++L) {
    V[L] = L * 3;
    W[L] = L;
  }
  for (U I = 0; I < Rounds % 5; ++I) {
    for (U L = 0; L < N; ++L) {
      for (U J = 0; J < L % 5; ++J) {
        if ((I & 5) % 5)
          Seen[L] = 70;
        W[L] += (V[L] & 3) == 1 ? Seen[L] : 0;
      }
      T[L] = V[L] + W[L];
    }
    for (U L = 0; L < N; ++L)
      V[L] = T[(L + 8) % N];
  }
  for (U L = 0; L < N; ++L)
    Out[L] = V[L] + W[L];
  return Out;
}

const char *const LoopThenBarrier = R"(
// Lanes leave the inner loop at different times, and all meet at the barrier.
kernel void loop_then_barrier(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, s = 0;
  for (uint i = 0; i < k; i++) {
    uint x = l * 2654435761u + i;
    do {
      x = x * 1664525 + 1013904223;
      s++;
    } while (x >> 28 != 5);
    t[l] = x;
    barrier(CLK_LOCAL_MEM_FENCE);
    s += t[(l + 1) % n];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  out[get_group_id(0) * n + l] = s;
}
)";

Values loopThenBarrier(U N, U) {
  Values T(N), S(N, 0);
  for (U I = 0; I < Rounds; ++I) {
    for (U L = 0; L < N; ++L) {
      U X = L * 2654435761U + I;
      do {
        X = X * 1664525U + 1013904223U;
        ++S[L];
      } while (X >> 28 != 5);
      T[L] = X;
    }
    for (U L = 0; L < N; ++L)
      S[L] += T[(L + 1) % N];
  }
  return S;
}

const char *const PrefixSum = R"(
// Two barriers a step of a loop whose length is the group's.
kernel void prefix_sum(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS;
  t[l] = l + get_group_id(0);
  for (uint step = 1; step < n; step *= 2) {
    barrier(CLK_LOCAL_MEM_FENCE);
    uint v = l >= step ? t[l - step] : 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    t[l] += v;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  out[get_group_id(0) * n + l] = t[l];
}
)";

Values prefixSum(U N, U Group) {
  Values Out(N);
  for (U L = 0, Sum = 0; L < N; ++L)
    Out[L] = Sum += L + Group;
  return Out;
}

} // namespace

std::vector<GroupKernel> kernelsWithLoops() {
  return {{"loop", Loop, loop},
          {"nested_loops", NestedLoops, nestedLoops},
          {"guarded_loop", GuardedLoop, guardedLoop},
          {"endless_if_reached", EndlessIfReached, endlessIfReached},
          {"loop_then_barrier", LoopThenBarrier, loopThenBarrier},
          {"prefix_sum", PrefixSum, prefixSum}};
}

} // namespace vorion::test
