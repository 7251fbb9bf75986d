/// What kernels read from images of every format and write to them, against the
/// formulas of the standard, computed here in double precision.

#include "TestDevice.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <utility>
#include <vector>

using vorion::test::TestDevice;

namespace {

unsigned channelsOf(cl_channel_order Order) {
  switch (Order) {
  case CL_R:
  case CL_INTENSITY:
  case CL_LUMINANCE:
    return 1;
  case CL_RG:
    return 2;
  default:
    return 4;
  }
}

unsigned bytesOf(cl_channel_type Type) {
  switch (Type) {
  case CL_SNORM_INT8:
  case CL_UNORM_INT8:
  case CL_SIGNED_INT8:
  case CL_UNSIGNED_INT8:
    return 1;
  case CL_SIGNED_INT32:
  case CL_UNSIGNED_INT32:
  case CL_FLOAT:
    return 4;
  default:
    return 2;
  }
}

/// The letter that names the functions for a type: f, i or u.
char kindOf(cl_channel_type Type) {
  if (Type >= CL_SIGNED_INT8 && Type <= CL_SIGNED_INT32)
    return 'i';
  return Type >= CL_UNSIGNED_INT8 && Type <= CL_UNSIGNED_INT32 ? 'u' : 'f';
}

double halfValue(uint32_t Bits) {
  const int Exponent = Bits >> 10 & 31, Fraction = Bits & 1023;
  const double Size = Exponent ? std::ldexp(1024 + Fraction, Exponent - 25)
                               : std::ldexp(Fraction, -24);
  return Bits & 0x8000 ? -Size : Size;
}

/// The value of a channel's bits.
double decoded(uint32_t Bits, cl_channel_type Type) {
  switch (Type) {
  case CL_SNORM_INT8:
    return std::max(static_cast<int8_t>(Bits) / 127.0, -1.0);
  case CL_SNORM_INT16:
    return std::max(static_cast<int16_t>(Bits) / 32767.0, -1.0);
  case CL_UNORM_INT8:
    return Bits / 255.0;
  case CL_UNORM_INT16:
    return Bits / 65535.0;
  case CL_SIGNED_INT8:
    return static_cast<int8_t>(Bits);
  case CL_SIGNED_INT16:
    return static_cast<int16_t>(Bits);
  case CL_SIGNED_INT32:
    return static_cast<int32_t>(Bits);
  case CL_HALF_FLOAT:
    return halfValue(Bits);
  case CL_FLOAT: {
    float Value;
    std::memcpy(&Value, &Bits, sizeof(Value));
    return Value;
  }
  default:
    return Bits;
  }
}

uint32_t channelBits(const std::vector<uint8_t> &Texels, std::size_t Channel,
                     unsigned Bytes) {
  uint32_t Bits = 0;
  std::memcpy(&Bits, &Texels[Channel * Bytes], Bytes);
  return Bits;
}

/// Of OpenCL 2.0, whose names are hidden here.
constexpr cl_channel_order SRgba = 0x10C1, SBgra = 0x10C2;

bool isSrgb(cl_channel_order Order) { return Order == SRgba || Order == SBgra; }

/// The standard's formulas, from a channel's value to the linear one and back.
double fromSrgb(double S) {
  return S <= 0.04045 ? S / 12.92 : std::pow((S + 0.055) / 1.055, 2.4);
}
double toSrgb(double Linear) {
  return Linear < 0.0031308 ? 12.92 * Linear
                            : 1.055 * std::pow(Linear, 1 / 2.4) - 0.055;
}

/// A texel as read_image gives it.
std::array<double, 4> decodedTexel(const std::vector<uint8_t> &Texels,
                                   std::size_t Index, cl_image_format Format) {
  std::array<double, 4> Color = {0, 0, 0, 1};
  const unsigned Channels = channelsOf(Format.image_channel_order);
  const unsigned Bytes = bytesOf(Format.image_channel_data_type);
  for (unsigned C = 0; C < Channels; ++C)
    Color[C] = decoded(channelBits(Texels, Index * Channels + C, Bytes),
                       Format.image_channel_data_type);
  if (isSrgb(Format.image_channel_order))
    for (unsigned C = 0; C < 3; ++C)
      Color[C] = fromSrgb(Color[C]);
  if (Format.image_channel_order == CL_BGRA ||
      Format.image_channel_order == SBgra)
    std::swap(Color[0], Color[2]);
  if (Format.image_channel_order == CL_INTENSITY)
    Color.fill(Color[0]);
  if (Format.image_channel_order == CL_LUMINANCE)
    Color[1] = Color[2] = Color[0];
  return Color;
}

constexpr std::size_t Texels = 256;

/// Random bits, without the infinities and NaNs of floating-point types.
std::vector<uint8_t> randomTexels(cl_image_format Format) {
  const cl_channel_type Type = Format.image_channel_data_type;
  std::mt19937 Random(1);
  std::vector<uint8_t> Bytes(Texels * channelsOf(Format.image_channel_order) *
                             bytesOf(Type));
  for (uint8_t &Byte : Bytes)
    Byte = static_cast<uint8_t>(Random());
  for (std::size_t I = bytesOf(Type) - 1; I < Bytes.size(); I += bytesOf(Type))
    if ((Type == CL_HALF_FLOAT && (Bytes[I] & 0x7C) == 0x7C) ||
        (Type == CL_FLOAT && (Bytes[I] & 0x7F) == 0x7F))
      Bytes[I] = 0x3A;
  return Bytes;
}

const std::string FormatKernels = R"(
kernel void read_f(read_only image2d_t in, global float4 *out) {
  int x = get_global_id(0);
  out[x] = read_imagef(in, (int2)(x & 15, x >> 4));
}
kernel void read_i(read_only image2d_t in, global int4 *out) {
  int x = get_global_id(0);
  out[x] = read_imagei(in, (int2)(x & 15, x >> 4));
}
kernel void read_u(read_only image2d_t in, global uint4 *out) {
  int x = get_global_id(0);
  out[x] = read_imageui(in, (int2)(x & 15, x >> 4));
}
kernel void write_f(write_only image2d_t out, global const float4 *in) {
  int x = get_global_id(0);
  write_imagef(out, (int2)(x & 15, x >> 4), in[x]);
}
kernel void write_i(write_only image2d_t out, global const int4 *in) {
  int x = get_global_id(0);
  write_imagei(out, (int2)(x & 15, x >> 4), in[x]);
}
kernel void write_u(write_only image2d_t out, global const uint4 *in) {
  int x = get_global_id(0);
  write_imageui(out, (int2)(x & 15, x >> 4), in[x]);
}
)";

std::string nameOf(cl_image_format Format) {
  return "format " + std::to_string(Format.image_channel_order) + ", " +
         std::to_string(Format.image_channel_data_type);
}

double valueOf(uint32_t Bits, char Kind) {
  return decoded(Bits, Kind == 'f'   ? CL_FLOAT
                       : Kind == 'i' ? CL_SIGNED_INT32
                                     : CL_UNSIGNED_INT32);
}

class ImageFormats : public testing::Test {
protected:
  void SetUp() override {
    VORION_REQUIRE_DEVICE(Device);
    Program = Device.build(FormatKernels);
    ASSERT_EQ(Device.context().getSupportedImageFormats(
                  CL_MEM_READ_WRITE, CL_MEM_OBJECT_IMAGE2D, &Formats),
              CL_SUCCESS);
    std::erase_if(Formats, [](const cl::ImageFormat &Format) {
      return Format.image_channel_order == CL_DEPTH;
    });
    ASSERT_GE(Formats.size(), 11U);
    for (const auto &[Order, Types] : {std::pair(SRgba, 1),
                                       {SBgra, 1},
                                       {CL_INTENSITY, 6},
                                       {CL_LUMINANCE, 6}})
      EXPECT_EQ(std::count_if(Formats.begin(), Formats.end(),
                              [&](const cl::ImageFormat &Format) {
                                return Format.image_channel_order == Order;
                              }),
                Types);
  }
  TestDevice Device;
  cl::Program Program;
  std::vector<cl::ImageFormat> Formats;
};

TEST_F(ImageFormats, EveryFormatIsReadAsTheStandardSays) {
  for (const cl::ImageFormat &Format : Formats) {
    const char Kind = kindOf(Format.image_channel_data_type);
    std::vector<uint8_t> Bytes = randomTexels(Format);
    const cl::Image2D Image(Device.context(),
                            CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, Format, 16,
                            Texels / 16, 0, Bytes.data());
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 16 * Texels);
    cl::Kernel Kernel(Program, (std::string("read_") + Kind).c_str());
    Kernel.setArg(0, Image);
    Kernel.setArg(1, Out);
    Device.run(Kernel, Texels, 64);
    const auto Colors = Device.download<uint32_t>(Out, 4 * Texels);
    for (std::size_t I = 0; I < Texels; ++I) {
      const std::array<double, 4> Color = decodedTexel(Bytes, I, Format);
      for (unsigned C = 0; C < 4; ++C)
        ASSERT_EQ(valueOf(Colors[4 * I + C], Kind),
                  Kind == 'f' ? static_cast<float>(Color[C]) : Color[C])
            << nameOf(Format) << ", channel " << C << " of texel " << I;
    }
  }
}

/// Values around the ends of what a type can hold, and in between.
std::vector<uint32_t> colorsFor(cl_channel_type Type) {
  std::mt19937 Random(2);
  std::vector<uint32_t> Colors(4 * Texels);
  for (uint32_t &Bits : Colors) {
    if (kindOf(Type) == 'f') {
      const float Value =
          std::uniform_real_distribution<float>(-1.5F, 1.5F)(Random);
      std::memcpy(&Bits, &Value, sizeof(Bits));
    } else {
      const uint32_t Value = Random() >> Random() % 32;
      Bits = Random() % 2 ? Value : -Value;
    }
  }
  return Colors;
}

/// How far the value of a channel may be from what was written there.
double toleranceOf(cl_channel_type Type, double Wanted) {
  switch (Type) {
  case CL_SNORM_INT8:
    return 0.5001 / 127;
  case CL_UNORM_INT8:
    return 0.5001 / 255;
  case CL_SNORM_INT16:
    return 0.5001 / 32767;
  case CL_UNORM_INT16:
    return 0.5001 / 65535;
  case CL_HALF_FLOAT:
    return std::max(std::abs(Wanted) / 2048, 0x1p-25);
  default:
    return 0;
  }
}

/// The nearest to \p Value that the type has.
double saturated(double Value, cl_channel_type Type) {
  switch (Type) {
  case CL_SNORM_INT8:
  case CL_SNORM_INT16:
    return std::clamp(Value, -1.0, 1.0);
  case CL_UNORM_INT8:
  case CL_UNORM_INT16:
    return std::clamp(Value, 0.0, 1.0);
  case CL_SIGNED_INT8:
    return std::clamp(Value, -128.0, 127.0);
  case CL_SIGNED_INT16:
    return std::clamp(Value, -32768.0, 32767.0);
  case CL_UNSIGNED_INT8:
    return std::min(Value, 255.0);
  case CL_UNSIGNED_INT16:
    return std::min(Value, 65535.0);
  default:
    return Value;
  }
}

TEST_F(ImageFormats, EveryFormatIsWrittenAsTheStandardSays) {
  for (const cl::ImageFormat &Format : Formats) {
    const cl_channel_type Type = Format.image_channel_data_type;
    const char Kind = kindOf(Type);
    const std::vector<uint32_t> Colors = colorsFor(Type);
    const cl::Image2D Image(Device.context(), CL_MEM_WRITE_ONLY, Format, 16,
                            Texels / 16);
    const cl::Buffer In = Device.upload(Colors);
    cl::Kernel Kernel(Program, (std::string("write_") + Kind).c_str());
    Kernel.setArg(0, Image);
    Kernel.setArg(1, In);
    Device.run(Kernel, Texels, 64);
    const std::vector<uint8_t> Bytes = Device.download<uint8_t>(
        Image, {16, Texels / 16, 1}, randomTexels(Format).size());
    for (std::size_t I = 0; I < Texels; ++I) {
      const std::array<double, 4> Color = decodedTexel(Bytes, I, Format);
      for (unsigned C = 0; C < channelsOf(Format.image_channel_order); ++C) {
        double Is = Color[C],
               Wanted = saturated(valueOf(Colors[4 * I + C], Kind), Type);
        if (isSrgb(Format.image_channel_order) && C < 3) {
          Is = toSrgb(Is);
          Wanted = toSrgb(Wanted);
        }
        ASSERT_NEAR(Is, Wanted, toleranceOf(Type, Wanted))
            << nameOf(Format) << ", channel " << C << " of texel " << I;
      }
    }
  }
}

/// Colours around the values at which the conversion to a type of channels
/// rounds or saturates, and special numbers. Each is in every channel once.
std::vector<uint32_t> edgesOf(cl_channel_type Type) {
  std::vector<uint32_t> Edges;
  if (kindOf(Type) == 'f') {
    std::vector<float> Values = {0.0F,    NAN,      INFINITY,     1e20F,
                                 1e-40F,  65504.0F, 65520.0F,     2049.0F,
                                 2051.0F, 0x1p-14F, 0x1.ffep-15F, 0x1.8p-24F,
                                 0x1p-25F};
    for (const float Most : {127.0F, 255.0F, 32767.0F, 65535.0F})
      for (const float Step :
           {0.5F, 1.5F, 2.5F, Most / 2, Most - 0.5F, Most, Most + 1.0F})
        Values.push_back(Step / Most);
    for (const float Value : Values)
      for (const float Near : {Value, std::nextafter(Value, 0.0F),
                               std::nextafter(Value, INFINITY)})
        for (const float Signed : {Near, -Near})
          Edges.push_back(std::bit_cast<uint32_t>(Signed));
  } else {
    for (const unsigned Bit : {0, 7, 8, 15, 16, 31})
      for (const uint32_t Beside : {-1, 0, 1}) {
        Edges.push_back((1U << Bit) + Beside);
        Edges.push_back(-(1U << Bit) + Beside);
      }
  }
  std::vector<uint32_t> Colors(4 * Texels);
  for (std::size_t I = 0; I < Colors.size(); ++I)
    Colors[I] = Edges[(I / 4 + I % 4) % Edges.size()];
  return Colors;
}

TEST_F(ImageFormats, EveryFormatIsFilledAsKernelsWriteIt) {
  for (const cl::ImageFormat &Format : Formats) {
    const cl_channel_type Type = Format.image_channel_data_type;
    const std::vector<uint32_t> Colors = edgesOf(Type);
    std::array<cl::Image2D, 2> Images;
    for (cl::Image2D &Image : Images)
      Image = cl::Image2D(Device.context(), CL_MEM_READ_WRITE, Format, 16,
                          Texels / 16);
    const cl::Buffer In = Device.upload(Colors);
    cl::Kernel Kernel(Program, (std::string("write_") + kindOf(Type)).c_str());
    Kernel.setArg(0, Images[0]);
    Kernel.setArg(1, In);
    Device.run(Kernel, Texels, 64);
    for (std::size_t I = 0; I < Texels; ++I)
      ASSERT_EQ(clEnqueueFillImage(
                    Device.queue()(), Images[1](), &Colors[4 * I],
                    std::array<std::size_t, 3>{I % 16, I / 16, 0}.data(),
                    std::array<std::size_t, 3>{1, 1, 1}.data(), 0, nullptr,
                    nullptr),
                CL_SUCCESS);
    const std::size_t Size = randomTexels(Format).size();
    const auto Written =
        Device.download<uint8_t>(Images[0], {16, Texels / 16, 1}, Size);
    const auto Filled =
        Device.download<uint8_t>(Images[1], {16, Texels / 16, 1}, Size);
    const unsigned Bytes = bytesOf(Type);
    // All NaNs are one to a half.
    const auto BitsOf = [&](const std::vector<uint8_t> &Texels, std::size_t I) {
      const uint32_t Bits = channelBits(Texels, I, Bytes);
      return Type == CL_HALF_FLOAT && (Bits & 0x7fff) > 0x7c00 ? 0x7e00 : Bits;
    };
    for (std::size_t I = 0; I < Size / Bytes; ++I)
      ASSERT_EQ(BitsOf(Filled, I), BitsOf(Written, I))
          << nameOf(Format) << ", channel " << I % (Size / Bytes / Texels)
          << " of color " << I / (Size / Bytes / Texels);
  }
}

/// Outside of an image, and on its edge, where a linear filter mixes its border
/// with a texel.
TEST_F(ImageFormats, BordersAreOpaqueWhereTexelsHaveNoAlpha) {
  const cl::Program Program = Device.build(R"(
constant sampler_t clamped = CLK_ADDRESS_CLAMP | CLK_FILTER_LINEAR;
kernel void border(read_only image2d_t in, global float4 *out) {
  out[0] = read_imagef(in, clamped, (float2)(-4, 0.5f));
  out[1] = read_imagef(in, clamped, (float2)(0, 0.5f));
  out[2] = read_imagef(in, clamped, (int2)(-1, 0));
})");
  for (const auto &[Order, IsOpaque] : {std::pair(CL_R, true),
                                        {CL_RG, true},
                                        {CL_RGBA, false},
                                        {CL_BGRA, false},
                                        {CL_INTENSITY, false},
                                        {CL_LUMINANCE, true}}) {
    std::vector<uint8_t> Bytes(
        4 * channelsOf(static_cast<cl_channel_order>(Order)), 255);
    const cl::Image2D Image(
        Device.context(), CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
        cl::ImageFormat(static_cast<cl_channel_order>(Order), CL_UNORM_INT8), 2,
        2, 0, Bytes.data());
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 48);
    cl::Kernel Kernel(Program, "border");
    Kernel.setArg(0, Image);
    Kernel.setArg(1, Out);
    Device.run(Kernel, 1, 1);
    const auto Colors = Device.download<float>(Out, 12);
    for (const int Outside : {0, 8}) {
      EXPECT_EQ(Colors[Outside], 0) << Order;
      EXPECT_EQ(Colors[Outside + 3], IsOpaque ? 1 : 0) << Order;
    }
    EXPECT_EQ(Colors[4], 0.5F) << Order;
    EXPECT_EQ(Colors[7], IsOpaque ? 1 : 0.5F) << Order;
  }
}

/// To nearest even, to infinity from halfway between the largest half and
/// 2^16 on.
TEST_F(ImageFormats, FilledHalvesAreTheNearest) {
  const std::vector<std::pair<float, uint16_t>> Cases = {
      {65519.0F, 0x7bff},     {65520.0F, 0x7c00}, {-65519.9F, 0xfbff},
      {2049.0F, 0x6800},      {2051.0F, 0x6802},  {0.1F, 0x2e66},
      {0x1p-25F, 0x0000},     {0x1.8p-24F, 2},    {0x1.000002p-25F, 1},
      {0x1.ffep-15F, 0x0400}, {-0.0F, 0x8000},    {-1e-30F, 0x8000},
      {INFINITY, 0x7c00}};
  const cl::Image2D Image(Device.context(), CL_MEM_READ_WRITE,
                          cl::ImageFormat(CL_R, CL_HALF_FLOAT), 1, 1);
  for (const auto &[Value, Bits] : Cases) {
    ASSERT_EQ(Device.queue().enqueueFillImage(
                  Image, cl_float4{{Value, 0, 0, 0}}, {0, 0, 0}, {1, 1, 1}),
              CL_SUCCESS);
    EXPECT_EQ(Device.download<uint16_t>(Image, {1, 1, 1}, 1)[0], Bits) << Value;
  }
}

} // namespace
