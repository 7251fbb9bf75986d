/// Barriers one after the other, which every work-item of every group passes.

#include "Kernels.h"

namespace vorion::test {

namespace {

const char *const Straight = R"(
kernel void straight(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS;
  t[l] = l * 3 + get_group_id(0);
  barrier(CLK_LOCAL_MEM_FENCE);
  uint v = t[n - 1 - l];
  barrier(CLK_LOCAL_MEM_FENCE);
  t[l] = v + 1;
  barrier(CLK_LOCAL_MEM_FENCE);
  out[get_group_id(0) * n + l] = t[(l + 1) % n] * 7 + l;
}
)";

Values straight(U N, U Group) {
  Values T(N), Out(N);
  for (U L = 0; L < N; ++L)
    T[L] = (N - 1 - L) * 3 + Group + 1;
  for (U L = 0; L < N; ++L)
    Out[L] = T[(L + 1) % N] * 7 + L;
  return Out;
}

const char *const CapturedPrivate = R"(
// A private variable is written through a pointer that lies in memory.
kernel void captured_private(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, x = k, y = n, *places[2] = {&x, &y};
  *places[l * 7 / 3 & 1] = l + 5;
  uint v = x, w = y;
  t[l] = l;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint o = t[(l + 1) % n];
  barrier(CLK_LOCAL_MEM_FENCE);
  out[get_group_id(0) * n + l] = o + v * 3 + w * 5;
}
)";

Values capturedPrivate(U N, U) {
  Values Out(N);
  for (U L = 0; L < N; ++L) {
    U Places[2] = {Rounds, N};
    Places[L * 7 / 3 & 1] = L + 5;
    Out[L] = (L + 1) % N + Places[0] * 3 + Places[1] * 5;
  }
  return Out;
}

const char *const PrivateArray = R"(
// An array that keeps its content across barriers, indexed by what is not known.
kernel void private_array(global uint *out, local uint *t, uint k) {
  uint l = ITEM, n = ITEMS, s = 0, p[6];
  for (uint i = 0; i < 6; i++)
    p[i] = l * i;
  t[l] = p[l % 6];
  barrier(CLK_LOCAL_MEM_FENCE);
  p[t[(l * 7 + 3) % n] % 6] += 1000;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = 0; i < l % 6 + 1; i++)
    s += p[i];
  out[get_group_id(0) * n + l] = s;
}
)";

Values privateArray(U N, U) {
  Values Out(N, 0);
  for (U L = 0; L < N; ++L) {
    U P[6];
    for (U I = 0; I < 6; ++I)
      P[I] = L * I;
    const U Other = (L * 7 + 3) % N;
    P[Other * (Other % 6) % 6] += 1000;
    for (U I = 0; I < L % 6 + 1; ++I)
      Out[L] += P[I];
  }
  return Out;
}

} // namespace

std::vector<GroupKernel> straightKernels() {
  return {{"straight", Straight, straight},
          {"captured_private", CapturedPrivate, capturedPrivate},
          {"private_array", PrivateArray, privateArray}};
}

} // namespace vorion::test
