/// How a program opens the devices with options of its own, and how it is told
/// of what goes wrong.

#include "TestDevice.h"

#include <CL/cl_vorion.h>

#include <array>
#include <mutex>
#include <string>
#include <vector>

namespace {

/// The first platform that has the extension; its devices are not open yet.
class Platform : public testing::Test {
protected:
  void SetUp() override {
    std::vector<cl::Platform> All;
    cl::Platform::get(&All);
    for (const cl::Platform &P : All) {
      Open = reinterpret_cast<clOpenDevicesVORION_fn>(
          clGetExtensionFunctionAddressForPlatform(P(), "clOpenDevicesVORION"));
      Chosen = P;
      if (Open)
        return;
    }
    GTEST_SKIP() << "no Vorion platform: source scripts/env.sh";
  }

  cl_int open(const std::vector<cl_option_vorion> &Options) {
    return Open(Chosen(), static_cast<cl_uint>(Options.size()), Options.data(),
                Problem.size(), Problem.data());
  }
  cl::Device device() const {
    std::vector<cl::Device> Devices;
    Chosen.getDevices(CL_DEVICE_TYPE_ALL, &Devices);
    return Devices.at(0);
  }

  cl::Platform Chosen;
  clOpenDevicesVORION_fn Open = nullptr;
  std::array<char, 256> Problem{};
};

TEST_F(Platform, OptionsOpenAnotherMachineAndWrongOnesSayWhy) {
  const auto Said = [&] { return std::string(Problem.data()); };
  EXPECT_EQ(open({{"VORION_CLOCK", "on"}}), CL_INVALID_VALUE);
  EXPECT_NE(Said().find("no option 'VORION_CLOCK'"), std::string::npos)
      << Said();
  EXPECT_EQ(open({{"VORION_SET", "core=2"}}), CL_DEVICE_NOT_AVAILABLE);
  EXPECT_NE(Said().find("VORION_SET: unknown key 'core'"), std::string::npos)
      << Said();
  EXPECT_EQ(open({{"VORION_CONFIG", "/dev/null"}}), CL_INVALID_PROPERTY);
  EXPECT_NE(Said().find("an empty file"), std::string::npos) << Said();
  EXPECT_EQ(open({{"VORION_SET", nullptr}}), CL_INVALID_VALUE);
  EXPECT_EQ(Open(Chosen(), 1, nullptr, 0, nullptr), CL_INVALID_VALUE);

  ASSERT_EQ(open({{"VORION_SET", "clusters=2"}, {"VORION_TIME", "profiled"}}),
            CL_SUCCESS)
      << Said();
  EXPECT_EQ(device().getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>(), 16u);
  // Again the same, but nothing else while a context has them.
  {
    const cl::Context Context(device());
    EXPECT_EQ(open({{"VORION_SET", "clusters=2"}, {"VORION_TIME", "profiled"}}),
              CL_SUCCESS);
    EXPECT_EQ(open({}), CL_INVALID_OPERATION);
    EXPECT_NE(Said().find("other options"), std::string::npos) << Said();
  }
}

// As a loader does that looks for devices before a program opens them.
TEST_F(Platform, DevicesWithoutAContextAreOpenedAnew) {
  ASSERT_EQ(open({}), CL_SUCCESS) << Problem.data();
  EXPECT_EQ(device().getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>(), 8u);
  EXPECT_EQ(open({{"VORION_SET", "core=2"}}), CL_DEVICE_NOT_AVAILABLE);
  // Without a machine there is no device, until one opens.
  std::vector<cl::Device> Found;
  Chosen.getDevices(CL_DEVICE_TYPE_ALL, &Found);
  EXPECT_TRUE(Found.empty());
  ASSERT_EQ(open({{"VORION_SET", "clusters=2"}, {"VORION_TIME", "profiled"}}),
            CL_SUCCESS)
      << Problem.data();
  EXPECT_EQ(device().getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>(), 16u);
}

// The devices are as the test before has opened them, with the clock.
TEST_F(Platform, AProfiledKernelTakesTheMachinesTime) {
  const cl::Device Device = device();
  const cl::Context Context(Device);
  const cl::CommandQueue Queue(Context, Device, CL_QUEUE_PROFILING_ENABLE);
  cl::Program Program(Context, R"(
kernel void turns(global uint *p, uint n) {
  uint x = p[get_global_id(0)];
  for (uint i = 0; i < n; i++)
    x = x * 1664525u + i;
  p[get_global_id(0)] = x;
})");
  ASSERT_EQ(Program.build(), CL_SUCCESS);
  cl::Kernel Kernel(Program, "turns");
  const cl::Buffer Out(Context, CL_MEM_READ_WRITE, 64);
  Kernel.setArg(0, Out);
  const auto Nanoseconds = [&](cl_uint Turns) {
    cl::Event Done;
    Kernel.setArg(1, Turns);
    EXPECT_EQ(Queue.enqueueNDRangeKernel(Kernel, cl::NullRange, cl::NDRange(16),
                                         cl::NDRange(16), nullptr, &Done),
              CL_SUCCESS);
    EXPECT_EQ(Done.wait(), CL_SUCCESS);
    const auto At = [&](cl_profiling_info What) {
      cl_ulong Time = 0;
      EXPECT_EQ(
          clGetEventProfilingInfo(Done(), What, sizeof(Time), &Time, nullptr),
          CL_SUCCESS);
      return Time;
    };
    const cl_ulong Start = At(CL_PROFILING_COMMAND_START);
    EXPECT_LE(At(CL_PROFILING_COMMAND_QUEUED), At(CL_PROFILING_COMMAND_SUBMIT));
    EXPECT_LE(At(CL_PROFILING_COMMAND_SUBMIT), Start);
    return At(CL_PROFILING_COMMAND_END) - Start;
  };
  // No turn is faster than the three cycles of its multiplication, 5 ns.
  const cl_ulong Few = Nanoseconds(1000), Many = Nanoseconds(3000);
  EXPECT_GT(Few, 1000U * 5);
  EXPECT_GT(Many, 2 * Few);
  EXPECT_LT(Many, 4 * Few);
}

/// What a context's function is told.
struct Notification {
  std::mutex Lock;
  std::string Text;
  cl_int Status = CL_SUCCESS;

  static void CL_CALLBACK receive(const char *Text, const void *Status,
                                  std::size_t Bytes, void *Data) {
    auto &T = *static_cast<Notification *>(Data);
    const std::lock_guard Held(T.Lock);
    T.Text = Text;
    if (Bytes == sizeof(T.Status))
      T.Status = *static_cast<const cl_int *>(Status);
  }
};

TEST_F(Platform, AContextsFunctionIsToldOfATrapAndNothingIsPrinted) {
  Notification T;
  const cl::Device Device = device();
  const cl::Context Context(Device, nullptr, Notification::receive, &T);
  const cl::CommandQueue Queue(Context, Device);
  cl::Program Program(Context,
                      "kernel void fault(int x) { *(global int *)8 = x; }");
  ASSERT_EQ(Program.build(), CL_SUCCESS);
  cl::Kernel Kernel(Program, "fault");
  ASSERT_EQ(Kernel.setArg(0, 1), CL_SUCCESS);
  testing::internal::CaptureStderr();
  cl::Event Done;
  EXPECT_EQ(Queue.enqueueNDRangeKernel(Kernel, cl::NullRange, cl::NDRange(16),
                                       cl::NDRange(16), nullptr, &Done),
            CL_SUCCESS);
  EXPECT_NE(Done.wait(), CL_SUCCESS);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  const std::lock_guard Held(T.Lock);
  EXPECT_EQ(T.Text.substr(0, 13), "kernel fault:") << T.Text;
  EXPECT_EQ(T.Status, Done.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>());
}

} // namespace
