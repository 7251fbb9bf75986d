/// What the tests of early returns share. Work-items return before barriers to
/// which others of their group come. They take no part in these, and leave
/// memory as it is.
///
/// Each kernel is told to the host a second time, from barrier to barrier for
/// the whole group.
#pragma once

#include "WorkGroups.h"

namespace vorion::test {

/// Groups of a launch.
constexpr U EarlyReturnGroups = 4;

/// OpenCL C for the names that kernels have for their work-items.
inline const char *const EarlyReturnNames = R"(
#define NAMES uint l = ITEM, n = ITEMS, id = get_group_id(0) * n + l
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

/// A kernel (output, local memory ..., bound), and what it does to a group.
struct EarlyReturn {
  const char *Name;
  void (*Model)(Group &);
};

/// Of the groups the first is whole, the second parts, and the others return.
inline void compare(const TestDevice &Device, const cl::Program &Program,
                    const EarlyReturn &Tested, Shape S) {
  const U N = S.items(), Bound = N + (N + 1) / 2;
  cl::Kernel K(Program, Tested.Name);
  const cl::Buffer Out =
      Device.upload(Values(std::size_t{N} * EarlyReturnGroups, Untouched));
  K.setArg(0, Out);
  U Arguments = 1;
  for (; Arguments + 1 < K.getInfo<CL_KERNEL_NUM_ARGS>(); ++Arguments)
    K.setArg(Arguments, cl::Local(N * sizeof(U)));
  K.setArg(Arguments, Bound);
  Device.run(K, cl::NDRange(S.X * EarlyReturnGroups, S.Y, S.Z), S.range());
  const Values Got =
      Device.download<U>(Out, std::size_t{N} * EarlyReturnGroups);
  for (U Number = 0; Number < EarlyReturnGroups; ++Number) {
    Group G(N, Number, Bound);
    Tested.Model(G);
    const auto Start = Got.begin() + G.First;
    ASSERT_EQ(Values(Start, Start + N), G.Out)
        << Tested.Name << ", group " << Number;
  }
}

/// Builds \p Source, which names a work-item by EarlyReturnNames, and compares
/// its kernels in groups of one shape.
inline void compareAll(const std::string &Source,
                       const std::vector<EarlyReturn> &Kernels, Shape S) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program =
      Device.build(std::string(ItemMacros) + EarlyReturnNames + Source);
  for (const EarlyReturn &K : Kernels)
    compare(Device, Program, K, S);
}

/// The shapes of groups that all such kernels run in.
inline const auto EarlyReturnShapes = testing::Values(
    Shape{1, 1, 1}, Shape{7, 1, 1}, Shape{16, 1, 1}, Shape{20, 1, 1},
    Shape{64, 1, 1}, Shape{256, 1, 1}, Shape{8, 2, 1}, Shape{16, 4, 1},
    Shape{4, 3, 2}, Shape{5, 7, 3});

} // namespace vorion::test
