/// What kernels read from images and write to them, against the formulas of the
/// standard, computed here in double precision.

#include "TestDevice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

using vorion::test::TestDevice;

namespace {

// --- Formats

unsigned channelsOf(cl_channel_order Order) {
  return Order == CL_R ? 1 : Order == CL_RG ? 2 : 4;
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
    std::string Log;
    Program = Device.build(FormatKernels, Log);
    ASSERT_EQ(Log, "");
    ASSERT_EQ(Device.context().getSupportedImageFormats(
                  CL_MEM_READ_WRITE, CL_MEM_OBJECT_IMAGE2D, &Formats),
              CL_SUCCESS);
    std::erase_if(Formats, [](const cl::ImageFormat &Format) {
      return Format.image_channel_order == CL_DEPTH;
    });
    ASSERT_GE(Formats.size(), 11U);
    for (const cl_channel_order Order : {SRgba, SBgra})
      EXPECT_EQ(std::count_if(Formats.begin(), Formats.end(),
                              [&](const cl::ImageFormat &Format) {
                                return Format.image_channel_order == Order;
                              }),
                1);
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

// --- Samplers

constexpr std::array<int, 3> Size = {7, 5, 3};

/// A number for each texel of an image of one channel.
float texelAt(const std::vector<float> &All, std::array<int, 3> At, int Dims) {
  std::size_t Index = 0;
  for (int D = Dims - 1; D >= 0; --D) {
    if (At[D] < 0 || At[D] >= Size[D])
      return 0; // the border
    Index = Index * Size[D] + At[D];
  }
  return All[Index];
}

struct Place {
  int First, Second;
  double Weight;
  bool Doubtful; // so near to an edge that rounding decides
};

Place placeOf(double S, int Length, bool Normalized, cl_addressing_mode Mode,
              bool Linear) {
  double U = S;
  if (Normalized && Mode == CL_ADDRESS_REPEAT)
    U = (S - std::floor(S)) * Length;
  else if (Normalized && Mode == CL_ADDRESS_MIRRORED_REPEAT)
    U = std::abs(S - 2 * std::rint(0.5 * S)) * Length;
  else if (Normalized)
    U = S * Length;
  if (Linear)
    U -= 0.5;
  Place P{};
  P.First = static_cast<int>(std::floor(U));
  P.Weight = U - P.First;
  P.Doubtful = P.Weight < 1e-4 || P.Weight > 1 - 1e-4;
  P.Second = P.First + 1;
  for (int *I : {&P.First, &P.Second}) {
    if (Mode == CL_ADDRESS_REPEAT)
      *I = (*I + Length) % Length;
    else if (Mode == CL_ADDRESS_CLAMP)
      *I = std::clamp(*I, -1, Length);
    else
      *I = std::clamp(*I, 0, Length - 1);
  }
  return P;
}

struct Sampling {
  int Dims;
  bool Normalized;
  cl_addressing_mode Mode;
  cl_filter_mode Filter;
};

/// What a sampler gives, and false if rounding decides it.
bool sampled(const std::vector<float> &All, const float *At, const Sampling &S,
             double &Value) {
  const bool Linear = S.Filter == CL_FILTER_LINEAR;
  std::array<Place, 3> Places{};
  for (int D = 0; D < S.Dims; ++D) {
    Places[D] = placeOf(At[D], Size[D], S.Normalized, S.Mode, Linear);
    if (Places[D].Doubtful && !Linear)
      return false;
  }
  Value = 0;
  for (int Corner = 0; Corner < (Linear ? 1 << S.Dims : 1); ++Corner) {
    std::array<int, 3> Texel{};
    double Share = 1;
    for (int D = 0; D < S.Dims; ++D) {
      const bool Second = Corner >> D & 1;
      Texel[D] = Second ? Places[D].Second : Places[D].First;
      if (Linear)
        Share *= Second ? Places[D].Weight : 1 - Places[D].Weight;
    }
    Value += Share * texelAt(All, Texel, S.Dims);
  }
  return true;
}

const std::string SampleKernels = R"(
kernel void sample1(read_only image1d_t in, sampler_t s, global const float4 *at, global float *out) {
  int i = get_global_id(0);
  out[i] = read_imagef(in, s, at[i].x).x;
}
kernel void sample2(read_only image2d_t in, sampler_t s, global const float4 *at, global float *out) {
  int i = get_global_id(0);
  out[i] = read_imagef(in, s, at[i].xy).x;
}
kernel void sample3(read_only image3d_t in, sampler_t s, global const float4 *at, global float *out) {
  int i = get_global_id(0);
  out[i] = read_imagef(in, s, at[i]).x;
}
)";

class Samplers : public testing::Test {
protected:
  void SetUp() override {
    VORION_REQUIRE_DEVICE(Device);
    std::string Log;
    Program = Device.build(SampleKernels, Log);
    ASSERT_EQ(Log, "");
  }
  cl::Memory image(int Dims, std::vector<float> &All) const {
    const cl::ImageFormat Format(CL_R, CL_FLOAT);
    const cl_mem_flags Flags = CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR;
    if (Dims == 1)
      return cl::Image1D(Device.context(), Flags, Format, Size[0], All.data());
    if (Dims == 2)
      return cl::Image2D(Device.context(), Flags, Format, Size[0], Size[1], 0,
                         All.data());
    return cl::Image3D(Device.context(), Flags, Format, Size[0], Size[1],
                       Size[2], 0, 0, All.data());
  }
  void compare(const Sampling &S) const {
    constexpr std::size_t Count = 512;
    std::mt19937 Random(3);
    std::vector<float> All(static_cast<std::size_t>(Size[0]) * Size[1] *
                           Size[2]);
    for (float &Texel : All)
      Texel = std::uniform_real_distribution<float>(0.25F, 1)(Random);
    // From left of the image to right of it.
    std::vector<float> At(4 * Count);
    for (std::size_t I = 0; I < At.size(); ++I)
      At[I] = std::uniform_real_distribution<float>(-2, 3)(Random) *
              static_cast<float>(S.Normalized ? 1 : Size[I % 4 % 3]);
    const cl::Memory Image = image(S.Dims, All);
    const cl::Sampler Sampler(Device.context(), S.Normalized, S.Mode, S.Filter);
    const cl::Buffer In = Device.upload(At);
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 4 * Count);
    cl::Kernel Kernel(Program, ("sample" + std::to_string(S.Dims)).c_str());
    Kernel.setArg(0, Image);
    Kernel.setArg(1, Sampler);
    Kernel.setArg(2, In);
    Kernel.setArg(3, Out);
    Device.run(Kernel, Count, 64);
    const auto Results = Device.download<float>(Out, Count);
    std::size_t Compared = 0;
    for (std::size_t I = 0; I < Count; ++I) {
      double Value;
      if (!sampled(All, &At[4 * I], S, Value))
        continue;
      ++Compared;
      ASSERT_NEAR(Results[I], Value, 2e-5)
          << S.Dims << "D, normalized " << S.Normalized << ", mode " << S.Mode
          << ", filter " << S.Filter << " at " << At[4 * I] << ' '
          << At[4 * I + 1] << ' ' << At[4 * I + 2];
    }
    EXPECT_GT(Compared, Count * 9 / 10);
  }
  TestDevice Device;
  cl::Program Program;
};

TEST_F(Samplers, AddressAndFilterAsTheStandardSays) {
  for (const int Dims : {1, 2, 3})
    for (const cl_filter_mode Filter : {CL_FILTER_NEAREST, CL_FILTER_LINEAR}) {
      for (const bool Normalized : {false, true})
        for (const cl_addressing_mode Mode :
             {CL_ADDRESS_CLAMP, CL_ADDRESS_CLAMP_TO_EDGE})
          compare({Dims, Normalized, Mode, Filter});
      for (const cl_addressing_mode Mode :
           {CL_ADDRESS_REPEAT, CL_ADDRESS_MIRRORED_REPEAT})
        compare({Dims, true, Mode, Filter});
    }
}

TEST_F(Samplers, CoordinatesThatAreNoNumbersDoNoHarm) {
  std::vector<float> All(Size[0], 1.0F);
  const std::vector<float> At = {NAN,       0, 0, 0, INFINITY, 0, 0, 0,
                                 -INFINITY, 0, 0, 0, 1e30F,    0, 0, 0};
  const cl::Memory Image = image(1, All);
  const cl::Buffer In = Device.upload(At);
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, At.size());
  for (const cl_addressing_mode Mode :
       {CL_ADDRESS_NONE, CL_ADDRESS_CLAMP, CL_ADDRESS_CLAMP_TO_EDGE,
        CL_ADDRESS_REPEAT, CL_ADDRESS_MIRRORED_REPEAT}) {
    const cl::Sampler Sampler(Device.context(), CL_TRUE, Mode,
                              CL_FILTER_LINEAR);
    cl::Kernel Kernel(Program, "sample1");
    Kernel.setArg(0, Image);
    Kernel.setArg(1, Sampler);
    Kernel.setArg(2, In);
    Kernel.setArg(3, Out);
    Device.run(Kernel, At.size() / 4, 1);
  }
}

TEST_F(Samplers, OfFormatsWithoutAlphaHaveAnOpaqueBorder) {
  std::string Log;
  const cl::Program Border = Device.build(R"(
constant sampler_t outside = CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_CLAMP | CLK_FILTER_NEAREST;
kernel void border(read_only image2d_t in, global float4 *out) {
  out[0] = read_imagef(in, outside, (int2)(-1, 0));
  out[1] = read_imagef(in, outside, (float2)(0, 99));
}
)",
                                          Log);
  ASSERT_EQ(Log, "");
  for (const cl_channel_order Order : {CL_R, CL_RG, CL_RGBA}) {
    const cl::Image2D Image(Device.context(), CL_MEM_READ_ONLY,
                            cl::ImageFormat(Order, CL_FLOAT), 2, 2);
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 32);
    cl::Kernel Kernel(Border, "border");
    Kernel.setArg(0, Image);
    Kernel.setArg(1, Out);
    Device.run(Kernel, 1, 1);
    const float Alpha = Order == CL_RGBA ? 0 : 1;
    EXPECT_EQ(Device.download<float>(Out, 8),
              (std::vector<float>{0, 0, 0, Alpha, 0, 0, 0, Alpha}));
  }
}

} // namespace
