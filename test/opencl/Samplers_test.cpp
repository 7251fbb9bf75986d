/// What samplers give between texels and outside of images, against the
/// formulas of the standard, computed here in double precision.

#include "TestDevice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

using vorion::test::TestDevice;

namespace {

constexpr std::array<int, 3> Size = {7, 5, 3};

/// A texel of the image \p All of one channel.
float texelAt(const std::vector<float> &All, std::array<int, 3> At, int Dims) {
  std::size_t Index = 0;
  for (int D = Dims - 1; D >= 0; --D) {
    if (At[D] < 0 || At[D] >= Size[D])
      return 0; // the border
    Index = Index * Size[D] + At[D];
  }
  return All[Index];
}

/// The texels of an axis that a coordinate is between.
struct Place {
  int First, Second;
  double Weight; ///< of Second
  bool Doubtful; ///< so near to an edge that rounding decides
};

/// Of the coordinate \p S on an axis of \p Length texels.
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
    Program = Device.build(SampleKernels);
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
  /// What a kernel reads from an image of \p All at the places \p At, of four
  /// coordinates each.
  std::vector<float> sample(std::vector<float> &All,
                            const std::vector<float> &At,
                            const Sampling &S) const {
    const std::size_t Count = At.size() / 4;
    const cl::Memory Image = image(S.Dims, All);
    const cl::Sampler Sampler(Device.context(), S.Normalized, S.Mode, S.Filter);
    const cl::Buffer In = Device.upload(At);
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 4 * Count);
    cl::Kernel Kernel(Program, ("sample" + std::to_string(S.Dims)).c_str());
    Kernel.setArg(0, Image);
    Kernel.setArg(1, Sampler);
    Kernel.setArg(2, In);
    Kernel.setArg(3, Out);
    Device.run(Kernel, Count, cl::NullRange);
    return Device.download<float>(Out, Count);
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
    const std::vector<float> Results = sample(All, At, S);
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
  for (const cl_addressing_mode Mode :
       {CL_ADDRESS_NONE, CL_ADDRESS_CLAMP, CL_ADDRESS_CLAMP_TO_EDGE,
        CL_ADDRESS_REPEAT, CL_ADDRESS_MIRRORED_REPEAT})
    sample(All, At, {1, true, Mode, CL_FILTER_LINEAR});
}

TEST_F(Samplers, OfFormatsWithoutAlphaHaveAnOpaqueBorder) {
  const cl::Program Border = Device.build(R"(
constant sampler_t outside = CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_CLAMP | CLK_FILTER_NEAREST;
kernel void border(read_only image2d_t in, global float4 *out) {
  out[0] = read_imagef(in, outside, (int2)(-1, 0));
  out[1] = read_imagef(in, outside, (float2)(0, 99));
}
)");
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
