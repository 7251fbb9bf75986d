/// Groups of every awkward size and shape (docs/decisions.md, 6): one lane,
/// less than a warp, exactly one, one more, several passes with a ragged last,
/// the largest; with barriers straight, in loops and in conditionals.
///
/// Each kernel is told to the host a second time, step by step for the whole
/// group; unsigned arithmetic, so that wrapping around is defined.

#include "TestDevice.h"

#include <cstdint>
#include <functional>
#include <ostream>

using vorion::test::TestDevice;

namespace {

using U = uint32_t;
using Values = std::vector<U>;

struct Shape {
  U X, Y, Z;
  U items() const { return X * Y * Z; }
};

/// What GoogleTest shows for a parameter.
[[maybe_unused]] void PrintTo(const Shape &S, std::ostream *Stream) {
  *Stream << S.X << "x" << S.Y << "x" << S.Z;
}

constexpr U Groups = 11; ///< more than cores, not a multiple
constexpr U Rounds = 7;  ///< argument k
/// What the output holds before a kernel runs.
constexpr U Untouched = ~U{0};

const char *const Source = R"(
#define ITEM (get_local_id(0) + get_local_size(0) * (get_local_id(1) + get_local_size(1) * get_local_id(2)))
#define ITEMS (get_local_size(0) * get_local_size(1) * get_local_size(2))

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

kernel void ids(global uint *out, local uint *t, uint k) {
  uint item = get_global_id(0) + get_global_size(0) * (get_global_id(1) + get_global_size(1) * get_global_id(2));
  out[item] = get_local_id(0) | get_local_id(1) << 10 | get_local_id(2) << 20;
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

Values conditional(U N, U Group) {
  Values R(N), Out(N);
  for (U L = 0; L < N; ++L)
    R[L] =
        Group & 1 ? (N - 1 - L) * 5 + (L & 1 ? 100 : 0) : (L + 2) % N * 5 - L;
  for (U L = 0; L < N; ++L)
    Out[L] = Group & 1 ? R[L] : R[L] + R[(L + 1) % N];
  return Out;
}

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

Values capturedPrivate(U N, U) {
  Values Out(N);
  for (U L = 0; L < N; ++L) {
    U Places[2] = {Rounds, N};
    Places[L * 7 / 3 & 1] = L + 5;
    Out[L] = (L + 1) % N + Places[0] * 3 + Places[1] * 5;
  }
  return Out;
}

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

Values guardedLoop(U N, U) {
  Values V(N);
  for (U L = 0; L < N; ++L)
    V[L] = 1000000 % ((L * 7 + Rounds) | 1);
  return V;
}

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

Values prefixSum(U N, U Group) {
  Values Out(N);
  for (U L = 0, Sum = 0; L < N; ++L)
    Out[L] = Sum += L + Group;
  return Out;
}

struct Kernel {
  const char *Name;
  Values (*Expected)(U Items, U Group);
};

const Kernel Kernels[] = {{"straight", straight},
                          {"loop", loop},
                          {"conditional", conditional},
                          {"branch_after_barrier", branchAfterBarrier},
                          {"merged_tails", mergedTails},
                          {"captured_private", capturedPrivate},
                          {"nested_loops", nestedLoops},
                          {"guarded_loop", guardedLoop},
                          {"endless_if_reached", endlessIfReached},
                          {"conditional_in_loop", conditionalInLoop},
                          {"many_conditionals", manyConditionals},
                          {"parting_in_conditional", partingInConditional},
                          {"loop_then_barrier", loopThenBarrier},
                          {"private_array", privateArray},
                          {"prefix_sum", prefixSum}};

class GroupShapes : public testing::TestWithParam<Shape> {};

Values run(const TestDevice &Device, const cl::Program &Program,
           const char *Name, Shape Local, cl::NDRange Global, U Items) {
  cl::Kernel K(Program, Name);
  const cl::Buffer Out = Device.upload(Values(Items, Untouched));
  K.setArg(0, Out);
  K.setArg(1, cl::Local(Local.items() * sizeof(U)));
  K.setArg(2, Rounds);
  cl::Event Done;
  EXPECT_EQ(Device.queue().enqueueNDRangeKernel(
                K, cl::NullRange, Global,
                cl::NDRange(Local.X, Local.Y, Local.Z), nullptr, &Done),
            CL_SUCCESS);
  EXPECT_EQ(Done.wait(), CL_SUCCESS) << Name;
  return Device.download<U>(Out, Items);
}

TEST_P(GroupShapes, BarriersSeparateWhatWorkItemsDo) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  std::string Log;
  const cl::Program Program = Device.build(Source, Log);
  ASSERT_EQ(Log, "");
  const Shape S = GetParam();
  for (const Kernel &K : Kernels) {
    const Values Got =
        run(Device, Program, K.Name, S, cl::NDRange(S.X * Groups, S.Y, S.Z),
            S.items() * Groups);
    for (U G = 0; G < Groups; ++G) {
      const Values Want = K.Expected(S.items(), G);
      const auto Start = Got.begin() + G * S.items();
      ASSERT_EQ(Values(Start, Start + S.items()), Want)
          << K.Name << ", group " << G;
    }
  }
}

TEST_P(GroupShapes, IdsFollowTheShape) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  std::string Log;
  const cl::Program Program = Device.build(Source, Log);
  ASSERT_EQ(Log, "");
  const Shape S = GetParam();
  const U X = S.X * 3, Y = S.Y * 2, Z = S.Z * 2;
  const Values Got =
      run(Device, Program, "ids", S, cl::NDRange(X, Y, Z), X * Y * Z);
  for (U I = 0; I < X * Y * Z; ++I) {
    const U Want = I % X % S.X | I / X % Y % S.Y << 10 | I / X / Y % S.Z << 20;
    ASSERT_EQ(Got[I], Want) << "item " << I;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, GroupShapes,
    testing::Values(Shape{1, 1, 1}, Shape{7, 1, 1}, Shape{16, 1, 1},
                    Shape{17, 1, 1}, Shape{20, 1, 1}, Shape{64, 1, 1},
                    Shape{1024, 1, 1}, Shape{4, 64, 1}, Shape{1, 1, 64},
                    Shape{4, 2, 2}, Shape{3, 5, 2}, Shape{1, 1, 7},
                    Shape{32, 3, 2}, Shape{8, 6, 3}, Shape{4, 3, 5},
                    Shape{24, 10, 1}, Shape{5, 7, 11}, Shape{1, 3, 50}));

} // namespace
