/// What becomes of commands that depend on one that failed: they fail with the
/// standard's code, and whoever asks is told.

#include "TestDevice.h"

#include <CL/cl_vorion.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

using vorion::test::TestDevice;

namespace {

constexpr cl_int DependencyFailed =
    CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST;

constexpr const char *Source = R"(
kernel void fault(global int *p) { *(global int *)8 = 1; }
kernel void fine(global int *p) { p[get_global_id(0)] = 42; }
)";

/// A device with a kernel that traps and one that does not.
class Events : public testing::Test {
protected:
  void SetUp() override {
    VORION_REQUIRE_DEVICE(Device);
    Program = Device.build(Source);
    Data = Device.upload(std::vector<int32_t>(16));
    testing::internal::CaptureStderr(); // the traps' reports
  }
  void TearDown() override {
    if (Device.usable())
      testing::internal::GetCapturedStderr();
  }

  cl::Event start(const cl::CommandQueue &Queue, const char *Kernel,
                  const std::vector<cl::Event> &After = {}) {
    cl::Kernel K(Program, Kernel);
    EXPECT_EQ(K.setArg(0, Data), CL_SUCCESS);
    cl::Event Done;
    EXPECT_EQ(Queue.enqueueNDRangeKernel(K, cl::NullRange, cl::NDRange(16),
                                         cl::NDRange(16), &After, &Done),
              CL_SUCCESS);
    return Done;
  }
  cl_int read(const cl::CommandQueue &Queue,
              const std::vector<cl::Event> &After = {}) {
    return Queue.enqueueReadBuffer(Data, CL_TRUE, 0, 64, Words.data(), &After);
  }
  static cl_int statusOf(const cl::Event &Event) {
    return Event.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>();
  }
  cl::CommandQueue outOfOrder() {
    return cl::CommandQueue(Device.context(), cl::QueueProperties::OutOfOrder);
  }

  const TestDevice Device;
  cl::Program Program;
  cl::Buffer Data;
  std::vector<int32_t> Words = std::vector<int32_t>(16);
};

TEST_F(Events, ABlockingReadAfterATrapFails) {
  start(Device.queue(), "fault");
  EXPECT_EQ(read(Device.queue()), DependencyFailed);
  // Notification of it, the host may go on with the queue.
  start(Device.queue(), "fine");
  EXPECT_EQ(read(Device.queue()), CL_SUCCESS);
  EXPECT_EQ(Words, std::vector<int32_t>(16, 42));
}

/// clFinish has no code for it, so whether the trap was over when the read was
/// enqueued must not matter.
TEST_F(Events, ABlockingReadAfterATrapAndFinishFails) {
  start(Device.queue(), "fault");
  EXPECT_EQ(Device.queue().finish(), CL_SUCCESS);
  EXPECT_EQ(read(Device.queue()), DependencyFailed);
}

TEST_F(Events, EveryBlockingCommandFails) {
  const cl::CommandQueue &Queue = Device.queue();
  const cl::array<cl::size_type, 3> Origin = {0, 0, 0}, Region = {4, 4, 1};
  const auto AfterATrap = [&] {
    start(Queue, "fault");
    EXPECT_EQ(Queue.finish(), CL_SUCCESS);
  };
  AfterATrap();
  EXPECT_EQ(Queue.enqueueWriteBuffer(Data, CL_TRUE, 0, 64, Words.data()),
            DependencyFailed);
  AfterATrap();
  EXPECT_EQ(Queue.enqueueReadBufferRect(Data, CL_TRUE, Origin, Origin, Region,
                                        0, 0, 0, 0, Words.data()),
            DependencyFailed);
  AfterATrap();
  EXPECT_EQ(Queue.enqueueWriteBufferRect(Data, CL_TRUE, Origin, Origin, Region,
                                         0, 0, 0, 0, Words.data()),
            DependencyFailed);
  AfterATrap();
  cl_int Status = CL_SUCCESS;
  EXPECT_EQ(Queue.enqueueMapBuffer(Data, CL_TRUE, CL_MAP_READ, 0, 64, nullptr,
                                   nullptr, &Status),
            nullptr);
  EXPECT_EQ(Status, DependencyFailed);
  EXPECT_EQ(Data.getInfo<CL_MEM_MAP_COUNT>(), 0U)
      << "a mapping that failed is none";
  EXPECT_EQ(read(Queue), CL_SUCCESS);
}

TEST_F(Events, WhatFollowsInAnInOrderQueueFails) {
  const cl::Event Trap = start(Device.queue(), "fault");
  const cl::Event Second = start(Device.queue(), "fine");
  EXPECT_EQ(Device.queue().finish(), CL_SUCCESS);
  const cl::Event Third = start(Device.queue(), "fine");
  EXPECT_EQ(Third.wait(), DependencyFailed);
  EXPECT_LT(statusOf(Trap), 0);
  EXPECT_NE(statusOf(Trap), DependencyFailed) << "it failed by itself";
  EXPECT_EQ(statusOf(Second), DependencyFailed);
  EXPECT_EQ(statusOf(Third), DependencyFailed);
}

/// Notification of the first failure alone, the host does not know of the
/// second.
TEST_F(Events, AFailureThatWasNotToldStays) {
  const cl::Event Trap = start(Device.queue(), "fault");
  const cl::Event Second = start(Device.queue(), "fine");
  EXPECT_EQ(Trap.wait(), DependencyFailed);
  EXPECT_EQ(read(Device.queue()), DependencyFailed);
  EXPECT_EQ(read(Device.queue()), CL_SUCCESS);
}

TEST_F(Events, AnotherQueueIsNotConcerned) {
  const cl::CommandQueue Other(Device.context());
  const cl::Event Trap = start(Device.queue(), "fault");
  EXPECT_EQ(Device.queue().finish(), CL_SUCCESS);
  start(Other, "fine");
  EXPECT_EQ(read(Other), CL_SUCCESS);
  EXPECT_EQ(read(Other, {Trap}), DependencyFailed) << "unless it waits for it";
}

TEST_F(Events, WaitListsWithAFailedEventFail) {
  const cl::CommandQueue Queue = outOfOrder();
  const cl::Event Trap = start(Queue, "fault");
  EXPECT_EQ(Trap.wait(), DependencyFailed);
  const cl::Event Before = start(Queue, "fine", {Trap});
  EXPECT_EQ(Before.wait(), DependencyFailed);
  EXPECT_EQ(statusOf(Before), DependencyFailed);
  EXPECT_EQ(read(Queue, {Before}), DependencyFailed) << "at second hand";
  const cl::Event Free = start(Queue, "fine");
  EXPECT_EQ(Free.wait(), CL_SUCCESS) << "nothing orders it";
}

TEST_F(Events, BarriersPassAFailureOn) {
  const cl::CommandQueue Queue = outOfOrder();
  start(Queue, "fault");
  EXPECT_EQ(Queue.finish(), CL_SUCCESS);
  cl::Event Barrier;
  EXPECT_EQ(Queue.enqueueBarrierWithWaitList(nullptr, &Barrier), CL_SUCCESS);
  EXPECT_EQ(Queue.finish(), CL_SUCCESS);
  EXPECT_EQ(statusOf(Barrier), DependencyFailed);
  EXPECT_EQ(read(Queue), DependencyFailed);
  EXPECT_EQ(read(Queue), CL_SUCCESS);
}

TEST_F(Events, AUserEventFailsWhatWaitsForIt) {
  const cl::CommandQueue Queue = outOfOrder();
  cl::UserEvent User(Device.context());
  const cl::Event Waiting = start(Queue, "fine", {User});
  const cl::Event Next = start(Queue, "fine", {Waiting});
  EXPECT_GT(statusOf(Waiting), 0);
  EXPECT_EQ(User.setStatus(-7), CL_SUCCESS);
  EXPECT_EQ(User.setStatus(CL_COMPLETE), CL_INVALID_OPERATION);
  EXPECT_EQ(Next.wait(), DependencyFailed);
  EXPECT_EQ(statusOf(Waiting), DependencyFailed);
  EXPECT_EQ(statusOf(User), -7);
  EXPECT_EQ(User.wait(), DependencyFailed);
  EXPECT_EQ(read(Queue, {User}), DependencyFailed) << "when it failed before";
}

/// The blocking command alone is waited for.
TEST_F(Events, ABlockingReadDoesNotWaitForWhatItDoesNotDependOn) {
  const cl::CommandQueue Queue = outOfOrder();
  cl::UserEvent User(Device.context());
  const cl::Event Waiting = start(Queue, "fine", {User});
  EXPECT_EQ(read(Queue), CL_SUCCESS);
  EXPECT_EQ(User.setStatus(CL_COMPLETE), CL_SUCCESS);
  EXPECT_EQ(Waiting.wait(), CL_SUCCESS);
}

TEST_F(Events, WaitingIsForAllEventsEvenIfOneFailed) {
  const cl::CommandQueue Queue = outOfOrder();
  cl::UserEvent User(Device.context());
  const std::vector<cl::Event> All = {start(Queue, "fault"), User};
  std::thread Setter([&User] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(User.setStatus(CL_COMPLETE), CL_SUCCESS);
  });
  EXPECT_EQ(cl::Event::waitForEvents(All), DependencyFailed);
  EXPECT_EQ(statusOf(User), CL_COMPLETE);
  Setter.join();
}

struct Notification {
  std::atomic<int> Calls{0};
  std::atomic<cl_int> Status{1000};
};
void CL_CALLBACK tell(cl_event /*Event*/, cl_int Status, void *Data) {
  auto *T = static_cast<Notification *>(Data);
  T->Status = Status;
  ++T->Calls;
}

TEST_F(Events, CallbacksAreToldTheFailureOnce) {
  cl::UserEvent Gate(Device.context());
  const cl::CommandQueue Queue = outOfOrder();
  cl::Event Trap = start(Queue, "fault", {Gate});
  cl::Event After = start(Queue, "fine", {Trap});
  Notification Running, Complete, Dependent, Late;
  EXPECT_EQ(Trap.setCallback(CL_RUNNING, tell, &Running), CL_SUCCESS);
  EXPECT_EQ(Trap.setCallback(CL_COMPLETE, tell, &Complete), CL_SUCCESS);
  EXPECT_EQ(After.setCallback(CL_RUNNING, tell, &Dependent), CL_SUCCESS);
  EXPECT_EQ(Gate.setStatus(CL_COMPLETE), CL_SUCCESS);
  EXPECT_EQ(Queue.finish(), CL_SUCCESS);
  EXPECT_EQ(Running.Calls, 1);
  EXPECT_EQ(Running.Status, CL_RUNNING);
  EXPECT_EQ(Complete.Calls, 1);
  EXPECT_EQ(Complete.Status, statusOf(Trap));
  EXPECT_LT(Complete.Status, 0);
  EXPECT_EQ(Dependent.Calls, 1) << "gone past CL_RUNNING without running";
  EXPECT_EQ(Dependent.Status, DependencyFailed);
  EXPECT_EQ(Trap.setCallback(CL_COMPLETE, tell, &Late), CL_SUCCESS);
  EXPECT_EQ(Late.Calls, 1);
  EXPECT_EQ(Late.Status, statusOf(Trap));
}

/// Each is failed by the worker, not inside the failing of the one before.
TEST_F(Events, ALongChainOfDependentsFails) {
  cl::UserEvent Gate(Device.context());
  const std::vector<cl::Event> First = {Gate};
  cl::Event Last;
  for (int I = 0; I < 20000; ++I)
    ASSERT_EQ(Device.queue().enqueueMarkerWithWaitList(
                  I == 0 ? &First : nullptr, &Last),
              CL_SUCCESS);
  EXPECT_EQ(Gate.setStatus(-1), CL_SUCCESS);
  EXPECT_EQ(Last.wait(), DependencyFailed);
}

TEST_F(Events, AnInvalidEventIsNamedSo) {
  cl_int Status = 0;
  EXPECT_EQ(clGetEventInfo(nullptr, CL_EVENT_COMMAND_EXECUTION_STATUS,
                           sizeof(Status), &Status, nullptr),
            CL_INVALID_EVENT);
}

} // namespace
