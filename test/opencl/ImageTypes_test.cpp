/// What kernels read from and write to images of each type: layers, depths,
/// halves, buffers; what they can ask; and what lies outside.

#include "TestDevice.h"

#include <array>
#include <cstdint>

using vorion::test::TestDevice;

namespace {

TEST(ImageTypes, LayersAreRoundedAndClamped) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
constant sampler_t s = CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_CLAMP_TO_EDGE | CLK_FILTER_NEAREST;
kernel void layers(read_only image1d_array_t a, read_only image2d_array_t b, global int *out) {
  int i = get_global_id(0);
  float layer = i - 1.4f;
  out[4 * i + 0] = read_imagei(a, s, (float2)(0, layer)).x;
  out[4 * i + 1] = read_imagei(b, s, (float4)(0, 1, layer, 0)).x;
  out[4 * i + 2] = read_imagei(a, s, (int2)(0, i - 1)).x;
  out[4 * i + 3] = read_imagei(b, s, (int4)(0, 1, i - 1, 0)).x;
}
)");
  // Layer l begins with 10 l. Those of the second image have two rows.
  std::vector<int> Lines = {0, 1, 10, 11, 20, 21};
  std::vector<int> Planes = {-1, -1, 0, 1, -1, -1, 10, 11, -1, -1, 20, 21};
  const cl::ImageFormat Format(CL_R, CL_SIGNED_INT32);
  const cl_mem_flags Flags = CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR;
  const cl::Image1DArray A(Device.context(), Flags, Format, 3, 2, 0,
                           Lines.data());
  const cl::Image2DArray B(Device.context(), Flags, Format, 3, 2, 2, 0, 0,
                           Planes.data());
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 4 * 4 * 5);
  cl::Kernel Kernel(Program, "layers");
  Kernel.setArg(0, A);
  Kernel.setArg(1, B);
  Kernel.setArg(2, Out);
  Device.run(Kernel, 5, 5);
  EXPECT_EQ(Device.download<int>(Out, 20),
            (std::vector<int>{0,  0,  0,  0,  0,  0,  0,  0,  10, 10,
                              10, 10, 20, 20, 20, 20, 20, 20, 20, 20}));
}

TEST(ImageTypes, KernelsAreToldWhatAnImageIs) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
kernel void describe(read_only image3d_t a, write_only image2d_array_t b, global int *out) {
  int4 d = get_image_dim(a);
  out[0] = d.x; out[1] = d.y; out[2] = d.z; out[3] = d.w;
  out[4] = get_image_width(b); out[5] = get_image_height(b); out[6] = get_image_array_size(b);
  out[7] = get_image_channel_order(b); out[8] = get_image_channel_data_type(b);
  out[9] = get_image_depth(a);
}
)");
  const cl::Image3D A(Device.context(), CL_MEM_READ_ONLY,
                      cl::ImageFormat(CL_R, CL_FLOAT), 7, 5, 3);
  const cl::Image2DArray B(Device.context(), CL_MEM_WRITE_ONLY,
                           cl::ImageFormat(CL_RG, CL_UNORM_INT16), 4, 9, 2, 0,
                           0);
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 40);
  cl::Kernel Kernel(Program, "describe");
  Kernel.setArg(0, A);
  Kernel.setArg(1, B);
  Kernel.setArg(2, Out);
  Device.run(Kernel, 1, 1);
  EXPECT_EQ(Device.download<int>(Out, 10),
            (std::vector<int>{7, 5, 3, 0, 9, 2, 4, CL_RG, CL_UNORM_INT16, 3}));
}

TEST(ImageTypes, HalvesAreReadAndWritten) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
#pragma OPENCL EXTENSION cl_khr_fp16 : enable
constant sampler_t s = CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_CLAMP | CLK_FILTER_LINEAR;
kernel void halves(read_only image2d_t in, write_only image2d_t out) {
  write_imageh(out, (int2)(0, 0), read_imageh(in, (int2)(1, 0)));
  write_imageh(out, (int2)(1, 0), read_imageh(in, s, (float2)(1.0f, 0.5f)));
  write_imageh(out, (int2)(2, 0), read_imageh(in, s, (int2)(0, 0)) * (half4)(2));
}
)");
  // A half has no 1/3: what is read is rounded to one.
  std::vector<float> Pixels = {1.0F / 3, 2, -3, 4, 0.5F, 0.25F, 1, 65504};
  const cl::ImageFormat Format(CL_RGBA, CL_FLOAT);
  const cl::Image2D In(Device.context(),
                       CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, Format, 2, 1, 0,
                       Pixels.data());
  const cl::Image2D Out(Device.context(), CL_MEM_WRITE_ONLY, Format, 3, 1);
  cl::Kernel Kernel(Program, "halves");
  Kernel.setArg(0, In);
  Kernel.setArg(1, Out);
  Device.run(Kernel, 1, 1);
  const auto Half = [](float X) {
    return static_cast<float>(static_cast<_Float16>(X));
  };
  EXPECT_EQ(
      Device.download<float>(Out, {3, 1, 1}, 12),
      (std::vector<float>{0.5F, 0.25F, 1, 65504, Half((1.0F / 3 + 0.5F) / 2),
                          1.125F, -1, 32752, 2 * Half(1.0F / 3), 4, -6, 8}));
}

TEST(ImageTypes, DepthsAreOneNumber) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
constant sampler_t s = CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_CLAMP | CLK_FILTER_NEAREST;
kernel void halve(read_only image2d_depth_t in, write_only image2d_array_depth_t out) {
  int2 at = (int2)(get_global_id(0), 0);
  write_imagef(out, (int4)(at, get_image_array_size(out) - 1, 0), read_imagef(in, s, at) / 2);
}
)");
  std::vector<float> Depths = {0.25F, 1};
  const cl::Image2D In(
      Device.context(), CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
      cl::ImageFormat(CL_DEPTH, CL_FLOAT), 2, 1, 0, Depths.data());
  const cl::Image2DArray Out(Device.context(), CL_MEM_WRITE_ONLY,
                             cl::ImageFormat(CL_DEPTH, CL_UNORM_INT16), 2, 2, 1,
                             0, 0);
  const cl_float Far = 1;
  ASSERT_EQ(clEnqueueFillImage(Device.queue()(), Out(), &Far,
                               std::array<std::size_t, 3>{}.data(),
                               std::array<std::size_t, 3>{2, 1, 2}.data(), 0,
                               nullptr, nullptr),
            CL_SUCCESS);
  cl::Kernel Kernel(Program, "halve");
  Kernel.setArg(0, In);
  Kernel.setArg(1, Out);
  Device.run(Kernel, 2, 2);
  EXPECT_EQ(Device.download<uint16_t>(Out, {2, 1, 2}, 4),
            (std::vector<uint16_t>{65535, 65535, 8192, 32768}));
}

TEST(ImageTypes, AnImageOfABufferIsItsMemory) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
kernel void raise(write_only image1d_buffer_t out) {
  write_imageui(out, get_global_id(0), (uint4)(get_global_id(0) * 3));
}
kernel void sum(read_only image1d_buffer_t in, global uint *out) {
  uint s = 0;
  for (int i = 0; i < get_image_width(in); ++i)
    s += read_imageui(in, i).x;
  *out = s;
}
)");
  const cl::Buffer Buffer(Device.context(), CL_MEM_READ_WRITE, 40);
  const cl::ImageFormat Format(CL_R, CL_UNSIGNED_INT32);
  const cl::Image1DBuffer Image(Device.context(), CL_MEM_READ_WRITE, Format, 10,
                                Buffer);
  cl::Kernel Raise(Program, "raise"), Sum(Program, "sum");
  Raise.setArg(0, Image);
  Device.run(Raise, 10, 5);
  EXPECT_EQ(Device.download<uint32_t>(Buffer, 3),
            (std::vector<uint32_t>{0, 3, 6}));
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 4);
  Sum.setArg(0, Image);
  Sum.setArg(1, Out);
  Device.run(Sum, 1, 1);
  EXPECT_EQ(Device.download<uint32_t>(Out, 1), (std::vector<uint32_t>{135}));
}

TEST(ImageTypes, WhatIsWrittenOutsideIsLost) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
kernel void outside(write_only image3d_t out) {
  int i = get_global_id(0) - 1;
  write_imagei(out, (int4)(i, 0, 0, 0), (int4)(1));
  write_imagei(out, (int4)(0, i + 3, 0, 0), (int4)(2));
  write_imagei(out, (int4)(0, 1, i * 1000 - 1, 0), (int4)(3));
}
)");
  std::vector<int> Before(8, 7);
  const cl::Image3D Image(
      Device.context(), CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
      cl::ImageFormat(CL_R, CL_SIGNED_INT32), 2, 2, 2, 0, 0, Before.data());
  cl::Kernel Kernel(Program, "outside");
  Kernel.setArg(0, Image);
  Device.run(Kernel, 10, 10);
  EXPECT_EQ(Device.download<int>(Image, {2, 2, 2}, 8),
            (std::vector<int>{1, 1, 7, 7, 7, 7, 7, 7}));
}

} // namespace
