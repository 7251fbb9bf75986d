/// 1D images of buffers (image1d_buffer_t), as the host sees them.

#include "TestDevice.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>

using vorion::test::TestDevice;

namespace {

class RowsOfBuffers : public testing::Test {
protected:
  void SetUp() override { VORION_REQUIRE_DEVICE(Device); }
  const cl::CommandQueue &queue() const { return Device.queue(); }

  TestDevice Device;
  const cl::ImageFormat Bytes = {CL_RGBA, CL_UNSIGNED_INT8};
};

TEST_F(RowsOfBuffers, MayHaveAPitch) {
  const cl::Buffer Row(Device.context(), CL_MEM_READ_WRITE, 20);
  cl_image_desc D{};
  D.image_type = CL_MEM_OBJECT_IMAGE1D_BUFFER;
  D.image_width = 4;
  D.buffer = Row();
  const auto Create = [&](std::size_t Pitch) {
    D.image_row_pitch = Pitch;
    cl_int Status = 1;
    const cl::Image1DBuffer Image(clCreateImage(
        Device.context()(), CL_MEM_READ_WRITE, &Bytes, &D, nullptr, &Status));
    return Status;
  };
  for (const std::size_t Right : {0, 16, 20})
    EXPECT_EQ(Create(Right), CL_SUCCESS) << Right;
  for (const std::size_t Wrong : {12, 18})
    EXPECT_EQ(Create(Wrong), CL_INVALID_IMAGE_DESCRIPTOR) << Wrong;
}

TEST_F(RowsOfBuffers, EndAsOtherImagesDo) {
  const auto Users = [&] {
    return Device.context().getInfo<CL_CONTEXT_REFERENCE_COUNT>();
  };
  const cl::Buffer Row(Device.context(), CL_MEM_READ_WRITE, 16);
  const cl_uint Before = Users();
  bool Gone = false;
  {
    cl::Image1DBuffer Image(Device.context(), CL_MEM_READ_WRITE,
                            cl::ImageFormat(CL_RGBA, CL_UNSIGNED_INT8), 4, Row);
    ASSERT_EQ(
        Image.setDestructorCallback(
            [](cl_mem, void *Ended) { *static_cast<bool *>(Ended) = true; },
            &Gone),
        CL_SUCCESS);
    EXPECT_EQ(Row.getInfo<CL_MEM_REFERENCE_COUNT>(), 2U);
  }
  EXPECT_TRUE(Gone);
  EXPECT_EQ(Row.getInfo<CL_MEM_REFERENCE_COUNT>(), 1U);
  EXPECT_EQ(Users(), Before);
}

TEST_F(RowsOfBuffers, CanBeMadeOfAPartOfABuffer) {
  const cl::Program Program = Device.build(R"(
kernel void twice(read_only image1d_buffer_t in, write_only image1d_buffer_t out) {
  int x = get_global_id(0);
  write_imageui(out, x, 2 * read_imageui(in, x));
})");
  std::vector<uint32_t> Values(128);
  std::iota(Values.begin(), Values.end(), 0U);
  cl::Buffer All = Device.upload(Values);
  const auto Part = [&](std::size_t First) {
    cl_buffer_region Region{First * 4, 64};
    return All.createSubBuffer(CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION,
                               &Region);
  };
  const cl::ImageFormat Format(CL_R, CL_UNSIGNED_INT32);
  const cl::Image1DBuffer In(Device.context(), CL_MEM_READ_WRITE, Format, 16,
                             Part(32));
  const cl::Image1DBuffer Out(Device.context(), CL_MEM_READ_WRITE, Format, 16,
                              Part(96));
  // Only the images still hold the parts.
  cl::Kernel Kernel(Program, "twice");
  Kernel.setArg(0, In);
  Kernel.setArg(1, Out);
  Device.run(Kernel, 16, 16);
  for (std::size_t I = 0; I < 16; ++I)
    Values[96 + I] = 2 * Values[32 + I];
  EXPECT_EQ(Device.download<uint32_t>(All, 128), Values);

  std::size_t Pitch = 0;
  cl_int Status = CL_SUCCESS;
  auto *Mapped = static_cast<uint32_t *>(queue().enqueueMapImage(
      Out, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, {2, 0, 0}, {4, 1, 1}, &Pitch,
      nullptr, nullptr, nullptr, &Status));
  ASSERT_EQ(Status, CL_SUCCESS);
  EXPECT_EQ(Mapped[0], Values[98]);
  Mapped[3] = Values[101] = 7;
  EXPECT_EQ(queue().enqueueUnmapMemObject(Out, Mapped), CL_SUCCESS);
  EXPECT_EQ(queue().enqueueCopyImage(Out, In, {5, 0, 0}, {1, 0, 0}, {1, 1, 1}),
            CL_SUCCESS);
  Values[33] = 7;
  EXPECT_EQ(Device.download<uint32_t>(All, 128), Values);
}

/// Reads and writes were refused, as their image is no buffer; a mapping left
/// the pitch out. Mappings and copies took any origin.
TEST_F(RowsOfBuffers, AreReadWrittenAndMapped) {
  std::vector<uint8_t> Before(256, 1), Texels(20);
  std::iota(Texels.begin(), Texels.end(), uint8_t{2});
  cl::Buffer All = Device.upload(Before);
  const cl::Buffer Other = Device.upload(Before);
  const cl::Image1D Line(Device.context(), CL_MEM_READ_WRITE, Bytes, 16);
  const cl_buffer_region Part = {128, 64};
  const cl::Buffer Half = All.createSubBuffer(
      CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION, &Part);
  for (const bool OfPart : {false, true}) {
    const std::size_t Begin = OfPart ? 128 : 0;
    const cl::Image1DBuffer Image(Device.context(), CL_MEM_READ_WRITE, Bytes,
                                  16, OfPart ? Half : All);
    const std::array<cl::size_type, 3> Origin = {3, 0, 0}, Region = {5, 1, 1};
    ASSERT_EQ(queue().enqueueWriteImage(Image, CL_TRUE, Origin, Region, 0, 0,
                                        Texels.data()),
              CL_SUCCESS);
    std::copy(Texels.begin(), Texels.end(), Before.begin() + Begin + 12);
    EXPECT_EQ(Device.download<uint8_t>(All, 256), Before);
    std::vector<uint8_t> Read(20);
    ASSERT_EQ(queue().enqueueReadImage(Image, CL_TRUE, Origin, Region, 0, 0,
                                       Read.data()),
              CL_SUCCESS);
    EXPECT_EQ(Read, Texels);
    std::size_t Pitch = 0, Slice = 1;
    auto *Mapped = static_cast<uint8_t *>(
        queue().enqueueMapImage(Image, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE,
                                Origin, Region, &Pitch, &Slice));
    ASSERT_NE(Mapped, nullptr);
    EXPECT_EQ(Pitch, 64U);
    EXPECT_EQ(Slice, 0U);
    EXPECT_EQ(std::vector<uint8_t>(Mapped, Mapped + 20), Texels);
    Mapped[19] = Before[Begin + 31] = 99;
    ASSERT_EQ(queue().enqueueUnmapMemObject(Image, Mapped), CL_SUCCESS);
    EXPECT_EQ(Device.download<uint8_t>(All, 256), Before);
    ASSERT_EQ(queue().enqueueCopyImageToBuffer(Image, Other, Origin, Region, 7),
              CL_SUCCESS);
    std::vector<uint8_t> Copy = Device.download<uint8_t>(Other, 27);
    EXPECT_TRUE(std::equal(Texels.begin(), Texels.end() - 1, Copy.begin() + 7));
    ASSERT_EQ(
        queue().enqueueCopyBufferToImage(Other, Image, 7, {9, 0, 0}, Region),
        CL_SUCCESS);
    std::copy(Copy.begin() + 7, Copy.end(), Before.begin() + Begin + 36);
    EXPECT_EQ(Device.download<uint8_t>(All, 256), Before);

    using Triple = std::array<cl::size_type, 3>;
    for (const auto &[From, Size] :
         std::vector<std::pair<Triple, Triple>>{{{3, 1, 0}, Region},
                                                {{3, 0, 1}, Region},
                                                {Origin, {5, 2, 1}},
                                                {Origin, {14, 1, 1}}}) {
      EXPECT_EQ(queue().enqueueReadImage(Image, CL_TRUE, From, Size, 0, 0,
                                         Read.data()),
                CL_INVALID_VALUE);
      EXPECT_EQ(queue().enqueueWriteImage(Image, CL_TRUE, From, Size, 0, 0,
                                          Read.data()),
                CL_INVALID_VALUE);
      cl_int Status = CL_SUCCESS;
      queue().enqueueMapImage(Image, CL_TRUE, CL_MAP_READ, From, Size, &Pitch,
                              nullptr, nullptr, nullptr, &Status);
      EXPECT_EQ(Status, CL_INVALID_VALUE);
      EXPECT_EQ(queue().enqueueCopyImage(Image, Line, From, {0, 0, 0}, Size),
                CL_INVALID_VALUE);
      EXPECT_EQ(queue().enqueueCopyImage(Line, Image, {0, 0, 0}, From, Size),
                CL_INVALID_VALUE);
      EXPECT_EQ(queue().enqueueFillImage(Image, cl_uint4{}, From, Size),
                CL_INVALID_VALUE);
      EXPECT_EQ(queue().enqueueCopyImageToBuffer(Image, Other, From, Size, 64),
                CL_INVALID_VALUE);
      EXPECT_EQ(queue().enqueueCopyBufferToImage(Other, Image, 64, From, Size),
                CL_INVALID_VALUE);
    }
  }
}

} // namespace
