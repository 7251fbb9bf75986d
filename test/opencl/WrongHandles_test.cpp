/// An object of another kind, or one that was released, wherever OpenCL's
/// functions take one: the error that the standard names, never a crash.

#include "WrongHandles.h"

#include <array>
#include <cstdint>
#include <vector>

using namespace vorion::test;

// clang-format off
// OpenCL 2.0 and later; the headers of these tests are those of 1.2.
extern "C" cl_int clSetContextDestructorCallback(cl_context, void (*)(cl_context, void *), void *);
extern "C" cl_int clGetKernelSubGroupInfo(cl_kernel, cl_device_id, cl_uint, size_t, const void *, size_t, void *, size_t *);
// clang-format on

namespace {

/// A sampler for a buffer ended the host.
TEST_F(WrongHandles, InArgumentsOfKernelsAreRefused) {
  const auto Set = [&](cl_uint Index, void *Object) {
    return clSetKernelArg(K(), Index, sizeof(Object),
                          static_cast<const void *>(&Object));
  };
  refuses({VORION_USE({Kind::Buffer}, CL_INVALID_MEM_OBJECT, Set(0, O)),
           VORION_USE({Kind::Buffer}, CL_INVALID_MEM_OBJECT, Set(1, O)),
           VORION_USE({Kind::Image}, CL_INVALID_MEM_OBJECT, Set(2, O)),
           VORION_USE({Kind::Sampler}, CL_INVALID_SAMPLER, Set(3, O))});
  for (const std::uintptr_t Number :
       {std::uintptr_t{1}, std::uintptr_t{4096},
        reinterpret_cast<std::uintptr_t>(Data()) + 8})
    EXPECT_EQ(Set(0, reinterpret_cast<void *>(Number)), CL_INVALID_MEM_OBJECT)
        << "a number is no buffer";
  EXPECT_EQ(Set(0, Data()), CL_SUCCESS);
  EXPECT_EQ(Set(0, nullptr), CL_SUCCESS);
  EXPECT_EQ(Set(2, Picture()), CL_SUCCESS);
  EXPECT_EQ(Set(3, Reading()), CL_SUCCESS);
}

/// The image that the kernel read was none of its type.
TEST_F(WrongHandles, ImagesOfOtherTypesAreRefused) {
  const cl::Image1D Line(Open.context(), CL_MEM_READ_WRITE,
                         {CL_RGBA, CL_UNSIGNED_INT8}, 16);
  EXPECT_EQ(K.setArg(2, Line), CL_INVALID_MEM_OBJECT);
  const cl::Program P = Open.build(
      "typedef image1d_t line;\n"
      "kernel void f(read_only line i, read_only image2d_depth_t d) {}\n");
  cl::Kernel F(P, "f");
  EXPECT_EQ(F.setArg(0, Picture), CL_INVALID_MEM_OBJECT);
  EXPECT_EQ(F.setArg(0, Line), CL_SUCCESS);
  EXPECT_EQ(F.setArg(1, Picture), CL_INVALID_MEM_OBJECT)
      << "its channels are no depths";
}

TEST_F(WrongHandles, InCountsQueriesAndCallbacksAreRefused) {
  size_t N = 0;
  const size_t One = 1;
  const auto Called = [](auto...) {};
  const std::set<Kind> Memory = {Kind::Buffer, Kind::Image};
  refuses({
      VORION_USE({Kind::Context}, CL_INVALID_CONTEXT,
                 clRetainContext(as<cl_context>(O))),
      VORION_USE({Kind::Context}, CL_INVALID_CONTEXT,
                 clReleaseContext(as<cl_context>(O))),
      VORION_USE({Kind::Queue}, CL_INVALID_COMMAND_QUEUE,
                 clRetainCommandQueue(as<cl_command_queue>(O))),
      VORION_USE({Kind::Queue}, CL_INVALID_COMMAND_QUEUE,
                 clReleaseCommandQueue(as<cl_command_queue>(O))),
      VORION_USE(Memory, CL_INVALID_MEM_OBJECT,
                 clRetainMemObject(as<cl_mem>(O))),
      VORION_USE(Memory, CL_INVALID_MEM_OBJECT,
                 clReleaseMemObject(as<cl_mem>(O))),
      VORION_USE({Kind::Sampler}, CL_INVALID_SAMPLER,
                 clRetainSampler(as<cl_sampler>(O))),
      VORION_USE({Kind::Sampler}, CL_INVALID_SAMPLER,
                 clReleaseSampler(as<cl_sampler>(O))),
      VORION_USE({Kind::Program}, CL_INVALID_PROGRAM,
                 clRetainProgram(as<cl_program>(O))),
      VORION_USE({Kind::Program}, CL_INVALID_PROGRAM,
                 clReleaseProgram(as<cl_program>(O))),
      VORION_USE({Kind::Kernel}, CL_INVALID_KERNEL,
                 clRetainKernel(as<cl_kernel>(O))),
      VORION_USE({Kind::Kernel}, CL_INVALID_KERNEL,
                 clReleaseKernel(as<cl_kernel>(O))),
      VORION_USE({Kind::Event}, CL_INVALID_EVENT,
                 clRetainEvent(as<cl_event>(O))),
      VORION_USE({Kind::Event}, CL_INVALID_EVENT,
                 clReleaseEvent(as<cl_event>(O))),
      VORION_USE({Kind::Device}, CL_INVALID_DEVICE,
                 clRetainDevice(as<cl_device_id>(O))),
      VORION_USE({Kind::Device}, CL_INVALID_DEVICE,
                 clReleaseDevice(as<cl_device_id>(O))),
      VORION_USE({Kind::Platform}, CL_INVALID_PLATFORM,
                 clGetPlatformInfo(as<cl_platform_id>(O), CL_PLATFORM_NAME, 0,
                                   nullptr, &N)),
      VORION_USE(
          {Kind::Device}, CL_INVALID_DEVICE,
          clGetDeviceInfo(as<cl_device_id>(O), CL_DEVICE_NAME, 0, nullptr, &N)),
      VORION_USE({Kind::Context}, CL_INVALID_CONTEXT,
                 clGetContextInfo(as<cl_context>(O), CL_CONTEXT_DEVICES, 0,
                                  nullptr, &N)),
      VORION_USE({Kind::Queue}, CL_INVALID_COMMAND_QUEUE,
                 clGetCommandQueueInfo(as<cl_command_queue>(O), CL_QUEUE_DEVICE,
                                       0, nullptr, &N)),
      VORION_USE(
          Memory, CL_INVALID_MEM_OBJECT,
          clGetMemObjectInfo(as<cl_mem>(O), CL_MEM_SIZE, 0, nullptr, &N)),
      VORION_USE({Kind::Image}, CL_INVALID_MEM_OBJECT,
                 clGetImageInfo(as<cl_mem>(O), CL_IMAGE_WIDTH, 0, nullptr, &N)),
      VORION_USE({Kind::Sampler}, CL_INVALID_SAMPLER,
                 clGetSamplerInfo(as<cl_sampler>(O), CL_SAMPLER_CONTEXT, 0,
                                  nullptr, &N)),
      VORION_USE({Kind::Program}, CL_INVALID_PROGRAM,
                 clGetProgramInfo(as<cl_program>(O), CL_PROGRAM_SOURCE, 0,
                                  nullptr, &N)),
      VORION_USE({Kind::Program}, CL_INVALID_PROGRAM,
                 clGetProgramBuildInfo(as<cl_program>(O), Device(),
                                       CL_PROGRAM_BUILD_LOG, 0, nullptr, &N)),
      VORION_USE({Kind::Device}, CL_INVALID_DEVICE,
                 clGetProgramBuildInfo(Code(), as<cl_device_id>(O),
                                       CL_PROGRAM_BUILD_LOG, 0, nullptr, &N)),
      VORION_USE({Kind::Kernel}, CL_INVALID_KERNEL,
                 clGetKernelInfo(as<cl_kernel>(O), CL_KERNEL_FUNCTION_NAME, 0,
                                 nullptr, &N)),
      VORION_USE({Kind::Kernel}, CL_INVALID_KERNEL,
                 clGetKernelArgInfo(as<cl_kernel>(O), 0, CL_KERNEL_ARG_NAME, 0,
                                    nullptr, &N)),
      VORION_USE({Kind::Kernel}, CL_INVALID_KERNEL,
                 clGetKernelWorkGroupInfo(as<cl_kernel>(O), Device(),
                                          CL_KERNEL_WORK_GROUP_SIZE, 0, nullptr,
                                          &N)),
      VORION_USE({Kind::Device}, CL_INVALID_DEVICE,
                 clGetKernelWorkGroupInfo(K(), as<cl_device_id>(O),
                                          CL_KERNEL_WORK_GROUP_SIZE, 0, nullptr,
                                          &N)),
      VORION_USE({Kind::Kernel}, CL_INVALID_KERNEL,
                 clGetKernelSubGroupInfo(as<cl_kernel>(O), Device(), 0x2033,
                                         sizeof(One), &One, 0, nullptr, &N)),
      VORION_USE({Kind::Device}, CL_INVALID_DEVICE,
                 clGetKernelSubGroupInfo(K(), as<cl_device_id>(O), 0x2033,
                                         sizeof(One), &One, 0, nullptr, &N)),
      VORION_USE({Kind::Event}, CL_INVALID_EVENT,
                 clGetEventInfo(as<cl_event>(O), CL_EVENT_COMMAND_TYPE, 0,
                                nullptr, &N)),
      VORION_USE({Kind::Event}, CL_INVALID_EVENT,
                 clGetEventProfilingInfo(as<cl_event>(O),
                                         CL_PROFILING_COMMAND_END, 0, nullptr,
                                         &N)),
      VORION_USE(
          {Kind::Event}, CL_INVALID_EVENT,
          clSetEventCallback(as<cl_event>(O), CL_COMPLETE, Called, nullptr)),
      // An event that a command made is none of the user's, either.
      VORION_USE({}, CL_INVALID_EVENT,
                 clSetUserEventStatus(as<cl_event>(O), CL_COMPLETE)),
      VORION_USE(
          Memory, CL_INVALID_MEM_OBJECT,
          clSetMemObjectDestructorCallback(as<cl_mem>(O), Called, nullptr)),
      VORION_USE(
          {Kind::Context}, CL_INVALID_CONTEXT,
          clSetContextDestructorCallback(as<cl_context>(O), Called, nullptr)),
  });
}

TEST_F(WrongHandles, WhereObjectsAreMadeAreRefused) {
  const std::set<Kind> Memory = {Kind::Buffer, Kind::Image};
  const char *Text = Source;
  const std::size_t Length = 4;
  const auto *Code4 = reinterpret_cast<const unsigned char *>(Text);
  const cl_image_format Format = {CL_RGBA, CL_UNSIGNED_INT8};
  const auto FromBuffer = [&](void *Object, cl_int *Status) {
    cl_image_desc Description{};
    Description.image_type = CL_MEM_OBJECT_IMAGE1D_BUFFER;
    Description.image_width = 4;
    Description.buffer = as<cl_mem>(Object);
    return clCreateImage(Open.context()(), 0, &Format, &Description, nullptr,
                         Status);
  };
  cl_image_desc Flat{};
  Flat.image_type = CL_MEM_OBJECT_IMAGE2D;
  Flat.image_width = Flat.image_height = 4;
  const cl_buffer_region Part{0, 64};
  const auto Devices = [](void *const &O) {
    return reinterpret_cast<const cl_device_id *>(&O);
  };
  const auto Programs = [](void *const &O) {
    return reinterpret_cast<const cl_program *>(&O);
  };
  const cl::Program Headers(Open.context(), Source);
  cl::Program Object(Open.context(), Source);
  ASSERT_EQ(Object.compile(), CL_SUCCESS);
  const char *Name = "a.h";
  refuses({
      VORION_MAKE(
          {Kind::Device}, CL_INVALID_DEVICE,
          clCreateContext(nullptr, 1, Devices(O), nullptr, nullptr, &S)),
      VORION_MAKE({Kind::Context}, CL_INVALID_CONTEXT,
                  clCreateCommandQueue(as<cl_context>(O), Device(), 0, &S)),
      VORION_MAKE(
          {Kind::Device}, CL_INVALID_DEVICE,
          clCreateCommandQueue(Open.context()(), as<cl_device_id>(O), 0, &S)),
      VORION_MAKE({Kind::Context}, CL_INVALID_CONTEXT,
                  clCreateBuffer(as<cl_context>(O), 0, 64, nullptr, &S)),
      VORION_MAKE({Kind::Buffer}, CL_INVALID_MEM_OBJECT,
                  clCreateSubBuffer(as<cl_mem>(O), 0,
                                    CL_BUFFER_CREATE_TYPE_REGION, &Part, &S)),
      VORION_MAKE(
          {Kind::Context}, CL_INVALID_CONTEXT,
          clCreateImage(as<cl_context>(O), 0, &Format, &Flat, nullptr, &S)),
      VORION_MAKE(Memory, CL_INVALID_MEM_OBJECT, FromBuffer(O, &S)),
      VORION_MAKE({Kind::Context}, CL_INVALID_CONTEXT,
                  clCreateSampler(as<cl_context>(O), CL_FALSE, CL_ADDRESS_CLAMP,
                                  CL_FILTER_NEAREST, &S)),
      VORION_MAKE({Kind::Context}, CL_INVALID_CONTEXT,
                  clCreateUserEvent(as<cl_context>(O), &S)),
      VORION_MAKE(
          {Kind::Context}, CL_INVALID_CONTEXT,
          clCreateProgramWithSource(as<cl_context>(O), 1, &Text, nullptr, &S)),
      VORION_MAKE({Kind::Context}, CL_INVALID_CONTEXT,
                  clCreateProgramWithBinary(as<cl_context>(O), 1, &Device(),
                                            &Length, &Code4, nullptr, &S)),
      VORION_MAKE({Kind::Device}, CL_INVALID_DEVICE,
                  clCreateProgramWithBinary(Open.context()(), 1, Devices(O),
                                            &Length, &Code4, nullptr, &S)),
      VORION_MAKE({Kind::Context}, CL_INVALID_CONTEXT,
                  clCreateProgramWithBuiltInKernels(as<cl_context>(O), 1,
                                                    &Device(), "k", &S)),
      VORION_MAKE({Kind::Device}, CL_INVALID_DEVICE,
                  clCreateProgramWithBuiltInKernels(Open.context()(), 1,
                                                    Devices(O), "k", &S)),
      VORION_USE({Kind::Program}, CL_INVALID_PROGRAM,
                 clBuildProgram(as<cl_program>(O), 0, nullptr, nullptr, nullptr,
                                nullptr)),
      VORION_USE(
          {Kind::Device}, CL_INVALID_DEVICE,
          clBuildProgram(Headers(), 1, Devices(O), nullptr, nullptr, nullptr)),
      VORION_USE({Kind::Program}, CL_INVALID_PROGRAM,
                 clCompileProgram(as<cl_program>(O), 0, nullptr, nullptr, 0,
                                  nullptr, nullptr, nullptr, nullptr)),
      VORION_USE({Kind::Device}, CL_INVALID_DEVICE,
                 clCompileProgram(Headers(), 1, Devices(O), nullptr, 0, nullptr,
                                  nullptr, nullptr, nullptr)),
      VORION_USE({Kind::Program}, CL_INVALID_PROGRAM,
                 clCompileProgram(Headers(), 0, nullptr, nullptr, 1,
                                  Programs(O), &Name, nullptr, nullptr)),
      VORION_MAKE({Kind::Context}, CL_INVALID_CONTEXT,
                  clLinkProgram(as<cl_context>(O), 0, nullptr, nullptr, 1,
                                &Object(), nullptr, nullptr, &S)),
      VORION_MAKE({Kind::Device}, CL_INVALID_DEVICE,
                  clLinkProgram(Open.context()(), 1, Devices(O), nullptr, 1,
                                &Object(), nullptr, nullptr, &S)),
      VORION_MAKE({Kind::Program}, CL_INVALID_PROGRAM,
                  clLinkProgram(Open.context()(), 0, nullptr, nullptr, 1,
                                Programs(O), nullptr, nullptr, &S)),
      VORION_MAKE({Kind::Program}, CL_INVALID_PROGRAM,
                  clCreateKernel(as<cl_program>(O), "k", &S)),
      VORION_USE(
          {Kind::Program}, CL_INVALID_PROGRAM,
          clCreateKernelsInProgram(as<cl_program>(O), 0, nullptr, nullptr)),
      VORION_MAKE({Kind::Kernel}, CL_INVALID_KERNEL,
                  clCloneKernel(as<cl_kernel>(O), &S)),
      VORION_USE({Kind::Kernel}, CL_INVALID_KERNEL,
                 clSetKernelArg(as<cl_kernel>(O), 4, 64, nullptr)),
      VORION_USE({Kind::Context}, CL_INVALID_CONTEXT,
                 clGetSupportedImageFormats(as<cl_context>(O), 0,
                                            CL_MEM_OBJECT_IMAGE2D, 0, nullptr,
                                            nullptr)),
  });
}

TEST_F(WrongHandles, OfMemoryInCommandsAreRefused) {
  std::array<uint8_t, 1024> Host{};
  const std::array<std::size_t, 3> Zero{0, 0, 0}, Four{4, 4, 1};
  const size_t *At = Zero.data(), *Size = Four.data();
  size_t Row = 0;
  const cl_uint Value = 1;
  const std::array<cl_uint, 4> Colour{1, 2, 3, 4};
  const cl_command_queue Q = Open.queue()();
  const std::set<Kind> Buffer = {Kind::Buffer}, Image = {Kind::Image},
                       Memory = {Kind::Buffer, Kind::Image};
  const cl_int Error = CL_INVALID_MEM_OBJECT;
  void *To = Host.data();
  refuses({
      VORION_USE(Buffer, Error,
                 clEnqueueReadBuffer(Q, as<cl_mem>(O), CL_TRUE, 0, 64, To, 0,
                                     nullptr, nullptr)),
      VORION_USE(Buffer, Error,
                 clEnqueueWriteBuffer(Q, as<cl_mem>(O), CL_TRUE, 0, 64, To, 0,
                                      nullptr, nullptr)),
      VORION_USE(Buffer, Error,
                 clEnqueueReadBufferRect(Q, as<cl_mem>(O), CL_TRUE, At, At,
                                         Size, 0, 0, 0, 0, To, 0, nullptr,
                                         nullptr)),
      VORION_USE(Buffer, Error,
                 clEnqueueWriteBufferRect(Q, as<cl_mem>(O), CL_TRUE, At, At,
                                          Size, 0, 0, 0, 0, To, 0, nullptr,
                                          nullptr)),
      VORION_USE(Buffer, Error,
                 clEnqueueFillBuffer(Q, as<cl_mem>(O), &Value, 4, 0, 64, 0,
                                     nullptr, nullptr)),
      VORION_USE(Buffer, Error,
                 clEnqueueCopyBuffer(Q, as<cl_mem>(O), Data(), 0, 0, 4, 0,
                                     nullptr, nullptr)),
      VORION_USE(Buffer, Error,
                 clEnqueueCopyBuffer(Q, Data(), as<cl_mem>(O), 0, 0, 4, 0,
                                     nullptr, nullptr)),
      VORION_USE(Buffer, Error,
                 clEnqueueCopyBufferRect(Q, as<cl_mem>(O), Data(), At, At, Size,
                                         0, 0, 0, 0, 0, nullptr, nullptr)),
      VORION_USE(Buffer, Error,
                 clEnqueueCopyBufferRect(Q, Data(), as<cl_mem>(O), At, At, Size,
                                         0, 0, 0, 0, 0, nullptr, nullptr)),
      VORION_MAKE(Buffer, Error,
                  clEnqueueMapBuffer(Q, as<cl_mem>(O), CL_TRUE, CL_MAP_READ, 0,
                                     4, 0, nullptr, nullptr, &S)),
      VORION_USE(Image, Error,
                 clEnqueueReadImage(Q, as<cl_mem>(O), CL_TRUE, At, Size, 0, 0,
                                    To, 0, nullptr, nullptr)),
      VORION_USE(Image, Error,
                 clEnqueueWriteImage(Q, as<cl_mem>(O), CL_TRUE, At, Size, 0, 0,
                                     To, 0, nullptr, nullptr)),
      VORION_USE(Image, Error,
                 clEnqueueFillImage(Q, as<cl_mem>(O), Colour.data(), At, Size,
                                    0, nullptr, nullptr)),
      VORION_USE(Image, Error,
                 clEnqueueCopyImage(Q, as<cl_mem>(O), Picture(), At, At, Size,
                                    0, nullptr, nullptr)),
      VORION_USE(Image, Error,
                 clEnqueueCopyImage(Q, Picture(), as<cl_mem>(O), At, At, Size,
                                    0, nullptr, nullptr)),
      VORION_USE(Image, Error,
                 clEnqueueCopyImageToBuffer(Q, as<cl_mem>(O), Data(), At, Size,
                                            0, 0, nullptr, nullptr)),
      VORION_USE(Buffer, Error,
                 clEnqueueCopyImageToBuffer(Q, Picture(), as<cl_mem>(O), At,
                                            Size, 0, 0, nullptr, nullptr)),
      VORION_USE(Buffer, Error,
                 clEnqueueCopyBufferToImage(Q, as<cl_mem>(O), Picture(), 0, At,
                                            Size, 0, nullptr, nullptr)),
      VORION_USE(Image, Error,
                 clEnqueueCopyBufferToImage(Q, Data(), as<cl_mem>(O), 0, At,
                                            Size, 0, nullptr, nullptr)),
      VORION_MAKE(Image, Error,
                  clEnqueueMapImage(Q, as<cl_mem>(O), CL_TRUE, CL_MAP_READ, At,
                                    Size, &Row, nullptr, 0, nullptr, nullptr,
                                    &S)),
      VORION_USE(
          Memory, Error,
          clEnqueueUnmapMemObject(Q, as<cl_mem>(O), To, 0, nullptr, nullptr)),
      VORION_USE(
          Memory, Error,
          clEnqueueMigrateMemObjects(Q, 1, reinterpret_cast<const cl_mem *>(&O),
                                     0, 0, nullptr, nullptr)),
  });
}

TEST_F(WrongHandles, OfQueuesKernelsAndEventsInCommandsAreRefused) {
  std::array<uint8_t, 64> Host{};
  const size_t Items = 16;
  void *To = Host.data();
  const std::set<Kind> Queue = {Kind::Queue}, Event = {Kind::Event};
  const auto Events = [](void *const &O) {
    return reinterpret_cast<const cl_event *>(&O);
  };
  refuses({
      VORION_USE(Queue, CL_INVALID_COMMAND_QUEUE,
                 clFlush(as<cl_command_queue>(O))),
      VORION_USE(Queue, CL_INVALID_COMMAND_QUEUE,
                 clFinish(as<cl_command_queue>(O))),
      VORION_USE(Queue, CL_INVALID_COMMAND_QUEUE,
                 clEnqueueReadBuffer(as<cl_command_queue>(O), Data(), CL_TRUE,
                                     0, 64, To, 0, nullptr, nullptr)),
      VORION_USE(Queue, CL_INVALID_COMMAND_QUEUE,
                 clEnqueueMarkerWithWaitList(as<cl_command_queue>(O), 0,
                                             nullptr, nullptr)),
      VORION_USE(Queue, CL_INVALID_COMMAND_QUEUE,
                 clEnqueueBarrierWithWaitList(as<cl_command_queue>(O), 0,
                                              nullptr, nullptr)),
      VORION_USE(Queue, CL_INVALID_COMMAND_QUEUE,
                 clEnqueueNDRangeKernel(as<cl_command_queue>(O), K(), 1,
                                        nullptr, &Items, nullptr, 0, nullptr,
                                        nullptr)),
      VORION_USE({Kind::Kernel}, CL_INVALID_KERNEL,
                 clEnqueueNDRangeKernel(Open.queue()(), as<cl_kernel>(O), 1,
                                        nullptr, &Items, nullptr, 0, nullptr,
                                        nullptr)),
      VORION_USE(
          {Kind::Kernel}, CL_INVALID_KERNEL,
          clEnqueueTask(Open.queue()(), as<cl_kernel>(O), 0, nullptr, nullptr)),
      VORION_USE(Event, CL_INVALID_EVENT, clWaitForEvents(1, Events(O))),
      VORION_USE(
          Event, CL_INVALID_EVENT_WAIT_LIST,
          clEnqueueMarkerWithWaitList(Open.queue()(), 1, Events(O), nullptr)),
      VORION_USE(Event, CL_INVALID_EVENT_WAIT_LIST,
                 clEnqueueReadBuffer(Open.queue()(), Data(), CL_TRUE, 0, 64, To,
                                     1, Events(O), nullptr)),
  });
}

} // namespace
