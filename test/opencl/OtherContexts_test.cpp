/// Objects of another context, and wait lists that are none: the error that the
/// standard names, never a crash.

#include "TestDevice.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

using vorion::test::TestDevice;

namespace {

constexpr const char *Source =
    "kernel void fill(global int *b, constant int *c, read_only image2d_t i,\n"
    "                 sampler_t s) { b[get_global_id(0)] = c[0]; }";

class OtherContexts : public testing::Test {
protected:
  void SetUp() override {
    VORION_REQUIRE_DEVICE(Ours);
    Code = Ours.build(Source);
    K = cl::Kernel(Code, "fill");
    Data = buffer(Ours);
    Picture = image(Ours);
    Reading = sampler(Ours);
    K.setArg(0, Data);
    K.setArg(1, Data);
    K.setArg(2, Picture);
    K.setArg(3, Reading);
  }
  static cl::Buffer buffer(const TestDevice &Device) {
    return Device.upload(std::vector<int32_t>(256, 7));
  }
  static cl::Image2D image(const TestDevice &Device) {
    return {Device.context(),
            CL_MEM_READ_WRITE,
            {CL_RGBA, CL_UNSIGNED_INT8},
            16,
            16};
  }
  static cl::Sampler sampler(const TestDevice &Device) {
    return {Device.context(), CL_FALSE, CL_ADDRESS_CLAMP, CL_FILTER_NEAREST};
  }
  TestDevice Ours, Theirs;
  cl::Program Code;
  cl::Kernel K;
  cl::Buffer Data;
  cl::Image2D Picture;
  cl::Sampler Reading;
};

TEST_F(OtherContexts, TheirObjectsAreNoArguments) {
  const cl::Buffer Whole = buffer(Theirs);
  cl_buffer_region Region = {0, 128};
  EXPECT_EQ(K.setArg(0, Whole), CL_INVALID_MEM_OBJECT);
  EXPECT_EQ(K.setArg(0, cl::Buffer(Whole).createSubBuffer(
                            CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION,
                            &Region)),
            CL_INVALID_MEM_OBJECT);
  EXPECT_EQ(K.setArg(1, Whole), CL_INVALID_MEM_OBJECT);
  EXPECT_EQ(K.setArg(2, image(Theirs)), CL_INVALID_MEM_OBJECT);
  EXPECT_EQ(K.setArg(3, sampler(Theirs)), CL_INVALID_SAMPLER);
  // The arguments that were set before are still there.
  Ours.run(K, 16, cl::NullRange);
}

TEST_F(OtherContexts, TheirProgramsAreNotLinked) {
  cl::Program Own(Ours.context(), "int f(void); kernel void k(global int *b) "
                                  "{ b[0] = f(); }");
  cl::Program Foreign(Theirs.context(), "int f(void) { return 3; }");
  ASSERT_EQ(Own.compile(), CL_SUCCESS);
  ASSERT_EQ(Foreign.compile(), CL_SUCCESS);
  const std::array<cl_program, 2> Parts = {Own(), Foreign()};
  cl_int Status = CL_SUCCESS;
  EXPECT_EQ(clLinkProgram(Ours.context()(), 0, nullptr, "", 2, Parts.data(),
                          nullptr, nullptr, &Status),
            nullptr);
  EXPECT_EQ(Status, CL_INVALID_PROGRAM);
}

/// Every function that takes a wait list, by its name.
TEST_F(OtherContexts, WaitListsAreHeldAgainstTheQueue) {
  const cl::Buffer A = buffer(Ours), B = buffer(Ours);
  const cl::Image2D I = image(Ours), J = image(Ours);
  const cl_command_queue Q = Ours.queue()();
  const size_t Items = 16;
  const std::array<size_t, 3> At = {0, 0, 0}, Size = {4, 4, 1};
  std::array<uint8_t, 1024> Host{};
  const int32_t Value = 0;
  size_t Pitch = 0;
  struct Use {
    const char *Name;
    std::function<cl_int(cl_uint, const cl_event *)> Call;
  };
  const std::vector<Use> Uses = {
      {"clEnqueueNDRangeKernel",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueNDRangeKernel(Q, K(), 1, nullptr, &Items, nullptr, N,
                                       E, nullptr);
       }},
      {"clEnqueueTask",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueTask(Q, K(), N, E, nullptr);
       }},
      {"clEnqueueReadBuffer",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueReadBuffer(Q, A(), CL_TRUE, 0, 64, Host.data(), N, E,
                                    nullptr);
       }},
      {"clEnqueueWriteBuffer",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueWriteBuffer(Q, A(), CL_TRUE, 0, 64, Host.data(), N, E,
                                     nullptr);
       }},
      {"clEnqueueReadBufferRect",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueReadBufferRect(Q, A(), CL_TRUE, At.data(), At.data(),
                                        Size.data(), 0, 0, 0, 0, Host.data(), N,
                                        E, nullptr);
       }},
      {"clEnqueueWriteBufferRect",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueWriteBufferRect(Q, A(), CL_TRUE, At.data(), At.data(),
                                         Size.data(), 0, 0, 0, 0, Host.data(),
                                         N, E, nullptr);
       }},
      {"clEnqueueCopyBuffer",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueCopyBuffer(Q, A(), B(), 0, 0, 64, N, E, nullptr);
       }},
      {"clEnqueueCopyBufferRect",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueCopyBufferRect(Q, A(), B(), At.data(), At.data(),
                                        Size.data(), 0, 0, 0, 0, N, E, nullptr);
       }},
      {"clEnqueueFillBuffer",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueFillBuffer(Q, A(), &Value, 4, 0, 64, N, E, nullptr);
       }},
      {"clEnqueueCopyImage",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueCopyImage(Q, I(), J(), At.data(), At.data(),
                                   Size.data(), N, E, nullptr);
       }},
      {"clEnqueueFillImage",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueFillImage(Q, I(), Host.data(), At.data(), Size.data(),
                                   N, E, nullptr);
       }},
      {"clEnqueueReadImage",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueReadImage(Q, I(), CL_TRUE, At.data(), Size.data(), 0,
                                   0, Host.data(), N, E, nullptr);
       }},
      {"clEnqueueCopyImageToBuffer",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueCopyImageToBuffer(Q, I(), A(), At.data(), Size.data(),
                                           0, N, E, nullptr);
       }},
      {"clEnqueueMapBuffer",
       [&](cl_uint N, const cl_event *E) {
         cl_int Status = CL_SUCCESS;
         clEnqueueMapBuffer(Q, A(), CL_TRUE, CL_MAP_READ, 0, 64, N, E, nullptr,
                            &Status);
         return Status;
       }},
      {"clEnqueueMapImage",
       [&](cl_uint N, const cl_event *E) {
         cl_int Status = CL_SUCCESS;
         clEnqueueMapImage(Q, I(), CL_TRUE, CL_MAP_READ, At.data(), Size.data(),
                           &Pitch, nullptr, N, E, nullptr, &Status);
         return Status;
       }},
      {"clEnqueueMigrateMemObjects",
       [&](cl_uint N, const cl_event *E) {
         const cl_mem Object = A();
         return clEnqueueMigrateMemObjects(Q, 1, &Object, 0, N, E, nullptr);
       }},
      {"clEnqueueMarkerWithWaitList",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueMarkerWithWaitList(Q, N, E, nullptr);
       }},
      {"clEnqueueBarrierWithWaitList",
       [&](cl_uint N, const cl_event *E) {
         return clEnqueueBarrierWithWaitList(Q, N, E, nullptr);
       }},
  };
  cl::UserEvent Foreign(Theirs.context());
  Foreign.setStatus(CL_COMPLETE);
  const cl_event TheirEvent = Foreign(), None = nullptr;
  for (const Use &U : Uses) {
    SCOPED_TRACE(U.Name);
    EXPECT_EQ(U.Call(1, &TheirEvent), CL_INVALID_CONTEXT);
    EXPECT_EQ(U.Call(1, &None), CL_INVALID_EVENT_WAIT_LIST);
    EXPECT_EQ(U.Call(1, nullptr), CL_INVALID_EVENT_WAIT_LIST);
    EXPECT_EQ(U.Call(0, &TheirEvent), CL_INVALID_EVENT_WAIT_LIST);
    EXPECT_EQ(U.Call(0, nullptr), CL_SUCCESS);
  }
  EXPECT_EQ(Ours.queue().finish(), CL_SUCCESS);
}

} // namespace
