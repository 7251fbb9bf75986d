/// Images as the host sees them: what is created and refused, copied, filled
/// and mapped.

#include "TestDevice.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>

using vorion::test::TestDevice;

namespace {

class ImageCommands : public testing::Test {
protected:
  void SetUp() override { VORION_REQUIRE_DEVICE(Device); }

  cl_image_desc describe(cl_mem_object_type Type, std::size_t Width,
                         std::size_t Height, std::size_t Depth,
                         std::size_t Layers) const {
    cl_image_desc D{};
    D.image_type = Type;
    D.image_width = Width;
    D.image_height = Height;
    D.image_depth = Depth;
    D.image_array_size = Layers;
    return D;
  }
  cl_int statusOf(cl_image_format Format, const cl_image_desc &D,
                  cl_mem_flags Flags = CL_MEM_READ_WRITE,
                  void *Host = nullptr) const {
    cl_int Status = 1;
    cl_mem Image =
        clCreateImage(Device.context()(), Flags, &Format, &D, Host, &Status);
    EXPECT_EQ(Image != nullptr, Status == CL_SUCCESS);
    if (Image)
      clReleaseMemObject(Image);
    return Status;
  }
  const cl::CommandQueue &queue() const { return Device.queue(); }

  TestDevice Device;
  const cl_image_format Bytes = {CL_RGBA, CL_UNSIGNED_INT8};
};

std::vector<uint8_t> counting(std::size_t Count) {
  std::vector<uint8_t> Values(Count);
  std::iota(Values.begin(), Values.end(), uint8_t{0});
  return Values;
}

TEST_F(ImageCommands, WhatIsNoImageIsRefused) {
  const cl_image_desc Good = describe(CL_MEM_OBJECT_IMAGE2D, 4, 4, 0, 0);
  EXPECT_EQ(statusOf(Bytes, Good), CL_SUCCESS);
  EXPECT_EQ(statusOf({CL_RGBA, CL_UNORM_SHORT_565}, Good),
            CL_INVALID_IMAGE_FORMAT_DESCRIPTOR);
  EXPECT_EQ(statusOf({CL_BGRA, CL_FLOAT}, Good),
            CL_INVALID_IMAGE_FORMAT_DESCRIPTOR);
  EXPECT_EQ(statusOf({CL_RGBA, 7}, Good), CL_INVALID_IMAGE_FORMAT_DESCRIPTOR);
  EXPECT_EQ(statusOf({CL_RGB, CL_UNORM_SHORT_565}, Good),
            CL_IMAGE_FORMAT_NOT_SUPPORTED);
  EXPECT_EQ(statusOf(Bytes, describe(CL_MEM_OBJECT_BUFFER, 4, 4, 0, 0)),
            CL_INVALID_IMAGE_DESCRIPTOR);
  EXPECT_EQ(statusOf(Bytes, describe(CL_MEM_OBJECT_IMAGE2D, 4, 0, 0, 0)),
            CL_INVALID_IMAGE_DESCRIPTOR);
  EXPECT_EQ(statusOf(Bytes, describe(CL_MEM_OBJECT_IMAGE1D_ARRAY, 4, 0, 0, 0)),
            CL_INVALID_IMAGE_DESCRIPTOR);
  cl_image_desc Levels = Good;
  Levels.num_mip_levels = 2;
  EXPECT_EQ(statusOf(Bytes, Levels), CL_INVALID_IMAGE_DESCRIPTOR);
  EXPECT_EQ(statusOf(Bytes, Good, CL_MEM_COPY_HOST_PTR), CL_INVALID_HOST_PTR);
  cl_image_desc Pitch = Good;
  Pitch.image_row_pitch = 20;
  EXPECT_EQ(statusOf(Bytes, Pitch), CL_INVALID_IMAGE_DESCRIPTOR);
  std::vector<uint8_t> Texels(80);
  EXPECT_EQ(statusOf(Bytes, Pitch, CL_MEM_COPY_HOST_PTR, Texels.data()),
            CL_SUCCESS);
  for (const std::size_t Wrong : {12, 18}) {
    Pitch.image_row_pitch = Wrong;
    EXPECT_EQ(statusOf(Bytes, Pitch, CL_MEM_COPY_HOST_PTR, Texels.data()),
              CL_INVALID_IMAGE_DESCRIPTOR);
  }
}

TEST_F(ImageCommands, AnImageBeyondTheLimitsIsRefused) {
  const cl::Device D = queue().getInfo<CL_QUEUE_DEVICE>();
  const std::size_t Wide = D.getInfo<CL_DEVICE_IMAGE2D_MAX_WIDTH>();
  const std::size_t Deep = D.getInfo<CL_DEVICE_IMAGE3D_MAX_DEPTH>();
  const std::size_t Many = D.getInfo<CL_DEVICE_IMAGE_MAX_ARRAY_SIZE>();
  EXPECT_EQ(statusOf(Bytes, describe(CL_MEM_OBJECT_IMAGE2D, Wide, 1, 0, 0)),
            CL_SUCCESS);
  EXPECT_EQ(statusOf(Bytes, describe(CL_MEM_OBJECT_IMAGE2D, Wide + 1, 1, 0, 0)),
            CL_INVALID_IMAGE_SIZE);
  EXPECT_EQ(statusOf(Bytes, describe(CL_MEM_OBJECT_IMAGE3D, 1, 1, Deep + 1, 0)),
            CL_INVALID_IMAGE_SIZE);
  EXPECT_EQ(
      statusOf(Bytes, describe(CL_MEM_OBJECT_IMAGE1D_ARRAY, 1, 0, 0, Many + 1)),
      CL_INVALID_IMAGE_SIZE);
}

TEST_F(ImageCommands, ASamplerOfUnknownModesIsRefused) {
  const auto StatusOf = [&](bool Normalized, cl_addressing_mode Mode,
                            cl_filter_mode Filter) {
    cl_int Status = 1;
    cl::Sampler Sampler(Device.context(), Normalized, Mode, Filter, &Status);
    return Status;
  };
  EXPECT_EQ(StatusOf(true, CL_ADDRESS_REPEAT, CL_FILTER_LINEAR), CL_SUCCESS);
  EXPECT_EQ(StatusOf(false, CL_ADDRESS_REPEAT, CL_FILTER_LINEAR),
            CL_INVALID_VALUE);
  EXPECT_EQ(StatusOf(true, CL_FILTER_LINEAR, CL_FILTER_LINEAR),
            CL_INVALID_VALUE);
  EXPECT_EQ(StatusOf(true, CL_ADDRESS_CLAMP, CL_ADDRESS_CLAMP),
            CL_INVALID_VALUE);
}

TEST_F(ImageCommands, AnArgumentOfAnotherKindIsRefused) {
  const cl::Program Program =
      Device.build("kernel void k(read_only image2d_t in, sampler_t s) {}");
  cl::Kernel Kernel(Program, "k");
  const cl::Buffer Buffer(Device.context(), CL_MEM_READ_WRITE, 64);
  const cl::Image2D Written(Device.context(), CL_MEM_WRITE_ONLY,
                            cl::ImageFormat(CL_R, CL_FLOAT), 4, 4);
  const cl_sampler NoSampler = nullptr;
  EXPECT_EQ(Kernel.setArg(0, Buffer), CL_INVALID_MEM_OBJECT);
  EXPECT_EQ(Kernel.setArg(0, Written), CL_INVALID_ARG_VALUE);
  EXPECT_EQ(clSetKernelArg(Kernel(), 1, sizeof(cl_sampler),
                           static_cast<const void *>(&NoSampler)),
            CL_INVALID_SAMPLER);
}

/// A region that starts and ends inside of each type of image.
struct Shape {
  cl_mem_object_type Type;
  std::array<std::size_t, 3> Size, Origin, Region;
};

constexpr std::array Shapes = {
    Shape{CL_MEM_OBJECT_IMAGE1D, {9, 1, 1}, {2, 0, 0}, {5, 1, 1}},
    Shape{CL_MEM_OBJECT_IMAGE1D_ARRAY, {9, 5, 1}, {2, 1, 0}, {5, 3, 1}},
    Shape{CL_MEM_OBJECT_IMAGE2D, {9, 5, 1}, {2, 1, 0}, {5, 3, 1}},
    Shape{CL_MEM_OBJECT_IMAGE2D_ARRAY, {9, 5, 4}, {2, 1, 1}, {5, 3, 2}},
    Shape{CL_MEM_OBJECT_IMAGE3D, {9, 5, 4}, {2, 1, 1}, {5, 3, 2}},
};

class EveryShape : public ImageCommands {
protected:
  static std::size_t texelsOf(const std::array<std::size_t, 3> &Size) {
    return Size[0] * Size[1] * Size[2];
  }
  /// Of one byte a texel; \p Pitch: of the rows in \p Host. The class of
  /// cl.hpp does not matter.
  cl::Image2D create(const Shape &S, cl_mem_flags Flags, void *Host,
                     std::size_t Pitch = 0) const {
    const bool Lines = S.Type == CL_MEM_OBJECT_IMAGE1D_ARRAY;
    cl_image_desc D = describe(S.Type, S.Size[0], S.Size[1], S.Size[2],
                               S.Size[Lines ? 1 : 2]);
    D.image_row_pitch = Pitch;
    const cl_image_format Format = {CL_R, CL_UNSIGNED_INT8};
    cl_int Status = 1;
    cl::Image2D Image(
        clCreateImage(Device.context()(), Flags, &Format, &D, Host, &Status));
    EXPECT_EQ(Status, CL_SUCCESS);
    return Image;
  }
  std::vector<uint8_t> contents(const cl::Image &Image, const Shape &S) const {
    std::vector<uint8_t> Texels(texelsOf(S.Size));
    EXPECT_EQ(queue().enqueueReadImage(Image, CL_TRUE, {0, 0, 0}, S.Size, 0, 0,
                                       Texels.data()),
              CL_SUCCESS);
    return Texels;
  }
  /// Calls \p What with the index of each texel of the region, in the image and
  /// in the region.
  template <typename F> static void forRegion(const Shape &S, F What) {
    std::size_t Inner = 0;
    for (std::size_t Z = S.Origin[2]; Z < S.Origin[2] + S.Region[2]; ++Z)
      for (std::size_t Y = S.Origin[1]; Y < S.Origin[1] + S.Region[1]; ++Y)
        for (std::size_t X = S.Origin[0]; X < S.Origin[0] + S.Region[0]; ++X)
          What((Z * S.Size[1] + Y) * S.Size[0] + X, Inner++);
  }
};

TEST_F(EveryShape, RegionsAreReadAndWritten) {
  for (const Shape &S : Shapes) {
    std::vector<uint8_t> All = counting(texelsOf(S.Size));
    const cl::Image2D Image =
        create(S, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, All.data());
    EXPECT_EQ(contents(Image, S), All) << S.Type;
    std::vector<uint8_t> Part(texelsOf(S.Region));
    ASSERT_EQ(queue().enqueueReadImage(Image, CL_TRUE, S.Origin, S.Region, 0, 0,
                                       Part.data()),
              CL_SUCCESS);
    forRegion(S, [&](std::size_t Outer, std::size_t Inner) {
      EXPECT_EQ(Part[Inner], All[Outer]) << S.Type;
      All[Outer] = Part[Inner] = static_cast<uint8_t>(200 + Inner);
    });
    ASSERT_EQ(queue().enqueueWriteImage(Image, CL_TRUE, S.Origin, S.Region, 0,
                                        0, Part.data()),
              CL_SUCCESS);
    EXPECT_EQ(contents(Image, S), All) << S.Type;
  }
}

TEST_F(EveryShape, ARegionOutsideIsRefused) {
  for (const Shape &S : Shapes) {
    const cl::Image2D Image = create(S, CL_MEM_READ_WRITE, nullptr);
    std::vector<uint8_t> Part(2 * texelsOf(S.Size));
    for (unsigned I = 0; I < 3; ++I) {
      std::array<std::size_t, 3> Region = S.Region;
      for (const std::size_t Wrong :
           {std::size_t{0}, S.Size[I] - S.Origin[I] + 1, SIZE_MAX}) {
        Region[I] = Wrong;
        EXPECT_EQ(queue().enqueueReadImage(Image, CL_TRUE, S.Origin, Region, 0,
                                           0, Part.data()),
                  CL_INVALID_VALUE)
            << S.Type << ", dimension " << I;
      }
    }
  }
}

TEST_F(EveryShape, ImagesAndBuffersAreCopied) {
  for (const Shape &S : Shapes) {
    std::vector<uint8_t> All = counting(texelsOf(S.Size));
    std::vector<uint8_t> Expected(All.size(), 255), Packed(texelsOf(S.Region));
    forRegion(S, [&](std::size_t Outer, std::size_t Inner) {
      Expected[Outer] = Packed[Inner] = All[Outer];
    });
    const cl::Image2D From =
        create(S, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, All.data());
    std::vector<uint8_t> Blank(All.size(), 255);
    const cl::Image2D To =
        create(S, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, Blank.data());
    ASSERT_EQ(queue().enqueueCopyImage(From, To, S.Origin, S.Origin, S.Region),
              CL_SUCCESS);
    EXPECT_EQ(contents(To, S), Expected) << S.Type;

    const cl::Buffer Buffer(Device.context(), CL_MEM_READ_WRITE,
                            8 + Packed.size());
    ASSERT_EQ(
        queue().enqueueCopyImageToBuffer(From, Buffer, S.Origin, S.Region, 8),
        CL_SUCCESS);
    std::vector<uint8_t> Bytes =
        Device.download<uint8_t>(Buffer, 8 + Packed.size());
    Bytes.erase(Bytes.begin(), Bytes.begin() + 8);
    EXPECT_EQ(Bytes, Packed) << S.Type;

    const cl::Image2D Back =
        create(S, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, Blank.data());
    ASSERT_EQ(
        queue().enqueueCopyBufferToImage(Buffer, Back, 8, S.Origin, S.Region),
        CL_SUCCESS);
    EXPECT_EQ(contents(Back, S), Expected) << S.Type;
  }
}

TEST_F(EveryShape, RegionsAreFilledAndMapped) {
  for (const Shape &S : Shapes) {
    std::vector<uint8_t> All = counting(texelsOf(S.Size));
    const cl::Image2D Image =
        create(S, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, All.data());
    ASSERT_EQ(queue().enqueueFillImage(Image, cl_uint4{{240, 1, 2, 3}},
                                       S.Origin, S.Region),
              CL_SUCCESS);
    forRegion(S, [&](std::size_t Outer, std::size_t) { All[Outer] = 240; });
    EXPECT_EQ(contents(Image, S), All) << S.Type;

    std::size_t RowPitch = 0, SlicePitch = 0;
    auto *Mapped = static_cast<uint8_t *>(
        queue().enqueueMapImage(Image, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE,
                                S.Origin, S.Region, &RowPitch, &SlicePitch));
    ASSERT_NE(Mapped, nullptr);
    forRegion(S, [&](std::size_t Outer, std::size_t Inner) {
      const std::size_t X = Inner % S.Region[0];
      const std::size_t Y = Inner / S.Region[0] % S.Region[1];
      const std::size_t Z = Inner / S.Region[0] / S.Region[1];
      EXPECT_EQ(Mapped[X + Y * RowPitch + Z * SlicePitch], 240) << S.Type;
      Mapped[X + Y * RowPitch + Z * SlicePitch] = All[Outer] =
          static_cast<uint8_t>(Inner);
    });
    ASSERT_EQ(queue().enqueueUnmapMemObject(Image, Mapped), CL_SUCCESS);
    EXPECT_EQ(contents(Image, S), All) << S.Type;
  }
}

TEST_F(EveryShape, TheProgramsOwnMemoryIsUsedWithItsPitch) {
  for (const Shape &S : Shapes) {
    const std::size_t Pitch = S.Size[0] + 3;
    std::vector<uint8_t> Own = counting(Pitch * S.Size[1] * S.Size[2]);
    const std::vector<uint8_t> Before = Own;
    const cl::Image2D Image =
        create(S, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, Own.data(), Pitch);
    std::vector<uint8_t> Texels = contents(Image, S);
    for (std::size_t I = 0; I < Texels.size(); ++I)
      EXPECT_EQ(Texels[I], Before[I / S.Size[0] * Pitch + I % S.Size[0]])
          << S.Type;

    ASSERT_EQ(queue().enqueueFillImage(Image, cl_uint4{{9, 9, 9, 9}}, S.Origin,
                                       S.Region),
              CL_SUCCESS);
    std::size_t RowPitch = 0, SlicePitch = 0;
    const auto *Mapped = static_cast<uint8_t *>(
        queue().enqueueMapImage(Image, CL_TRUE, CL_MAP_READ, {0, 0, 0}, S.Size,
                                &RowPitch, &SlicePitch));
    EXPECT_EQ(Mapped, Own.data());
    EXPECT_EQ(RowPitch, Pitch);
    forRegion(S, [&](std::size_t Outer, std::size_t) {
      EXPECT_EQ(Own[Outer / S.Size[0] * Pitch + Outer % S.Size[0]], 9)
          << S.Type;
    });
    ASSERT_EQ(queue().enqueueUnmapMemObject(Image, Own.data()), CL_SUCCESS);
    ASSERT_EQ(queue().finish(), CL_SUCCESS);
  }
}

TEST_F(ImageCommands, AFillColourIsRoundedAndSaturated) {
  const cl::Image2D Image(Device.context(), CL_MEM_READ_WRITE,
                          cl::ImageFormat(CL_RGBA, CL_UNORM_INT8), 1, 1);
  std::array<uint8_t, 4> Texel{};
  const auto Filled = [&](cl_float4 Color) {
    EXPECT_EQ(queue().enqueueFillImage(Image, Color, {0, 0, 0}, {1, 1, 1}),
              CL_SUCCESS);
    EXPECT_EQ(queue().enqueueReadImage(Image, CL_TRUE, {0, 0, 0}, {1, 1, 1}, 0,
                                       0, Texel.data()),
              CL_SUCCESS);
    return Texel;
  };
  EXPECT_EQ(Filled({{0.999F, 0.0029F, 1e20F, -1e20F}}),
            (std::array<uint8_t, 4>{255, 1, 255, 0}));
}

TEST_F(ImageCommands, AFillColourOfSrgbIsLinear) {
  constexpr cl_channel_order BlueFirst = 0x10C2; // CL_sBGRA of OpenCL 2.0
  const cl::Image2D Image(Device.context(), CL_MEM_READ_WRITE,
                          cl::ImageFormat(BlueFirst, CL_UNORM_INT8), 1, 1);
  const cl_float4 Color = {{1, 0.2F, 0.001F, 0.5F}};
  EXPECT_EQ(queue().enqueueFillImage(Image, Color, {0, 0, 0}, {1, 1, 1}),
            CL_SUCCESS);
  std::array<uint8_t, 4> Texel{};
  EXPECT_EQ(queue().enqueueReadImage(Image, CL_TRUE, {0, 0, 0}, {1, 1, 1}, 0, 0,
                                     Texel.data()),
            CL_SUCCESS);
  EXPECT_EQ(Texel, (std::array<uint8_t, 4>{3, 124, 255, 128}));
}

TEST_F(ImageCommands, ASamplerCanBeReleasedWhenItsKernelIsEnqueued) {
  const cl::Program Program = Device.build(R"(
kernel void sample(read_only image1d_t in, sampler_t s, global float *out) {
  *out = read_imagef(in, s, 0.5f).x;
}
)");
  std::vector<float> Texels = {1, 3};
  const cl::Image1D Image(Device.context(),
                          CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                          cl::ImageFormat(CL_R, CL_FLOAT), 2, Texels.data());
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 4);
  const cl::UserEvent Go(Device.context());
  const std::vector<cl::Event> Waits = {Go};
  cl::Kernel Kernel(Program, "sample");
  {
    const cl::Sampler Sampler(Device.context(), CL_TRUE, CL_ADDRESS_CLAMP,
                              CL_FILTER_LINEAR);
    Kernel.setArg(0, Image);
    Kernel.setArg(1, Sampler);
    Kernel.setArg(2, Out);
    ASSERT_EQ(queue().enqueueNDRangeKernel(Kernel, cl::NullRange,
                                           cl::NDRange(1), cl::NDRange(1),
                                           &Waits),
              CL_SUCCESS);
  }
  cl::UserEvent(Go).setStatus(CL_COMPLETE);
  EXPECT_EQ(queue().finish(), CL_SUCCESS);
  EXPECT_EQ(Device.download<float>(Out, 1), std::vector<float>{2});
}

} // namespace
