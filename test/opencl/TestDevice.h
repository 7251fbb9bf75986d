/// The OpenCL device that the host programs of this folder test: the first one
/// there is.
#pragma once

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#include <CL/opencl.hpp>

#include <array>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace vorion::test {

/// A context with one in-order queue, or none where there is no device.
class TestDevice {
public:
  TestDevice() {
    std::vector<cl::Platform> Platforms;
    cl::Platform::get(&Platforms);
    for (const cl::Platform &Platform : Platforms) {
      std::vector<cl::Device> Devices;
      Platform.getDevices(CL_DEVICE_TYPE_ALL, &Devices);
      if (Devices.empty())
        continue;
      Chosen = Devices.front();
      Usable = true;
      ContextHandle = cl::Context(Chosen);
      QueueHandle = cl::CommandQueue(ContextHandle, Chosen);
      return;
    }
  }
  bool usable() const { return Usable; }
  const cl::Context &context() const { return ContextHandle; }
  const cl::CommandQueue &queue() const { return QueueHandle; }

  /// The built program. One that cannot be built ends the test with its log.
  cl::Program build(const std::string &Source, const char *Options = "") const {
    cl::Program Program(ContextHandle, Source);
    if (Program.build(Options) != CL_SUCCESS)
      throw std::runtime_error(
          "build failed\n" +
          Program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(Chosen));
    return Program;
  }

  template <typename T> cl::Buffer upload(const std::vector<T> &Values) const {
    return cl::Buffer(ContextHandle, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
                      Values.size() * sizeof(T),
                      const_cast<T *>(Values.data()));
  }
  template <typename T>
  std::vector<T> download(const cl::Buffer &Buffer, std::size_t Count) const {
    std::vector<T> Values(Count);
    EXPECT_EQ(QueueHandle.enqueueReadBuffer(Buffer, CL_TRUE, 0,
                                            Count * sizeof(T), Values.data()),
              CL_SUCCESS);
    return Values;
  }
  /// All of an image of that size, which has \p Count values of T.
  template <typename T>
  std::vector<T> download(const cl::Image &Image,
                          std::array<cl::size_type, 3> Size,
                          std::size_t Count) const {
    std::vector<T> Values(Count);
    EXPECT_EQ(QueueHandle.enqueueReadImage(Image, CL_TRUE, {0, 0, 0}, Size, 0,
                                           0, Values.data()),
              CL_SUCCESS);
    return Values;
  }
  /// Runs \p Kernel to its end, which must be a good one.
  void run(const cl::Kernel &Kernel, const cl::NDRange &Global,
           const cl::NDRange &Local) const {
    const auto Name = Kernel.getInfo<CL_KERNEL_FUNCTION_NAME>();
    cl::Event Done;
    ASSERT_EQ(QueueHandle.enqueueNDRangeKernel(Kernel, cl::NullRange, Global,
                                               Local, nullptr, &Done),
              CL_SUCCESS)
        << Name;
    // A fault of the kernel is the event's; clFinish says nothing of it.
    EXPECT_EQ(Done.wait(), CL_SUCCESS) << Name;
  }

private:
  bool Usable = false;
  cl::Device Chosen;
  cl::Context ContextHandle;
  cl::CommandQueue QueueHandle;
};

} // namespace vorion::test

/// In a test's body: skips it where there is no device.
#define VORION_REQUIRE_DEVICE(DEVICE)                                          \
  if (!(DEVICE).usable())                                                      \
  GTEST_SKIP() << "no OpenCL device: source scripts/env.sh"
