/// Work-items that return before barriers in loops.

#include "EarlyReturns.h"

using namespace vorion::test;

namespace {

const char *const Source = R"(
kernel void in_loop(global uint *out, local uint *t, uint k) {
  NAMES;
  t[l] = l;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = 0; i < 5; i++) {
    if (id + i * 2 >= k)
      return;
    uint v = t[(l + i) % n];
    barrier(CLK_LOCAL_MEM_FENCE);
    t[l] += v * v;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  out[id] = t[l] + t[n - 1];
}

kernel void from_two_loops(global uint *out, local uint *t, uint k) {
  NAMES;
  uint r = l;
  t[l] = 0;
  for (uint i = n; i > 0; i /= 4) {
    for (uint j = 0; j < l % 3; j++) {
      r = r * 5 + j;
      if (r % 11 == 4)
        return;
    }
    t[l] = r;
    barrier(CLK_LOCAL_MEM_FENCE);
    r += t[(l + i) % n];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  out[id] = r;
}

// Each goes as many rounds as it likes; who has gone them has come to the end.
kernel void own_rounds(global uint *out, local uint *t, uint k) {
  NAMES;
  uint r = 0;
  t[l] = l;
  for (uint i = 0; i < l % 4 + 1; i++) {
    barrier(CLK_LOCAL_MEM_FENCE);
    r = r * 3 + t[(l + 1) % n];
    barrier(CLK_LOCAL_MEM_FENCE);
    t[l] += r;
  }
  out[id] = r;
}

// The group must not go on alone with those that have returned.
kernel void long_before_the_end(global uint *out, local uint *t, uint k) {
  NAMES, v = 0;
  t[l] = l;
  for (uint i = 0; i < 1u << 30; i++) {
    barrier(CLK_LOCAL_MEM_FENCE);
    v = v * 3 + t[(l + 1) % n];
    barrier(CLK_LOCAL_MEM_FENCE);
    t[l] += v;
    out[id] = v;
    if (i >= l % 4)
      return;
  }
}

// The group decides about a barrier by what it reads, and a store ends a round.
kernel void store_at_the_end(global uint *out, local uint *t, uint k) {
  NAMES;
  uint a[4] = {1, l, 7, 4};
  t[l] = 3;
  for (uint i = 0; i < 5; i++) {
    barrier(CLK_LOCAL_MEM_FENCE);
    if (t[0] & 3) {
      barrier(CLK_LOCAL_MEM_FENCE);
      if (id + i >= k)
        return;
    }
    if (k == 7)
      break;
    a[l & 3] = i;
  }
  out[id] = a[l & 3];
}

// In groups of some sizes no round has a barrier.
kernel void barrier_in_some_rounds(global uint *out, local uint *t, uint k) {
  NAMES, v = 0;
  t[l] = l;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = 1; i < 9; i++) {
    if (i > (l & 3)) {
      out[id] = v;
      return;
    }
    if (k & 8) {
      if (k % 7 == 2)
        break;
      barrier(CLK_LOCAL_MEM_FENCE);
      v = v * 3 + t[(l + 1) % n];
    }
  }
  out[id] = v + 100;
}

// How many rounds there are, the group reads from memory.
kernel void counted_rounds(global uint *out, local uint *t, local uint *rounds, uint k) {
  NAMES;
  uint r = 0;
  if (l == 0)
    *rounds = get_group_id(0) + 2;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (id >= k)
    return;
  for (uint i = 0; i < *rounds; i++) {
    t[l] = r + l;
    barrier(CLK_LOCAL_MEM_FENCE);
    r += t[l / 2];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  out[id] = r;
}

// A group that returns as a whole has no such memory.
#define LENGTH (get_group_id(0) < 2 ? out + 3 * n : (global uint *)8)
kernel void length_in_memory(global uint *out, local uint *t, uint k) {
  NAMES;
  uint r = 0;
  if (id >= k)
    return;
  uint length = *LENGTH & 3;
  for (uint i = 0; i < length; i++) {
    t[l] = r + l;
    barrier(CLK_LOCAL_MEM_FENCE);
    r += t[l / 2];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  out[id] = r;
}

kernel void read_in_rounds(global uint *out, local uint *t, uint k) {
  NAMES;
  uint r = 0, i = 0;
  if (id >= k)
    return;
  float length;
  do {
    t[l] = r + l;
    barrier(CLK_LOCAL_MEM_FENCE);
    r += t[l / 2];
    length = (float)(*LENGTH & 3);
    barrier(CLK_LOCAL_MEM_FENCE);
  } while (++i < length);
  out[id] = r;
}

// A work-item changes what the group's way depends on.
kernel void counted_down(global uint *out, local uint *t, local uint *rounds, uint k) {
  NAMES;
  uint r = 0;
  if (l == 0)
    *rounds = 3;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (id >= k)
    return;
  while (1) {
    uint left = *rounds;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (left == 0)
      break;
    if (l == 0)
      *rounds = left - 1;
    t[l] = r + l;
    barrier(CLK_LOCAL_MEM_FENCE);
    r += t[l / 2];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  out[id] = r;
}
)";

void inLoop(Group &G) {
  G.each([&](U L) {
    G.T[L] = L;
    return true;
  });
  for (U I = 0; I < 5; ++I) {
    G.each([&](U L) {
      G.Own[L] = G.T[(L + I) % G.N];
      return G.First + L + I * 2 < G.K;
    });
    G.each([&](U L) {
      G.T[L] += G.Own[L] * G.Own[L];
      return true;
    });
  }
  G.each([&](U L) {
    G.Out[L] = G.T[L] + G.T[G.N - 1];
    return true;
  });
}

void fromTwoLoops(Group &G) {
  G.each([&](U L) {
    G.Own[L] = L;
    return true;
  });
  for (U I = G.N; I > 0; I /= 4) {
    G.each([&](U L) {
      for (U J = 0; J < L % 3; ++J) {
        G.Own[L] = G.Own[L] * 5 + J;
        if (G.Own[L] % 11 == 4)
          return false;
      }
      G.T[L] = G.Own[L];
      return true;
    });
    G.each([&](U L) {
      G.Own[L] += G.T[(L + I) % G.N];
      return true;
    });
  }
  G.each([&](U L) {
    G.Out[L] = G.Own[L];
    return true;
  });
}

void ownRounds(Group &G) {
  G.each([&](U L) {
    G.T[L] = L;
    return true;
  });
  for (U I = 0; I < 4; ++I) {
    G.each([&](U L) {
      G.Own[L] = G.Own[L] * 3 + G.T[(L + 1) % G.N];
      return true;
    });
    G.each([&](U L) {
      G.T[L] += G.Own[L];
      G.Out[L] = G.Own[L];
      return I < L % 4;
    });
  }
}

void storeAtTheEnd(Group &G) {
  G.each([&](U L) { return G.First + L + 4 < G.K; });
  G.each([&](U L) {
    G.Out[L] = 4;
    return true;
  });
}

void barrierInSomeRounds(Group &G) {
  G.each([&](U L) {
    const bool Breaks = (G.K & 8) && G.K % 7 == 2 && L % 4 != 0;
    G.Out[L] = Breaks ? 100 : 0;
    for (U I = 0; I < L % 4 && (G.K & 8) && !Breaks; ++I)
      G.Out[L] = G.Out[L] * 3 + (L + 1) % G.N;
    return true;
  });
}

void rounds(Group &G, U Count) {
  G.each([&](U L) { return G.First + L < G.K; });
  for (U I = 0; I < Count; ++I) {
    G.each([&](U L) {
      G.T[L] = G.Own[L] + L;
      return true;
    });
    G.each([&](U L) {
      G.Own[L] += G.T[L / 2];
      G.Out[L] = G.Own[L];
      return true;
    });
  }
}

void countedRounds(Group &G) { rounds(G, G.Number + 2); }
void threeRounds(Group &G) { rounds(G, 3); }

const std::vector<EarlyReturn> Kernels = {
    {"in_loop", inLoop},
    {"from_two_loops", fromTwoLoops},
    {"own_rounds", ownRounds},
    {"long_before_the_end", ownRounds},
    {"store_at_the_end", storeAtTheEnd},
    {"barrier_in_some_rounds", barrierInSomeRounds},
    {"counted_rounds", countedRounds},
    {"length_in_memory", threeRounds},
    {"read_in_rounds", threeRounds},
    {"counted_down", threeRounds}};

class EarlyReturnLoopsOf : public testing::TestWithParam<Shape> {};

TEST_P(EarlyReturnLoopsOf, TheOthersPassTheirBarriers) {
  compareAll(Source, Kernels, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Shapes, EarlyReturnLoopsOf, EarlyReturnShapes);

} // namespace
