/// Work-items that return before barriers to which others of their group come.
/// They take no part in these, and leave memory as it is.
///
/// Each kernel is told to the host a second time, from barrier to barrier for
/// the whole group.

#include "WorkGroups.h"

using namespace vorion::test;

namespace {

constexpr U Groups = 4;

/// Behind ItemMacros.
const char *const Source = R"(
#define NAMES uint l = ITEM, n = ITEMS, id = get_group_id(0) * n + l

kernel void at_once(global uint *out, local uint *t, uint k) {
  NAMES;
  if (id >= k)
    return;
  t[l] = id * 3;
  barrier(CLK_LOCAL_MEM_FENCE);
  out[id] = t[l / 2] + 1;
}

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

/// One group, as long as not all of it have returned.
class Group {
public:
  Group(U Items, U Number, U K)
      : N(Items), First(Items * Number), Number(Number), K(K), T(Items),
        Out(Items, Untouched), Gone(Items), Own(Items) {}

  /// All work-items that have not returned; \p Do is false for one that does.
  template <typename DoT> void each(DoT Do) {
    for (U L = 0; L < N; ++L)
      if (!Gone[L])
        Gone[L] = !Do(L);
  }

  const U N, First, Number, K;
  Values T, Out;
  std::vector<bool> Gone;
  Values Own; ///< a variable of each work-item
};

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

void jumpedToTheEnd(Group &G) {
  G.each([&](U L) {
    G.Out[L] = (L & 2 ? L : 5) + G.K;
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

struct Kernel {
  const char *Name;
  void (*Model)(Group &);
};

const Kernel Kernels[] = {{"at_once", atOnce},
                          {"in_loop", inLoop},
                          {"after_a_barrier", afterABarrier},
                          {"in_conditionals", inConditionals},
                          {"from_two_loops", fromTwoLoops},
                          {"own_rounds", ownRounds},
                          {"long_before_the_end", ownRounds},
                          {"store_at_the_end", storeAtTheEnd},
                          {"barrier_in_some_rounds", barrierInSomeRounds},
                          {"jumped_to_the_end", jumpedToTheEnd},
                          {"counted_rounds", countedRounds},
                          {"length_in_memory", threeRounds},
                          {"read_in_rounds", threeRounds},
                          {"counted_down", threeRounds}};

/// Of the groups the first is whole, the second parts, and the others return.
void compare(const TestDevice &Device, const cl::Program &Program,
             const Kernel &Tested, Shape S) {
  const U N = S.items(), Bound = N + (N + 1) / 2;
  cl::Kernel K(Program, Tested.Name);
  const cl::Buffer Out =
      Device.upload(Values(std::size_t{N} * Groups, Untouched));
  K.setArg(0, Out);
  U Arguments = 1;
  for (; Arguments + 1 < K.getInfo<CL_KERNEL_NUM_ARGS>(); ++Arguments)
    K.setArg(Arguments, cl::Local(N * sizeof(U)));
  K.setArg(Arguments, Bound);
  Device.run(K, cl::NDRange(S.X * Groups, S.Y, S.Z), S.range());
  const Values Got = Device.download<U>(Out, std::size_t{N} * Groups);
  for (U Number = 0; Number < Groups; ++Number) {
    Group G(N, Number, Bound);
    Tested.Model(G);
    const auto Start = Got.begin() + G.First;
    ASSERT_EQ(Values(Start, Start + N), G.Out)
        << Tested.Name << ", group " << Number;
  }
}

class EarlyReturnShapes : public testing::TestWithParam<Shape> {};

TEST_P(EarlyReturnShapes, TheOthersPassTheirBarriers) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(std::string(ItemMacros) + Source);
  for (const Kernel &K : Kernels)
    compare(Device, Program, K, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Shapes, EarlyReturnShapes,
                         testing::Values(Shape{1, 1, 1}, Shape{7, 1, 1},
                                         Shape{16, 1, 1}, Shape{20, 1, 1},
                                         Shape{64, 1, 1}, Shape{256, 1, 1},
                                         Shape{8, 2, 1}, Shape{16, 4, 1},
                                         Shape{4, 3, 2}, Shape{5, 7, 3}));

TEST(EarlyReturns, TheGroupsSizeMayBeRequired) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(std::string(ItemMacros) + Source);
  compare(Device, Program, {"required", required}, {6, 4, 1});
}

} // namespace
