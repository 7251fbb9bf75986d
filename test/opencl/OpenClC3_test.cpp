/// What OpenCL C 3.0 has beyond 1.2: generic pointers and the atomics of C11.

#include "TestDevice.h"

#include <cstdint>

using vorion::test::TestDevice;

namespace {

constexpr std::size_t Groups = 4;

TEST(OpenClC3, GenericPointersKnowWhatTheyPointTo) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  // `kept` lives across the barrier, so it is not on the stack in large groups.
  const cl::Program Program = Device.build(R"(
int space(generic int *p) {
  return (to_global(p) == p) + 2 * (to_local(p) == p) +
         4 * (to_private(p) == p) +
         8 * (get_fence(p) == CLK_LOCAL_MEM_FENCE);
}
kernel void spaces(global int *out, local int *given) {
  size_t i = get_global_id(0);
  local int own;
  int kept[3] = {i, i + 1, i + 2};
  generic int *p = kept;
  int before = space(p);
  barrier(CLK_LOCAL_MEM_FENCE);
  out[i] = space(out) + 16 * space(given) + 256 * space(&own) + 4096 * before +
           65536 * space(p) + 1048576 * (p[2] == i + 2);
})",
                                           "-cl-std=CL3.0");
  cl::Kernel Kernel(Program, "spaces");
  for (const std::size_t Size : {std::size_t{7}, std::size_t{40}}) {
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE,
                         Groups * Size * sizeof(uint32_t));
    Kernel.setArg(0, Out);
    Kernel.setArg(1, cl::Local(64));
    Device.run(Kernel, Groups * Size, Size);
    EXPECT_EQ(Device.download<uint32_t>(Out, Groups * Size),
              std::vector<uint32_t>(Groups * Size, 0x144AA1))
        << Size;
  }
}

TEST(OpenClC3, AtomicsOfAllSpacesCountEveryWorkItem) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
void add_half(generic atomic_float *sum) {
  float seen = atomic_load_explicit(sum, memory_order_relaxed);
  while (!atomic_compare_exchange_weak(sum, &seen, seen + 0.5f))
    ;
}
kernel void count(global atomic_int *all, global atomic_uint *greatest,
                  global atomic_float *sum, global int *of_group) {
  local atomic_int own;
  if (get_local_id(0) == 0)
    atomic_init(&own, 5);
  work_group_barrier(CLK_LOCAL_MEM_FENCE, memory_scope_work_group);
  atomic_fetch_add_explicit(&own, 1, memory_order_relaxed,
                            memory_scope_work_group);
  atomic_fetch_add(all, 1);
  atomic_fetch_max_explicit(greatest, get_global_id(0), memory_order_acq_rel,
                            memory_scope_device);
  add_half(sum);
  work_group_barrier(CLK_LOCAL_MEM_FENCE);
  of_group[get_global_id(0)] = atomic_load(&own);
})",
                                           "-cl-std=CL3.0");
  cl::Kernel Kernel(Program, "count");
  for (const std::size_t Size : {std::size_t{7}, std::size_t{40}}) {
    const std::size_t Items = Groups * Size;
    const cl::Buffer All = Device.upload(std::vector<int32_t>{0}),
                     Greatest = Device.upload(std::vector<uint32_t>{0}),
                     Sum = Device.upload(std::vector<float>{0}),
                     OfGroup(Device.context(), CL_MEM_READ_WRITE,
                             Items * sizeof(int32_t));
    Kernel.setArg(0, All);
    Kernel.setArg(1, Greatest);
    Kernel.setArg(2, Sum);
    Kernel.setArg(3, OfGroup);
    Device.run(Kernel, Items, Size);
    EXPECT_EQ(Device.download<int32_t>(All, 1)[0], static_cast<int>(Items));
    EXPECT_EQ(Device.download<uint32_t>(Greatest, 1)[0], Items - 1);
    EXPECT_EQ(Device.download<float>(Sum, 1)[0],
              static_cast<float>(Items) / 2.0F);
    EXPECT_EQ(Device.download<int32_t>(OfGroup, Items),
              std::vector<int32_t>(Items, static_cast<int32_t>(Size) + 5));
  }
}

} // namespace
