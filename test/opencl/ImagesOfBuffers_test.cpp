/// 2D images that are made of buffers (cl_khr_image2d_from_buffer).

#include "TestDevice.h"

#include <cstdint>
#include <numeric>

using vorion::test::TestDevice;

namespace {

// The headers have these from OpenCL 2.0 on.
constexpr cl_device_info PitchAlignment = 0x104A;
constexpr cl_device_info BaseAddressAlignment = 0x104B;

/// An image of 5 x 4 texels of a byte, whose rows lie 9 bytes apart in the
/// second part of a buffer.
class ImagesOfBuffers : public testing::Test {
protected:
  static constexpr std::size_t Width = 5, Height = 4, Pitch = 9, Begin = 128;

  void SetUp() override {
    VORION_REQUIRE_DEVICE(Device);
    All.resize(256);
    std::iota(All.begin(), All.end(), uint8_t{0});
    Whole = Device.upload(All);
    cl_buffer_region Second{Begin, 128};
    Part = Whole.createSubBuffer(CL_MEM_READ_WRITE,
                                 CL_BUFFER_CREATE_TYPE_REGION, &Second);
    Image = cl::Image2D(create(Part(), Pitch));
    ASSERT_EQ(Status, CL_SUCCESS);
  }
  cl_mem create(cl_mem From, std::size_t RowPitch) {
    cl_image_desc D{};
    D.image_type = CL_MEM_OBJECT_IMAGE2D;
    D.image_width = Width;
    D.image_height = Height;
    D.image_row_pitch = RowPitch;
    D.buffer = From;
    return clCreateImage(Device.context()(), CL_MEM_READ_WRITE, &Format, &D,
                         nullptr, &Status);
  }
  static std::size_t at(std::size_t X, std::size_t Y) {
    return Begin + Y * Pitch + X;
  }
  void expectAll() {
    EXPECT_EQ(Device.download<uint8_t>(Whole, All.size()), All);
  }

  TestDevice Device;
  const cl_image_format Format = {CL_R, CL_UNSIGNED_INT8};
  std::vector<uint8_t> All;
  cl::Buffer Whole, Part;
  cl::Image2D Image;
  cl_int Status = 1;
  /// Inside of the image.
  const std::array<std::size_t, 3> Origin = {1, 1, 0}, Region = {3, 2, 1};
};

TEST_F(ImagesOfBuffers, AreOfferedForAnyPitchOfTexels) {
  const cl::Device D = Device.queue().getInfo<CL_QUEUE_DEVICE>();
  EXPECT_NE(
      D.getInfo<CL_DEVICE_EXTENSIONS>().find("cl_khr_image2d_from_buffer"),
      std::string::npos);
  cl_uint Alignment = 0;
  for (const cl_device_info Query : {PitchAlignment, BaseAddressAlignment}) {
    EXPECT_EQ(
        clGetDeviceInfo(D(), Query, sizeof(Alignment), &Alignment, nullptr),
        CL_SUCCESS);
    EXPECT_EQ(Alignment, 1U);
  }
  EXPECT_EQ(Image.getInfo<CL_MEM_ASSOCIATED_MEMOBJECT>()(), Part());
  EXPECT_EQ(Image.getImageInfo<CL_IMAGE_ROW_PITCH>(), Pitch);
}

TEST_F(ImagesOfBuffers, ThatCannotBeAreRefused) {
  const cl::Buffer Small(Device.context(), CL_MEM_READ_WRITE,
                         Pitch * Height - 1);
  create(Small(), Pitch);
  EXPECT_EQ(Status, CL_INVALID_MEM_OBJECT);
  // 4 rows that far apart are 0 bytes, in 64 bits.
  create(Part(), std::size_t{1} << 62U);
  EXPECT_EQ(Status, CL_INVALID_MEM_OBJECT);
  create(Part(), Width - 1);
  EXPECT_EQ(Status, CL_INVALID_IMAGE_DESCRIPTOR);
  create(Image(), Pitch);
  EXPECT_EQ(Status, CL_INVALID_OPERATION);
  cl_image_desc OfNone{};
  OfNone.image_type = CL_MEM_OBJECT_IMAGE1D_BUFFER;
  OfNone.image_width = Width;
  EXPECT_EQ(clCreateImage(Device.context()(), CL_MEM_READ_WRITE, &Format,
                          &OfNone, nullptr, &Status),
            nullptr);
  EXPECT_EQ(Status, CL_INVALID_IMAGE_DESCRIPTOR);
}

TEST_F(ImagesOfBuffers, AreReadAndWrittenByKernels) {
  const cl::Program Program = Device.build(R"(
kernel void twice(read_only image2d_t in, write_only image2d_t out) {
  int2 at = (int2)(get_global_id(0), get_global_id(1));
  write_imageui(out, at, 2 * read_imageui(in, at));
})");
  const cl::Image2D First(create(Whole(), 0));
  ASSERT_EQ(Status, CL_SUCCESS);
  cl::Kernel Kernel(Program, "twice");
  Kernel.setArg(0, First);
  Kernel.setArg(1, Image);
  ASSERT_EQ(Device.queue().enqueueNDRangeKernel(Kernel, cl::NullRange,
                                                cl::NDRange(Width, Height)),
            CL_SUCCESS);
  for (std::size_t Y = 0; Y < Height; ++Y)
    for (std::size_t X = 0; X < Width; ++X)
      All[at(X, Y)] = static_cast<uint8_t>(2 * All[Y * Width + X]);
  expectAll();
}

TEST_F(ImagesOfBuffers, AreReadWrittenAndFilled) {
  const cl::CommandQueue &Queue = Device.queue();
  std::array<uint8_t, 6> Texels{};
  ASSERT_EQ(Queue.enqueueReadImage(Image, CL_TRUE, Origin, Region, 0, 0,
                                   Texels.data()),
            CL_SUCCESS);
  for (std::size_t I = 0; I < Texels.size(); ++I) {
    uint8_t &Texel = All[at(1 + I % 3, 1 + I / 3)];
    EXPECT_EQ(Texels[I], Texel);
    Texel = Texels[I] = static_cast<uint8_t>(10 + I);
  }
  ASSERT_EQ(Queue.enqueueWriteImage(Image, CL_TRUE, Origin, Region, 0, 0,
                                    Texels.data()),
            CL_SUCCESS);
  expectAll();
  const cl_uint4 Color = {{7, 0, 0, 0}};
  cl::Event Filled;
  ASSERT_EQ(Queue.enqueueFillImage(Image, Color, {2, 0, 0}, {2, 3, 1}, nullptr,
                                   &Filled),
            CL_SUCCESS);
  EXPECT_EQ(Filled.wait(), CL_SUCCESS);
  for (std::size_t I = 0; I < 6; ++I)
    All[at(2 + I % 2, I / 2)] = 7;
  expectAll();
}

TEST_F(ImagesOfBuffers, AreCopied) {
  const cl::CommandQueue &Queue = Device.queue();
  const cl::Image2D Other(Device.context(), CL_MEM_READ_WRITE,
                          cl::ImageFormat(CL_R, CL_UNSIGNED_INT8), 3, 2);
  ASSERT_EQ(Queue.enqueueCopyImage(Image, Other, Origin, {0, 0, 0}, Region),
            CL_SUCCESS);
  ASSERT_EQ(Queue.enqueueCopyImage(Other, Image, {0, 0, 0}, {2, 2, 0}, Region),
            CL_SUCCESS);
  for (std::size_t I = 0; I < 6; ++I)
    All[at(2 + I % 3, 2 + I / 3)] =
        static_cast<uint8_t>(at(1 + I % 3, 1 + I / 3));
  expectAll();
  ASSERT_EQ(Queue.enqueueCopyBufferToImage(Whole, Image, 3, Origin, Region),
            CL_SUCCESS);
  ASSERT_EQ(Queue.enqueueCopyImageToBuffer(Image, Whole, Origin, Region, 50),
            CL_SUCCESS);
  for (std::size_t I = 0; I < 6; ++I)
    All[at(1 + I % 3, 1 + I / 3)] = All[50 + I] = static_cast<uint8_t>(3 + I);
  expectAll();
}

TEST_F(ImagesOfBuffers, AreMapped) {
  std::size_t RowPitch = 0;
  auto *Mapped = static_cast<uint8_t *>(Device.queue().enqueueMapImage(
      Image, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, Origin, Region, &RowPitch,
      nullptr, nullptr, nullptr, &Status));
  ASSERT_EQ(Status, CL_SUCCESS);
  EXPECT_EQ(RowPitch, Pitch);
  EXPECT_EQ(Mapped[Pitch], All[at(1, 2)]);
  Mapped[Pitch + 2] = All[at(3, 2)] = 7;
  EXPECT_EQ(Device.queue().enqueueUnmapMemObject(Image, Mapped), CL_SUCCESS);
  expectAll();
}

} // namespace
