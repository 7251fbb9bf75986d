/// A host program that ends while its commands still run.

#include "TestDevice.h"

#include <cstdlib>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

using vorion::test::TestDevice;

namespace {

/// Begins kernels that are not compiled yet and run for a while. No other text
/// ends with \p Name.
cl::Program begin(const TestDevice &Device, const std::string &Name) {
  const cl::Program Program = Device.build(R"(
kernel void f(global uint *out, uint count) {
  uint x = get_global_id(0);
  for (uint i = 0; i < count; ++i)
    x = x * 1664525 + 1013904223;
  out[get_global_id(0)] = x;
}
// )" + std::to_string(getpid()) + Name);
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 1024);
  cl::Kernel Kernel(Program, "f");
  Kernel.setArg(0, Out);
  Kernel.setArg(1, 100000);
  for (const unsigned Local : {64U, 32U, 16U})
    Device.queue().enqueueNDRangeKernel(Kernel, cl::NullRange, cl::NDRange(256),
                                        cl::NDRange(Local));
  Device.queue().flush();
  return Program;
}

/// Ends with kernels under way. What is static here was there before the
/// device, so it ends after what is static there, and waits for the kernels.
[[noreturn]] void endEarly(const std::string &Name) {
  static struct {
    cl::CommandQueue Queue;
    cl::Program Program;
  } Kept;
  static const struct Waiting {
    ~Waiting() { Kept.Queue.finish(); }
  } AtTheEnd;
  const TestDevice Device;
  Kept = {Device.queue(), begin(Device, Name)};
  std::exit(0);
}

/// Statics of the compiler and the simulator went while both still used them:
/// of Boost.Compute, test_remove crashed so each second time.
TEST(AtExit, AProgramMayEndBeforeItsKernels) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (int Run = 0; Run != 4; ++Run)
    EXPECT_EXIT(endEarly(" " + std::to_string(Run)), testing::ExitedWithCode(0),
                "");
}

/// A forked process has no threads that could execute what it would wait for.
TEST(AtExit, AForkedProcessWaitsForNothing) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = begin(Device, " forked");
  const pid_t Child = fork();
  if (Child == 0) {
    alarm(30);
    std::exit(7);
  }
  int Status = 0;
  ASSERT_EQ(waitpid(Child, &Status, 0), Child);
  EXPECT_TRUE(WIFEXITED(Status) && WEXITSTATUS(Status) == 7) << Status;
  EXPECT_EQ(Device.queue().finish(), CL_SUCCESS);
}

} // namespace
