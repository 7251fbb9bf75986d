/// How a host program's kernels are started, what they are given, and what is
/// known of them afterwards.

#include "TestDevice.h"

#include <CL/cl_vorion.h>

#include <cstdint>
#include <cstring>

using vorion::test::TestDevice;

namespace {

using U = uint32_t;

TEST(Launches, ARangeWithoutItemsIsDone) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program =
      Device.build("kernel void f(global int *o) { o[0] = 1; }");
  const cl::Buffer Out = Device.upload(std::vector<int32_t>{0});
  cl::Kernel K(Program, "f");
  K.setArg(0, Out);
  for (const cl::NDRange &Range : {cl::NDRange(0), cl::NDRange(4, 0),
                                   cl::NDRange(0, 4), cl::NDRange(4, 4, 0)}) {
    Device.run(K, Range, cl::NullRange);
  }
  EXPECT_EQ(Device.download<int32_t>(Out, 1)[0], 0);
}

TEST(Launches, ArgumentsOfAllKindsArrive) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
typedef struct { char c; float f; long l; int4 v; } mixed;
constant int table[4] = {10, 20, 30, 40};
kernel void take(char c, global int *out, mixed m, local int *a, float3 v,
                 local long *b, ulong u, constant int *k, global int *null) {
  size_t i = get_local_id(0);
  a[i] = c;
  b[i] = u;
  barrier(CLK_LOCAL_MEM_FENCE);
  m.v.w += i; // a work-item's own copy
  out[8 * i + 0] = a[15 - i];
  out[8 * i + 1] = m.c + (int)m.f;
  out[8 * i + 2] = (int)(m.l >> 32);
  out[8 * i + 3] = m.v.w;
  out[8 * i + 4] = (int)(v.x + v.y * 10 + v.z * 100);
  out[8 * i + 5] = (int)(b[15 - i] >> 40);
  out[8 * i + 6] = k[1] + table[i & 3];
  out[8 * i + 7] = null == 0;
})");
  struct alignas(16) {
    char C = 3;
    float F = 4.5F;
    int64_t L = int64_t{77} << 32;
    alignas(16) int32_t V[4] = {1, 2, 3, 4};
  } Mixed;
  static_assert(sizeof(Mixed) == 32);
  const cl_float3 Vector = {{1, 2, 3, 0}};
  const cl::Buffer Out = Device.upload(std::vector<int32_t>(8 * 16));
  const cl::Buffer Table = Device.upload(std::vector<int32_t>{5, 6});
  cl::Kernel K(Program, "take");
  K.setArg(0, cl_char{-7});
  K.setArg(1, Out);
  K.setArg(2, sizeof(Mixed), &Mixed);
  K.setArg(3, cl::Local(16 * 4));
  K.setArg(4, Vector);
  K.setArg(5, cl::Local(16 * 8));
  K.setArg(6, cl_ulong{9} << 40);
  K.setArg(7, Table);
  K.setArg(8, sizeof(cl_mem), nullptr);
  Device.run(K, 16, 16);
  const auto Got = Device.download<int32_t>(Out, 8 * 16);
  for (int I = 0; I < 16; ++I) {
    const std::vector<int32_t> Want = {
        -7, 7, 77, 4 + I, 321, 9, 6 + 10 * (I % 4 + 1), 1};
    EXPECT_EQ(std::vector(Got.begin() + 8 * I, Got.begin() + 8 * I + 8), Want)
        << "work-item " << I;
  }
}

/// With more work-items than lanes, changes of one must not reach the next.
TEST(Launches, AStructureByValueBelongsToTheWorkItem) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
typedef struct { int a[4]; } numbers;
kernel void change(numbers n, global int *out) {
  size_t i = get_global_id(0);
  n.a[i & 3] += i;
  barrier(CLK_LOCAL_MEM_FENCE);
  out[i] = n.a[0] + n.a[1] + n.a[2] + n.a[3];
})");
  const int32_t Numbers[4] = {1, 2, 3, 4};
  const cl::Buffer Out = Device.upload(std::vector<int32_t>(100));
  cl::Kernel K(Program, "change");
  K.setArg(0, sizeof(Numbers), Numbers);
  K.setArg(1, Out);
  Device.run(K, 100, 50);
  const auto Got = Device.download<int32_t>(Out, 100);
  for (int I = 0; I < 100; ++I)
    EXPECT_EQ(Got[I], 10 + I);
}

TEST(Launches, StaticLocalMemoryLiesBesideArguments) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
kernel void both(global int *out, local int *given) {
  local int own[40];
  local char flag;
  size_t l = get_local_id(0);
  own[l] = l;
  given[l] = 100 + l;
  if (l == 0)
    flag = 7;
  barrier(CLK_LOCAL_MEM_FENCE);
  out[get_global_id(0)] = own[39 - l] * 1000 + given[39 - l] + flag;
})");
  const cl::Buffer Out = Device.upload(std::vector<int32_t>(400));
  cl::Kernel K(Program, "both");
  K.setArg(0, Out);
  K.setArg(1, cl::Local(160));
  Device.run(K, 400, 40);
  const auto Got = Device.download<int32_t>(Out, 400);
  for (int I = 0; I < 400; ++I)
    EXPECT_EQ(Got[I], (39 - I % 40) * 1001 + 107);
}

TEST(Launches, AtomicsCountEveryWorkItem) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
kernel void count(global int *g, local int *t) {
  int i = get_global_id(0);
  if (get_local_id(0) == 0)
    *t = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  int before = atomic_add(t, 2);
  atomic_inc(&g[0]);
  atomic_max(&g[1], i);
  atomic_min(&g[2], -i);
  atomic_xor(&g[3], i);
  atomic_or(&g[4], 1 << (i & 31));
  atomic_and(&g[5], ~(1 << (i & 15)));
  if (i % 3 == 0)
    atomic_dec(&g[6]);
  if (atomic_cmpxchg(&g[7], 0, i + 1) == 0)
    atomic_add(&g[8], 1);
  atomic_add(&g[10], before);
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) == 0)
    atomic_add(&g[9], *t);
})");
  std::vector<int32_t> Start(11, 0);
  Start[5] = -1;
  const cl::Buffer Counters = Device.upload(Start);
  cl::Kernel K(Program, "count");
  K.setArg(0, Counters);
  K.setArg(1, cl::Local(4));
  Device.run(K, 1000, 100);
  const auto Got = Device.download<int32_t>(Counters, 11);
  int32_t Xor = 0;
  for (int I = 0; I < 1000; ++I)
    Xor ^= I;
  EXPECT_EQ(Got[0], 1000);
  EXPECT_EQ(Got[1], 999);
  EXPECT_EQ(Got[2], -999);
  EXPECT_EQ(Got[3], Xor);
  EXPECT_EQ(Got[4], -1);
  EXPECT_EQ(Got[5], ~0xffff);
  EXPECT_EQ(Got[6], -334);
  EXPECT_NE(Got[7], 0);
  EXPECT_EQ(Got[8], 1) << "compare-and-exchange let several in";
  EXPECT_EQ(Got[9], 2000);
  EXPECT_EQ(Got[10], 10 * 2 * 99 * 100 / 2) << "every old value once";
}

/// -ffp-contract=off is the rule for all paths that are compared (docs/abi.md).
TEST(Launches, ProductsAndSumsRoundOneByOne) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
kernel void two(global const float *a, global float *out) {
  out[0] = a[0] * a[1] + a[2];
  out[1] = fma(a[0], a[1], a[2]);
})");
  // (1 + e)^2 - 1 with e = 2^-23: the product's last bit is lost by rounding.
  const float A = 1 + 0x1p-23F;
  const cl::Buffer In = Device.upload(std::vector<float>{A, A, -1});
  const cl::Buffer Out = Device.upload(std::vector<float>(2));
  cl::Kernel K(Program, "two");
  K.setArg(0, In);
  K.setArg(1, Out);
  Device.run(K, 1, 1);
  EXPECT_EQ(Device.download<float>(Out, 2),
            (std::vector<float>{0x1p-22F, 0x1p-22F + 0x1p-46F}));
}

TEST(Launches, OffsetsAndUnevenGridsReachTheIds) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
kernel void ids(global uint *out) {
  size_t x = get_global_id(0) - get_global_offset(0);
  size_t y = get_global_id(1) - get_global_offset(1);
  out[y * get_global_size(0) + x] =
      get_global_id(0) | get_global_id(1) << 8 | get_num_groups(0) << 16 |
      get_work_dim() << 24;
})");
  const cl::Buffer Out = Device.upload(std::vector<U>(30 * 6));
  cl::Kernel K(Program, "ids");
  K.setArg(0, Out);
  ASSERT_EQ(Device.queue().enqueueNDRangeKernel(
                K, cl::NDRange(5, 3), cl::NDRange(30, 6), cl::NDRange(10, 3)),
            CL_SUCCESS);
  const auto Got = Device.download<U>(Out, 30 * 6);
  for (U Y = 0; Y < 6; ++Y)
    for (U X = 0; X < 30; ++X)
      ASSERT_EQ(Got[Y * 30 + X], (X + 5) | (Y + 3) << 8 | 3U << 16 | 2U << 24);
}

TEST(Launches, AFaultFailsItsEventAndTheDeviceGoesOn) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
kernel void fault(global int *out) { out[0] = *(global int *)8; }
kernel void fine(global int *out) { out[get_global_id(0)] = 42; })");
  const cl::Buffer Out = Device.upload(std::vector<int32_t>(8));
  cl::Kernel Fault(Program, "fault"), Fine(Program, "fine");
  Fault.setArg(0, Out);
  Fine.setArg(0, Out);
  cl::Event Failed;
  testing::internal::CaptureStderr();
  ASSERT_EQ(Device.queue().enqueueNDRangeKernel(Fault, cl::NullRange,
                                                cl::NDRange(8), cl::NDRange(8),
                                                nullptr, &Failed),
            CL_SUCCESS);
  EXPECT_NE(Failed.wait(), CL_SUCCESS);
  const std::string Report = testing::internal::GetCapturedStderr();
  EXPECT_LT(Failed.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>(), 0);
  EXPECT_NE(Report.find("kernel fault"), std::string::npos) << Report;
  EXPECT_NE(Report.find("0x00000008"), std::string::npos) << Report;
  EXPECT_NE(Report.find("<source>:2 in fault"), std::string::npos) << Report;

  Device.run(Fine, 8, 8);
  EXPECT_EQ(Device.download<int32_t>(Out, 8), std::vector<int32_t>(8, 42));
}

TEST(Launches, KernelsSeeTheMachine) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
#ifndef __VORION__
#error "__VORION__ is not defined"
#endif
#include <vorion.h>
kernel void ask(global uint *out) {
  out[get_global_id(0)] = vx_num_threads() * 1000 + vx_thread_id();
})");
  const cl::Buffer Out = Device.upload(std::vector<U>(16));
  cl::Kernel K(Program, "ask");
  K.setArg(0, Out);
  Device.run(K, 16, 16);
  const auto Got = Device.download<U>(Out, 16);
  for (U I = 0; I < 16; ++I)
    EXPECT_EQ(Got[I], 16000 + I);
}

TEST(Counters, TellWhatOneKernelDid) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Platform Platform(Device.context()
                                  .getInfo<CL_CONTEXT_DEVICES>()[0]
                                  .getInfo<CL_DEVICE_PLATFORM>());
  const auto GetInfo = reinterpret_cast<clGetEventInfoVORION_fn>(
      clGetExtensionFunctionAddressForPlatform(Platform(),
                                               "clGetEventInfoVORION"));
  ASSERT_NE(GetInfo, nullptr);
  const cl::Program Program = Device.build(
      "kernel void one(global int *o) { o[get_global_id(0)] = 1; }");
  const cl::Buffer Out = Device.upload(std::vector<int32_t>(160));
  cl::Kernel K(Program, "one");
  K.setArg(0, Out);
  const auto Count = [&](std::size_t Items, cl_uint Name) {
    cl::Event Done;
    EXPECT_EQ(Device.queue().enqueueNDRangeKernel(
                  K, cl::NullRange, cl::NDRange(Items), cl::NDRange(16),
                  nullptr, &Done),
              CL_SUCCESS);
    EXPECT_EQ(Done.wait(), CL_SUCCESS);
    cl_ulong Value = ~cl_ulong{0};
    std::size_t Size = 0;
    EXPECT_EQ(GetInfo(Done(), Name, sizeof(Value), &Value, &Size), CL_SUCCESS);
    EXPECT_EQ(Size, sizeof(Value));
    EXPECT_EQ(GetInfo(Done(), 0x1234, sizeof(Value), &Value, nullptr),
              CL_INVALID_VALUE);
    EXPECT_EQ(GetInfo(Done(), Name, 4, &Value, nullptr), CL_INVALID_VALUE);
    return Value;
  };
  const cl_ulong Few = Count(16, CL_EVENT_WARP_INSTRUCTIONS_VORION);
  const cl_ulong Many = Count(160, CL_EVENT_WARP_INSTRUCTIONS_VORION);
  EXPECT_GT(Few, 0U);
  EXPECT_GT(Many, Few);
  EXPECT_EQ(Count(160, CL_EVENT_WARP_INSTRUCTIONS_VORION), Many)
      << "the same work, the same count";
  EXPECT_GT(Count(160, CL_EVENT_LANE_INSTRUCTIONS_VORION), Many);
  EXPECT_EQ(Count(160, CL_EVENT_RASTER_BLENDS_VORION), 0U);

  cl::Event Copy;
  int32_t Value = 0;
  Device.queue().enqueueReadBuffer(Out, CL_TRUE, 0, 4, &Value, nullptr, &Copy);
  cl_ulong Unused = 0;
  EXPECT_EQ(
      GetInfo(Copy(), CL_EVENT_WARP_INSTRUCTIONS_VORION, 8, &Unused, nullptr),
      CL_INVALID_EVENT);
}

} // namespace
