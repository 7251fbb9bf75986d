/// Groups of every awkward size and shape (docs/decisions.md, 6): one lane,
/// less than a warp, exactly one, one more, several passes with a ragged last,
/// the largest; with barriers straight, in loops and in conditionals.

#include "WorkGroups.h"
#include "groups/Kernels.h"

#include <string>
#include <vector>

using namespace vorion::test;

namespace {

constexpr U Groups = 11; ///< more than cores, not a multiple

class GroupShapes : public testing::TestWithParam<Shape> {};

Values run(const TestDevice &Device, const cl::Program &Program,
           const char *Name, Shape Local, const cl::NDRange &Global, U Items) {
  cl::Kernel K(Program, Name);
  const cl::Buffer Out = Device.upload(Values(Items, Untouched));
  K.setArg(0, Out);
  K.setArg(1, cl::Local(Local.items() * sizeof(U)));
  K.setArg(2, Rounds);
  Device.run(K, Global, Local.range());
  return Device.download<U>(Out, Items);
}

TEST_P(GroupShapes, BarriersSeparateWhatWorkItemsDo) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  std::string Source = ItemMacros;
  std::vector<GroupKernel> Kernels;
  for (const std::vector<GroupKernel> &Some :
       {straightKernels(), kernelsWithConditionals(), kernelsWithLoops()})
    for (const GroupKernel &K : Some) {
      Source += K.Source;
      Kernels.push_back(K);
    }
  const cl::Program Program = Device.build(Source);
  const Shape S = GetParam();
  for (const GroupKernel &K : Kernels) {
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
  const cl::Program Program = Device.build(R"(
kernel void ids(global uint *out, local uint *t, uint k) {
  uint item = get_global_id(0) + get_global_size(0) * (get_global_id(1) + get_global_size(1) * get_global_id(2));
  out[item] = get_local_id(0) | get_local_id(1) << 10 | get_local_id(2) << 20;
}
)");
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
