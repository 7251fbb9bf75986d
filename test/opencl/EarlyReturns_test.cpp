/// Work-items that return before barriers in straight code and conditionals.

#include "EarlyReturns.h"

using namespace vorion::test;

namespace {

const char *const Source = R"(
kernel void at_once(global uint *out, local uint *t, uint k) {
  NAMES;
  if (id >= k)
    return;
  t[l] = id * 3;
  barrier(CLK_LOCAL_MEM_FENCE);
  out[id] = t[l / 2] + 1;
}

kernel void after_a_barrier(global uint *out, local uint *t, uint k) {
  NAMES;
  out[id] = l;
  t[l] = l * l;
  barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
  if (l & 1)
    return;
  uint v = t[(l + 1) % n] + out[id - l];
  barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
  if (l % 3 == 1 && k) {
    out[id] = 99;
    return;
  }
  t[l] = v * 2;
  barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
  out[id] = t[l] + t[(l + 2) % n];
}

int is_done(uint x) {
  if (x % 5 == 3)
    return 1;
  for (uint i = 0; i < x % 4; i++)
    if (i * 7 == x)
      return 1;
  return 0;
}

kernel void in_conditionals(global uint *out, local uint *t, uint k) {
  NAMES;
  t[l] = 1;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (l & 1) {
    if (l & 2) {
      out[id] = 77;
      return;
    }
    if (is_done(l))
      return;
    t[l] = 5;
  } else if (l % 6 == 4) {
    return;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  uint s = 0;
  for (uint j = 0; j < n; j++)
    s = s * 3 + t[j];
  out[id] = s;
}

// What each leaves at the end depends on how it came there.
kernel void jumped_to_the_end(global uint *out, local uint *t, uint k) {
  NAMES, w = l;
  t[l] = 1;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (l & 2)
    goto done;
  w = w * 3 + 1;
  if (t[0]) {
    w = 5;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
done:
  out[id] = w + k;
}

kernel __attribute__((reqd_work_group_size(6, 4, 1)))
void required(global uint *out, local uint *t, uint k) {
  NAMES;
  if (get_local_id(0) > get_local_id(1))
    return;
  t[l] = l;
  barrier(CLK_LOCAL_MEM_FENCE);
  out[id] = t[get_local_id(1) * 6];
}
)";

void atOnce(Group &G) {
  G.each([&](U L) {
    G.T[L] = (G.First + L) * 3;
    return G.First + L < G.K;
  });
  G.each([&](U L) {
    G.Out[L] = G.T[L / 2] + 1;
    return true;
  });
}

void afterABarrier(Group &G) {
  G.each([&](U L) {
    G.Out[L] = L;
    G.T[L] = L * L;
    return true;
  });
  G.each([&](U L) {
    G.Own[L] = G.T[(L + 1) % G.N] + G.Out[0];
    return L % 2 == 0;
  });
  G.each([&](U L) {
    if (L % 3 == 1)
      G.Out[L] = 99;
    else
      G.T[L] = G.Own[L] * 2;
    return L % 3 != 1;
  });
  G.each([&](U L) {
    G.Out[L] = G.T[L] + G.T[(L + 2) % G.N];
    return true;
  });
}

bool isDone(U X) {
  for (U I = 0; I < X % 4; ++I)
    if (I * 7 == X)
      return true;
  return X % 5 == 3;
}

void inConditionals(Group &G) {
  G.each([&](U L) {
    G.T[L] = 1;
    return true;
  });
  G.each([&](U L) {
    if (L % 4 == 3)
      G.Out[L] = 77;
    if (L % 4 == 3 || (L % 2 == 1 && isDone(L)) || L % 6 == 4)
      return false;
    if (L % 2 == 1)
      G.T[L] = 5;
    return true;
  });
  G.each([&](U L) {
    U Sum = 0;
    for (U J = 0; J < G.N; ++J)
      Sum = Sum * 3 + G.T[J];
    G.Out[L] = Sum;
    return true;
  });
}

void jumpedToTheEnd(Group &G) {
  G.each([&](U L) {
    G.Out[L] = (L & 2 ? L : 5) + G.K;
    return true;
  });
}

void required(Group &G) {
  G.each([&](U L) {
    G.T[L] = L;
    return L % 6 <= L / 6;
  });
  G.each([&](U L) {
    G.Out[L] = G.T[L / 6 * 6];
    return true;
  });
}

const std::vector<EarlyReturn> Kernels = {
    {"at_once", atOnce},
    {"after_a_barrier", afterABarrier},
    {"in_conditionals", inConditionals},
    {"jumped_to_the_end", jumpedToTheEnd}};

class EarlyReturnsOf : public testing::TestWithParam<Shape> {};

TEST_P(EarlyReturnsOf, TheOthersPassTheirBarriers) {
  compareAll(Source, Kernels, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Shapes, EarlyReturnsOf, EarlyReturnShapes);

TEST(EarlyReturns, TheGroupsSizeMayBeRequired) {
  compareAll(Source, {{"required", required}}, {6, 4, 1});
}

} // namespace
