/// Loops with barriers whose work-items go round a different number of times:
/// legal as long as all of a group, or none, come to each barrier.
#include "TestDevice.h"

#include <algorithm>
#include <initializer_list>

using vorion::test::TestDevice;

namespace {

constexpr cl_uint Groups = 2;

const char *const Source = R"(
  // No work-item comes to the barrier.
  kernel void nobody(global uint *out, local uint *shared) {
    const uint id = get_local_id(0);
    shared[id] = id;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint i = 0; i < 2 + id; i++) {
      shared[id] += i;
      if (id >= get_local_size(0))
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    out[get_global_id(0)] = shared[id];
  }
  // All come to it in the first two rounds, nobody in those that only some go.
  kernel void first_rounds(global uint *out, local uint *shared) {
    const uint id = get_local_id(0), size = get_local_size(0);
    uint sum = 0;
    shared[id] = id;
    for (uint i = 0; i < 2 + id; i++) {
      for (uint j = 0; j < id; j++)
        sum += shared[id];
      if (i < 2) {
        barrier(CLK_LOCAL_MEM_FENCE);
        const uint next = shared[(id + 1) % size];
        barrier(CLK_LOCAL_MEM_FENCE);
        shared[id] = next;
      }
    }
    out[get_global_id(0)] = sum;
  }
  // Work-items go back to the barrier from two places. LLVM made two loops of
  // it, with the barrier in the inner one.
  kernel void two_ways_back(global uint *out, local uint *shared) {
    const uint id = get_local_id(0), size = get_local_size(0);
    uint sum = 1;
    shared[id] = id;
    for (uint i = 0; i < 2; i++) {
      barrier(CLK_LOCAL_MEM_FENCE);
      if (i == 1)
        break;
      if (id & 3)
        sum += shared[(id + 1) % size];
    }
    out[get_global_id(0)] = sum;
  }
  // The group may leave in two ways. That all agree in the bound, which is read
  // from memory, the compiler does not know; of the break it knows it.
  kernel void bound_in_memory(global uint *out, local uint *shared) {
    const uint id = get_local_id(0), size = get_local_size(0);
    uint bound = 3, sum = id;
    shared[0] = 3;
    for (uint i = 0; i < bound; i++)
      if (size & 3) {
        barrier(CLK_LOCAL_MEM_FENCE);
        bound = shared[0];
        barrier(CLK_LOCAL_MEM_FENCE);
        for (uint j = 0; j < (id & 3); j++)
          sum = sum * 5 + j;
      } else if (size % 7 == 3)
        break;
    out[get_global_id(0)] = sum;
  }
)";

std::vector<cl_uint> run(const TestDevice &Device, const char *Name,
                         cl_uint Size) {
  const cl::Program Program = Device.build(Source);
  cl::Kernel Kernel(Program, Name);
  const cl::Buffer Out =
      Device.upload(std::vector<cl_uint>(std::size_t{Groups} * Size));
  Kernel.setArg(0, Out);
  Kernel.setArg(1, cl::Local(Size * sizeof(cl_uint)));
  Device.run(Kernel, Groups * Size, Size);
  return Device.download<cl_uint>(Out, std::size_t{Groups} * Size);
}

/// Compares what each work-item of groups of such sizes leaves.
void expectOfEach(const char *Name, std::initializer_list<cl_uint> Sizes,
                  cl_uint (*Want)(cl_uint Id, cl_uint Size)) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  for (const cl_uint Size : Sizes) {
    const std::vector<cl_uint> Got = run(Device, Name, Size);
    for (cl_uint I = 0; I != Got.size(); ++I)
      EXPECT_EQ(Got[I], Want(I % Size, Size))
          << "item " << I % Size << " of " << Size;
  }
}

/// Groups of one warp. In larger ones work-items that leave the others trap.
const std::initializer_list<cl_uint> OneWarp = {1, 2, 4, 7, 16};

TEST(BarrierLoops, WorkItemsGoOnWhereNobodyReachesTheBarrier) {
  expectOfEach("nobody", OneWarp, [](cl_uint Id, cl_uint /*Size*/) {
    return Id + (Id + 1) * (Id + 2) / 2;
  });
}

TEST(BarrierLoops, WorkItemsGoOnAfterTheLastRoundWithABarrier) {
  expectOfEach("first_rounds", OneWarp, [](cl_uint Id, cl_uint Size) {
    cl_uint Sum = 0;
    for (cl_uint Round = 0; Round < 2 + Id; ++Round)
      Sum += Id * ((Id + std::min(Round, 2U)) % Size);
    return Sum;
  });
}

TEST(BarrierLoops, WorkItemsGoBackFromTwoPlaces) {
  expectOfEach("two_ways_back", {1, 7, 16, 17, 64},
               [](cl_uint Id, cl_uint Size) {
                 return Id & 3 ? 1 + (Id + 1) % Size : 1;
               });
}

TEST(BarrierLoops, TheGroupLeavesInTwoWays) {
  expectOfEach("bound_in_memory", {1, 7, 16, 17, 24, 64},
               [](cl_uint Id, cl_uint Size) {
                 cl_uint Sum = Id;
                 for (cl_uint Round = 0; Round != (Size & 3 ? 3 : 0); ++Round)
                   for (cl_uint J = 0; J != (Id & 3); ++J)
                     Sum = Sum * 5 + J;
                 return Sum;
               });
}

} // namespace
