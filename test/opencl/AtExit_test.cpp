/// A host program that ends while its commands still run.

#include "TestDevice.h"

#include <cstdlib>
#include <string>
#include <unistd.h>

using vorion::test::TestDevice;

namespace {

/// Begins kernels that are not compiled yet and run for a while, and ends. What
/// is static here was there before the device, so it ends after what is static
/// there, and waits for the kernels.
[[noreturn]] void endEarly(const std::string &Run) {
  static struct {
    cl::CommandQueue Queue;
    cl::Program Program;
  } Kept;
  static const struct Waiting {
    ~Waiting() { Kept.Queue.finish(); }
  } AtTheEnd;
  const TestDevice Device;
  // No earlier run has built a text that ends so.
  const cl::Program Program = Device.build(R"(
kernel void f(global uint *out, uint count) {
  uint x = get_global_id(0);
  for (uint i = 0; i < count; ++i)
    x = x * 1664525 + 1013904223;
  out[get_global_id(0)] = x;
}
// )" + std::to_string(getpid()) + Run);
  Kept = {Device.queue(), Program};
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 1024);
  cl::Kernel Kernel(Program, "f");
  Kernel.setArg(0, Out);
  Kernel.setArg(1, 100000);
  for (const unsigned Local : {64U, 32U, 16U})
    Device.queue().enqueueNDRangeKernel(Kernel, cl::NullRange, cl::NDRange(256),
                                        cl::NDRange(Local));
  Device.queue().flush();
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

} // namespace
