/// What the samples share: a device, its counters, and a verdict.
#pragma once

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <CL/opencl.hpp>

#include <CL/cl_vorion.h>

#include <functional>
#include <string>
#include <vector>

namespace sample {

/// The first OpenCL device there is, with one program. Throws cl::Error, after
/// the build log went to standard error if that is what failed.
class Device {
public:
  explicit Device(const std::string &Source);

  template <typename T> cl::Buffer upload(const std::vector<T> &Values) const {
    return cl::Buffer(Context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
                      Values.size() * sizeof(T),
                      const_cast<T *>(Values.data()));
  }
  template <typename T> cl::Buffer allocate(std::size_t Count) const {
    return cl::Buffer(Context, CL_MEM_READ_WRITE, Count * sizeof(T));
  }
  template <typename T>
  std::vector<T> download(const cl::Buffer &From, std::size_t Count) const {
    std::vector<T> Values(Count);
    Queue.enqueueReadBuffer(From, CL_TRUE, 0, Count * sizeof(T), Values.data());
    return Values;
  }

  /// Runs a kernel to its end and adds its counters to the sum.
  template <typename... Arguments>
  void run(const char *Kernel, cl::NDRange Global, cl::NDRange Local,
           const Arguments &...Values) {
    cl::Kernel K(Program, Kernel);
    cl_uint Index = 0;
    (K.setArg(Index++, Values), ...);
    cl::Event Done;
    Queue.enqueueNDRangeKernel(K, cl::NullRange, Global, Local, nullptr, &Done);
    Done.wait();
    count(Done);
  }

  std::string name() const { return Chosen.getInfo<CL_DEVICE_NAME>(); }

  /// Of all kernels so far; 0 on devices that do not tell.
  cl_ulong warpInstructions() const { return Warps; }
  cl_ulong laneInstructions() const { return Lanes; }

private:
  void count(const cl::Event &Done);

  cl::Device Chosen;
  cl::Context Context;
  cl::CommandQueue Queue;
  cl::Program Program;
  clGetEventInfoVORION_fn GetEventInfo = nullptr;
  cl_ulong Warps = 0, Lanes = 0;
};

/// Runs a sample. \p Body returns whether device and host agree. The result is
/// what main returns: 0, or 1 with a reason on standard error.
int run(const char *Name, const char *Source,
        const std::function<bool(Device &)> &Body);

} // namespace sample
