/// Buffers as host programs use them: mapped, part of another, filled, copied,
/// in host memory; and commands that wait for each other.

#include "TestDevice.h"

#include <cstdint>
#include <numeric>

using vorion::test::TestDevice;

namespace {

constexpr std::size_t Count = 1000;
using Values = std::vector<int32_t>;

Values ascending() {
  Values V(Count);
  std::iota(V.begin(), V.end(), 0);
  return V;
}

cl::Kernel increment(const TestDevice &Device, const cl::Buffer &Buffer) {
  const cl::Program Program = Device.build(
      "kernel void increment(global int *a) { a[get_global_id(0)] += 1; }");
  cl::Kernel K(Program, "increment");
  K.setArg(0, Buffer);
  return K;
}

class Placement : public testing::TestWithParam<cl_mem_flags> {};

TEST_P(Placement, MappedWritesReachTheDevice) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  Values Host = ascending();
  const cl::Buffer Buffer(Device.context(), CL_MEM_READ_WRITE | GetParam(),
                          Count * 4, Host.data());
  const cl::Kernel K = increment(Device, Buffer);
  Device.run(K, Count, 50);
  cl_int Status = 0;
  auto *Mapped = static_cast<int32_t *>(Device.queue().enqueueMapBuffer(
      Buffer, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, 0, Count * 4, nullptr,
      nullptr, &Status));
  ASSERT_EQ(Status, CL_SUCCESS);
  for (std::size_t I = 0; I < Count; ++I) {
    ASSERT_EQ(Mapped[I], static_cast<int32_t>(I) + 1);
    Mapped[I] += 5;
  }
  Device.queue().enqueueUnmapMemObject(Buffer, Mapped);
  Device.run(K, Count, 50);
  Values Want = ascending();
  for (int32_t &V : Want)
    V += 7;
  EXPECT_EQ(Device.download<int32_t>(Buffer, Count), Want);
}

INSTANTIATE_TEST_SUITE_P(Flags, Placement,
                         testing::Values(CL_MEM_COPY_HOST_PTR,
                                         CL_MEM_USE_HOST_PTR,
                                         CL_MEM_ALLOC_HOST_PTR |
                                             CL_MEM_COPY_HOST_PTR));

TEST(Buffers, PartsFillsAndCopiesTouchTheirBytesOnly) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  Values Want = ascending();
  cl::Buffer Buffer = Device.upload(Want);
  cl_buffer_region Region{512, 1024};
  cl_int Status = 0;
  const cl::Buffer Part = Buffer.createSubBuffer(
      CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION, &Region, &Status);
  ASSERT_EQ(Status, CL_SUCCESS);
  Device.run(increment(Device, Part), 256, 64);
  for (std::size_t I = 128; I < 384; ++I)
    ++Want[I];
  EXPECT_EQ(Device.download<int32_t>(Buffer, Count), Want);

  ASSERT_EQ(Device.queue().enqueueFillBuffer(Buffer, int32_t{7}, 40, 400),
            CL_SUCCESS);
  for (std::size_t I = 10; I < 110; ++I)
    Want[I] = 7;
  EXPECT_EQ(Device.download<int32_t>(Buffer, Count), Want);

  const cl::Buffer Other = Device.upload(Values(Count, -1));
  ASSERT_EQ(Device.queue().enqueueCopyBuffer(Buffer, Other, 400, 800, 2000),
            CL_SUCCESS);
  Values WantOther(Count, -1);
  for (std::size_t I = 0; I < 500; ++I)
    WantOther[200 + I] = Want[100 + I];
  EXPECT_EQ(Device.download<int32_t>(Other, Count), WantOther);
}

TEST(Buffers, PartsThatABufferCannotHaveAreRefused) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Buffer Buffer(Device.context(), CL_MEM_READ_WRITE, 4096);
  const auto Part = [&](std::size_t Origin, std::size_t Size,
                        cl_mem_flags Flags = 0) {
    const cl_buffer_region Region = {Origin, Size};
    cl_int Status = CL_SUCCESS;
    const cl_mem Made = clCreateSubBuffer(
        Buffer(), Flags, CL_BUFFER_CREATE_TYPE_REGION, &Region, &Status);
    if (Made)
      clReleaseMemObject(Made);
    return Status;
  };
  EXPECT_EQ(Part(0, 4096), CL_SUCCESS);
  EXPECT_EQ(Part(3968, 128), CL_SUCCESS);
  EXPECT_EQ(Part(3968, 129), CL_INVALID_VALUE);
  EXPECT_EQ(Part(4096, 1), CL_INVALID_VALUE);
  // Origin and size together are 128, modulo 2 to the power of 64.
  EXPECT_EQ(Part(std::size_t{0} - 128, 256), CL_INVALID_VALUE);
  EXPECT_EQ(Part(128, std::size_t{0} - 64), CL_INVALID_VALUE);
  EXPECT_EQ(Part(0, 128, CL_MEM_READ_ONLY | CL_MEM_HOST_NO_ACCESS), CL_SUCCESS);
  for (const cl_mem_flags Flags : {
           cl_mem_flags{CL_MEM_READ_ONLY | CL_MEM_WRITE_ONLY},
           cl_mem_flags{CL_MEM_READ_ONLY | CL_MEM_READ_WRITE},
           cl_mem_flags{CL_MEM_HOST_READ_ONLY | CL_MEM_HOST_NO_ACCESS},
           cl_mem_flags{CL_MEM_USE_HOST_PTR},
           cl_mem_flags{CL_MEM_COPY_HOST_PTR},
           cl_mem_flags{1} << 40,
       })
    EXPECT_EQ(Part(0, 128, Flags), CL_INVALID_VALUE) << Flags;
}

TEST(Buffers, CommandsWaitForTheirEvents) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Buffer Buffer = Device.upload(ascending());
  const cl::Kernel K = increment(Device, Buffer);
  cl::UserEvent Go(Device.context());
  const std::vector<cl::Event> After = {Go};
  cl::Event Done;
  const cl::CommandQueue Second(
      Device.context(), Device.context().getInfo<CL_CONTEXT_DEVICES>()[0]);
  ASSERT_EQ(Second.enqueueNDRangeKernel(K, cl::NullRange, cl::NDRange(Count),
                                        cl::NDRange(50), &After, &Done),
            CL_SUCCESS);
  Second.flush();
  EXPECT_EQ(Device.download<int32_t>(Buffer, Count), ascending());
  Go.setStatus(CL_COMPLETE);
  EXPECT_EQ(Done.wait(), CL_SUCCESS);
  Values Want = ascending();
  for (int32_t &V : Want)
    ++V;
  EXPECT_EQ(Device.download<int32_t>(Buffer, Count), Want);
}

TEST(Buffers, MoreThanTheDeviceHasIsRefused) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  cl_int Status = CL_SUCCESS;
  const cl::Buffer Buffer(Device.context(), CL_MEM_READ_WRITE,
                          std::size_t{3} << 30, nullptr, &Status);
  EXPECT_EQ(Status, CL_INVALID_BUFFER_SIZE);
}

TEST(Buffers, CommandsWithoutMemorySaySo) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::CommandQueue &Queue = Device.queue();
  const auto Most =
      Queue.getInfo<CL_QUEUE_DEVICE>().getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  const cl_int Word = 1;
  std::vector<cl::Buffer> Quarters;
  Quarters.reserve(4);
  for (int I = 0; I < 4; ++I) {
    Quarters.emplace_back(Device.context(), CL_MEM_READ_WRITE, Most / 4 - 4096);
    ASSERT_EQ(Queue.enqueueWriteBuffer(Quarters.back(), CL_TRUE, 0, 4, &Word),
              CL_SUCCESS);
  }
  const cl::Buffer Third(Device.context(), CL_MEM_READ_WRITE, 1 << 20);
  constexpr cl_int NoMemory = CL_MEM_OBJECT_ALLOCATION_FAILURE;
  cl_int Status = CL_SUCCESS;
  EXPECT_EQ(Queue.enqueueWriteBuffer(Third, CL_TRUE, 0, 4, &Word), NoMemory);
  EXPECT_EQ(Queue.enqueueFillBuffer(Third, Word, 0, 4), NoMemory);
  EXPECT_EQ(Queue.enqueueCopyBuffer(Quarters[0], Third, 0, 0, 4), NoMemory);
  Queue.enqueueMapBuffer(Third, CL_TRUE, CL_MAP_READ, 0, 4, nullptr, nullptr,
                         &Status);
  EXPECT_EQ(Status, NoMemory);
  EXPECT_EQ(Queue.enqueueNDRangeKernel(increment(Device, Third), cl::NullRange,
                                       cl::NDRange(1)),
            NoMemory);
  Quarters.clear();
  EXPECT_EQ(Queue.enqueueWriteBuffer(Third, CL_TRUE, 0, 4, &Word), CL_SUCCESS);
}

TEST(Buffers, AMappingKeepsNoBuffer) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::ImageFormat Format(CL_RGBA, CL_FLOAT);
  const auto Note = [](cl_mem, void *Gone) {
    *static_cast<bool *>(Gone) = true;
  };
  bool BufferGone = false, ImageGone = false;
  {
    const cl::Buffer Buffer = Device.upload(ascending());
    const cl::Image2D Image(Device.context(), CL_MEM_READ_WRITE, Format, 8, 8);
    ASSERT_EQ(clSetMemObjectDestructorCallback(Buffer(), Note, &BufferGone),
              CL_SUCCESS);
    ASSERT_EQ(clSetMemObjectDestructorCallback(Image(), Note, &ImageGone),
              CL_SUCCESS);
    cl_int Status = CL_SUCCESS;
    for (const std::size_t Offset : {0, 400}) {
      Device.queue().enqueueMapBuffer(Buffer, CL_TRUE, CL_MAP_READ, Offset, 400,
                                      nullptr, nullptr, &Status);
      ASSERT_EQ(Status, CL_SUCCESS);
    }
    std::size_t Pitch = 0;
    void *Mapped = Device.queue().enqueueMapImage(
        Image, CL_TRUE, CL_MAP_WRITE, {0, 0, 0}, {8, 8, 1}, &Pitch, nullptr,
        nullptr, nullptr, &Status);
    ASSERT_EQ(Status, CL_SUCCESS);
    EXPECT_EQ(Buffer.getInfo<CL_MEM_MAP_COUNT>(), 2U);
    EXPECT_EQ(Device.queue().finish(), CL_SUCCESS);
    EXPECT_EQ(Buffer.getInfo<CL_MEM_REFERENCE_COUNT>(), 1U);
    // A mapping that is ended does not end the image.
    ASSERT_EQ(Device.queue().enqueueUnmapMemObject(Image, Mapped), CL_SUCCESS);
    EXPECT_EQ(Device.queue().finish(), CL_SUCCESS);
    EXPECT_FALSE(ImageGone);
    EXPECT_EQ(Image.getInfo<CL_MEM_REFERENCE_COUNT>(), 1U);
  }
  EXPECT_TRUE(BufferGone);
  EXPECT_TRUE(ImageGone);
}

} // namespace
