/// What launches wait for on a machine with DMA engines, whose clock is on: the
/// cycles with the reason `launch`.

#include "TestDevice.h"

#include <CL/cl_vorion.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

using vorion::test::TestDevice;

namespace {

constexpr const char *Source =
    "kernel void set(global int *p) { p[get_global_id(0)] = 42; }";

/// Of a copy of a MiB: 16,384 lines of 64 bytes at 3,282 MB/s, at 530 MHz.
constexpr uint64_t CopyCycles = 169'000;
/// Without a copy: a command that the host sends behind something that it has
/// seen.
constexpr uint64_t FewCycles = 1'000;

class CommandOrder : public testing::Test {
protected:
  void SetUp() override {
    VORION_REQUIRE_DEVICE(Device);
    Kernel = cl::Kernel(Device.build(Source), "set");
    Large = cl::Buffer(Device.context(), CL_MEM_READ_WRITE, Words.size() * 4);
    Small = Device.upload(std::vector<int32_t>(16));
    ASSERT_EQ(Kernel.setArg(0, Small), CL_SUCCESS);
    Info = reinterpret_cast<clGetEventInfoVORION_fn>(
        clGetExtensionFunctionAddressForPlatform(
            cl::Platform(Device.queue()
                             .getInfo<CL_QUEUE_DEVICE>()
                             .getInfo<CL_DEVICE_PLATFORM>())(),
            "clGetEventInfoVORION"));
    ASSERT_NE(Info, nullptr);
    waited(Device.queue()); // the first command of the device
    ASSERT_EQ(Device.queue().finish(), CL_SUCCESS);
  }

  cl::CommandQueue queue(bool OutOfOrder = false) {
    return cl::CommandQueue(Device.context(),
                            OutOfOrder ? cl::QueueProperties::OutOfOrder
                                       : cl::QueueProperties::None);
  }
  cl::Event write(const cl::CommandQueue &Queue) {
    cl::Event Done;
    EXPECT_EQ(Queue.enqueueWriteBuffer(Large, CL_FALSE, 0, Words.size() * 4,
                                       Words.data(), nullptr, &Done),
              CL_SUCCESS);
    return Done;
  }
  /// Cycles that a launch waited for its start, if it starts behind \p After.
  uint64_t waited(const cl::CommandQueue &Queue,
                  const std::vector<cl::Event> &After = {}) {
    cl::Event Done;
    EXPECT_EQ(Queue.enqueueNDRangeKernel(Kernel, cl::NullRange, cl::NDRange(16),
                                         cl::NDRange(16), &After, &Done),
              CL_SUCCESS);
    EXPECT_EQ(Done.wait(), CL_SUCCESS);
    std::size_t Size = 0;
    EXPECT_EQ(Info(Done(), CL_EVENT_TIME_REPORT_VORION, 0, nullptr, &Size),
              CL_SUCCESS);
    std::string Report(Size, '\0');
    EXPECT_EQ(
        Info(Done(), CL_EVENT_TIME_REPORT_VORION, Size, Report.data(), nullptr),
        CL_SUCCESS);
    const std::string Key = "\"launch\":";
    const std::size_t At = Report.find(Key);
    EXPECT_NE(At, std::string::npos) << Report;
    return std::strtoull(Report.c_str() + At + Key.size(), nullptr, 10);
  }

  TestDevice Device;
  cl::Kernel Kernel;
  cl::Buffer Large, Small;
  clGetEventInfoVORION_fn Info = nullptr;
  std::vector<int32_t> Words = std::vector<int32_t>(1 << 18);
};

TEST_F(CommandOrder, AQueueInOrderWaitsForTheCommandBefore) {
  const cl::CommandQueue Queue = queue();
  write(Queue).wait();
  EXPECT_GT(waited(Queue), CopyCycles);
  EXPECT_LT(waited(Queue), FewCycles);
}

TEST_F(CommandOrder, OtherQueuesGoOn) {
  write(queue()).wait();
  EXPECT_LT(waited(queue()), FewCycles);
}

TEST_F(CommandOrder, AnEventIsWaitedForThoughItHasEnded) {
  const cl::Event Written = write(queue());
  Written.wait();
  EXPECT_GT(waited(queue(), {Written}), CopyCycles);
}

TEST_F(CommandOrder, AQueueOutOfOrderWaitsForEventsAndBarriers) {
  const cl::CommandQueue Queue = queue(/*OutOfOrder=*/true);
  cl::Event Written = write(Queue);
  Written.wait();
  EXPECT_LT(waited(Queue), FewCycles);
  EXPECT_EQ(Queue.finish(), CL_SUCCESS);
  Written = write(Queue);
  EXPECT_EQ(Queue.enqueueBarrierWithWaitList(), CL_SUCCESS);
  Written.wait();
  EXPECT_GT(waited(Queue), CopyCycles);
}

TEST_F(CommandOrder, TheHostWaitsForWhatItReads) {
  EXPECT_LT(waited(queue()), 10U);
  EXPECT_EQ(Device.download<int32_t>(Small, 16)[3], 42);
  // There and back again: more than four times 300 ns.
  const uint64_t Cycles = waited(queue());
  EXPECT_GT(Cycles, 4 * 300 * 530 / 1000U);
  EXPECT_LT(Cycles, FewCycles);
}

TEST_F(CommandOrder, FinishEndsCopies) {
  const cl::CommandQueue Queue = queue();
  write(Queue);
  EXPECT_EQ(Queue.finish(), CL_SUCCESS);
  EXPECT_LT(waited(Queue), 10U);
}

} // namespace
