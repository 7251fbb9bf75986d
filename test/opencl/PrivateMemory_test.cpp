/// Private memory: a launch gets the stacks that its kernel needs, or fails.

#include "TestDevice.h"

#include <cstdint>

using vorion::test::TestDevice;

namespace {

/// Fills an array and counts, from 1 on, what it then finds changed.
constexpr const char *Source = R"(
kernel void fill(global int *o, int n) {
  int a[N], bad = 1;
  const int g = get_global_id(0);
  for (int i = 0; i < n; i += STEP)
    a[i] = i * 3 + g;
  for (int i = 0; i < n; i += STEP)
    bad += a[i] != i * 3 + g;
  o[g] = bad;
}
kernel void kept(global int *o, int n) {
  int a[N], bad = 1;
  const int g = get_global_id(0);
  for (int i = 0; i < n; i += STEP)
    a[i] = i * 3 + g;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int i = 0; i < n; i += STEP)
    bad += a[i] != i * 3 + g;
  o[g] = bad;
}
kernel void plain(global int *o, int n) { o[get_global_id(0)] = n; }
)";

class PrivateMemory : public testing::Test {
protected:
  static constexpr unsigned Items = 256;

  void build(int Words) {
    const std::string Options = "-DN=" + std::to_string(Words) +
                                " -DSTEP=" + std::to_string(Words / 200 + 1);
    Program = Device.build(Source, Options.c_str());
    N = Words;
  }
  /// The kernel's event's status.
  cl_int run(const char *Name, unsigned Local) {
    cl::Kernel K(Program, Name);
    K.setArg(0, Out);
    K.setArg(1, N);
    cl::Event Done;
    EXPECT_EQ(Device.queue().enqueueNDRangeKernel(K, cl::NullRange, Items,
                                                  Local, nullptr, &Done),
              CL_SUCCESS);
    Done.wait();
    return Done.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>();
  }
  cl_ulong privateBytes(const char *Name) {
    return cl::Kernel(Program, Name)
        .getWorkGroupInfo<CL_KERNEL_PRIVATE_MEM_SIZE>(
            Device.queue().getInfo<CL_QUEUE_DEVICE>());
  }
  void expectOnes() {
    EXPECT_EQ(Device.download<int32_t>(Out, Items),
              std::vector<int32_t>(Items, 1));
  }

  const TestDevice Device;
  cl::Buffer Out = Device.usable() ? Device.upload(std::vector<int32_t>(Items))
                                   : cl::Buffer();
  cl::Program Program;
  int32_t N = 0;
};

TEST_F(PrivateMemory, LaunchesGetWhatTheyNeed) {
  VORION_REQUIRE_DEVICE(Device);
  for (const int Words : {256, 14000, 16640, 25600, 524288}) {
    build(Words);
    for (const unsigned Local : {16, 32, 128}) {
      EXPECT_EQ(run("fill", Local), CL_COMPLETE) << Words << " " << Local;
      expectOnes();
    }
    EXPECT_EQ(run("plain", 64), CL_COMPLETE) << Words;
  }
  build(6000);
  EXPECT_EQ(run("kept", 64), CL_COMPLETE);
  expectOnes();
}

TEST_F(PrivateMemory, ALaunchWithoutRoomFails) {
  VORION_REQUIRE_DEVICE(Device);
  build(4 << 20); // 16 MiB
  EXPECT_EQ(run("fill", 16), CL_OUT_OF_RESOURCES);
  Device.queue().finish();
  EXPECT_EQ(run("plain", 16), CL_COMPLETE);
  // 128 MiB for each work-item of a group, which are more than 2 GiB.
  EXPECT_EQ(run("kept", 256), CL_OUT_OF_RESOURCES);
  Device.queue().finish();
  EXPECT_EQ(run("plain", 16), CL_COMPLETE);
}

TEST_F(PrivateMemory, LargeStacksNeedFreeMemory) {
  VORION_REQUIRE_DEVICE(Device);
  build(1'800'000); // stacks of 8 MiB: 1 GiB for 8 cores
  EXPECT_EQ(run("fill", 16), CL_COMPLETE);
  expectOnes();
  {
    const cl_uchar Zero = 0;
    std::vector<cl::Buffer> Large;
    for (int I = 0; I != 3; ++I) {
      Large.emplace_back(Device.context(), CL_MEM_READ_WRITE, 1200U << 20);
      Device.queue().enqueueFillBuffer(Large.back(), Zero, 0, 16);
    }
    EXPECT_EQ(run("fill", 16), CL_OUT_OF_RESOURCES);
    Device.queue().finish();
    EXPECT_EQ(run("plain", 16), CL_COMPLETE);
  }
  EXPECT_EQ(run("fill", 16), CL_COMPLETE);
  expectOnes();
}

TEST_F(PrivateMemory, VariablesOfProgramScopeAreNotInTheWay) {
  VORION_REQUIRE_DEVICE(Device);
  Program = Device.build("global int count = 5;\n"
                         "kernel void plain(global int *o, int n) {"
                         "  o[get_global_id(0)] = count - 4; }" +
                             std::string(Source).replace(
                                 std::string(Source).find("kernel void plain"),
                                 17, "kernel void other"),
                         "-cl-std=CL3.0 -DN=100000 -DSTEP=100");
  N = 100000;
  EXPECT_EQ(run("plain", 16), CL_COMPLETE);
  expectOnes();
  EXPECT_EQ(run("fill", 16), CL_COMPLETE);
  expectOnes();
  EXPECT_EQ(run("plain", 16), CL_COMPLETE);
  expectOnes();
}

TEST_F(PrivateMemory, ItsSizeIsKnown) {
  VORION_REQUIRE_DEVICE(Device);
  for (const int Words : {256, 25600}) {
    const cl_ulong Array = 4 * Words;
    build(Words);
    for (const bool HasRun : {false, true}) {
      if (HasRun)
        run("fill", 16);
      EXPECT_GE(privateBytes("fill"), Array);
      EXPECT_LT(privateBytes("fill"), Array + 512);
    }
    EXPECT_GE(privateBytes("kept"), Array);
    EXPECT_LT(privateBytes("plain"), 512U);
  }
}

} // namespace
