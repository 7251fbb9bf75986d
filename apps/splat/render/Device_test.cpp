// What runs on the OpenCL device, piece by piece. Skipped where there is none.

#include "device/Kernels.h"
#include "device/OnDevice.h"
#include "kernels/adam.cl.h"
#include "kernels/merge.cl.h"
#include "kernels/scan.cl.h"
#include "kernels/sort.cl.h"
#include "kernels/tiles.cl.h"
#include "render/Plan.h"
#include "render/Sorter.h"
#include "scene/Activation.h"
#include "vorion/support/File.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <unistd.h>

namespace vorion::splat {
namespace {

/// Counts around the work-items' shares: fewer than one, exact, one over.
class SortOnDevice : public OnDevice,
                     public testing::WithParamInterface<uint32_t> {};

TEST_P(SortOnDevice, ScanSumsWhatComesBefore) {
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  L.build(kernels::scan::Program{});
  Sorter S(L);
  const uint32_t Count = GetParam();
  std::vector<uint32_t> In(Count);
  std::ranges::generate(In, [&] { return Random() % 1000; });
  const cl::Buffer Out = L.allocate("sums", 4 * (uint64_t{Count} + 1));
  S.scan(upload(L, In), Out, Count);
  std::vector<uint32_t> Want{0};
  std::partial_sum(In.begin(), In.end(), std::back_inserter(Want));
  EXPECT_EQ(download(L, Out, Count + 1), Want);
}

TEST_P(SortOnDevice, SortIsStableOnItsBits) {
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  L.build(kernels::scan::Program{});
  L.build(kernels::sort::Program{});
  Sorter S(L);
  const uint32_t Count = GetParam();
  for (const unsigned Bits : {1U, 8U, 11U, 32U}) {
    std::vector<uint32_t> Keys(Count);
    const uint32_t Mask = Bits == 32 ? ~0U : (1U << Bits) - 1;
    // Many equal keys, so that stability shows.
    std::ranges::generate(Keys,
                          [&] { return Random() % 97 * 88080001U & Mask; });
    std::vector<uint32_t> Order(Count);
    std::iota(Order.begin(), Order.end(), 0U);
    const std::vector<uint32_t> Empty(Count);
    const Sorter::Pairs In{upload(L, Keys), upload(L, Order)};
    const Sorter::Pairs A{upload(L, Empty), upload(L, Empty)};
    const Sorter::Pairs B{upload(L, Empty), upload(L, Empty)};
    std::ranges::sort(Order, {},
                      [&](uint32_t I) { return std::pair(Keys[I], I); });
    for (const auto Wanted : {Sorter::Keys::Sorted, Sorter::Keys::Lost}) {
      const Sorter::Pairs Out = S.sort(In, A, B, Count, {0, Bits}, Wanted);
      EXPECT_EQ(download(L, Out.Values, Count), Order) << Bits << " bits";
      if (Wanted == Sorter::Keys::Lost)
        continue;
      const std::vector<uint32_t> Sorted = download(L, Out.Keys, Count);
      EXPECT_TRUE(std::ranges::is_sorted(Sorted)) << Bits << " bits";
    }
    if (!Sorter::inOnePass({0, Bits}))
      continue;
    const uint32_t Number = 1U << Bits;
    const cl::Buffer Ranges = L.allocate("ranges", 8 * uint64_t{Number});
    S.rangesOfKeys(Ranges, Number);
    const std::vector<uint32_t> Got = download(L, Ranges, 2 * Number);
    uint32_t Begin = 0;
    for (uint32_t Key = 0; Key < Number; ++Key) {
      EXPECT_EQ(Got[2 * Key], Begin) << Bits << " bits, key " << Key;
      Begin += static_cast<uint32_t>(std::ranges::count(Keys, Key));
      EXPECT_EQ(Got[2 * Key + 1], Begin) << Bits << " bits, key " << Key;
    }
  }
}

// Depths as the projection leaves them: some left out, the others' bits within
// a range that asks for one to four passes, low ones of no meaning.
TEST_P(SortOnDevice, SortKeptLeavesOutAndNumbers) {
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  L.build(kernels::scan::Program{});
  L.build(kernels::sort::Program{});
  Sorter S(L);
  Sorter::KeptKeys What{GetParam(), 0, 0, 0, 0};
  constexpr uint32_t Base = 0x3e4ccccd;
  for (const uint32_t Range : {1U, 1000U, 1U << 27U, (1U << 31U) - Base})
    for (const unsigned FirstBit : {0U, 16U}) {
      std::vector<uint32_t> Keys(What.Count);
      std::vector<uint32_t> Want;
      What.Least = ~0U;
      What.Most = 0;
      What.FirstBit = FirstBit;
      for (uint32_t I = 0; I < What.Count; ++I) {
        const uint32_t Word = Random();
        Keys[I] = Word % 3 == 0 ? Word | 1U << 31U : Base + Random() % Range;
        if (Keys[I] >> 31U)
          continue;
        Want.push_back(I);
        What.Least = std::min(What.Least, Keys[I]);
        What.Most = std::max(What.Most, Keys[I]);
      }
      What.Kept = static_cast<uint32_t>(Want.size());
      const cl::Buffer Out = S.sortKept(upload(L, Keys), What);
      std::ranges::sort(Want, {}, [&](uint32_t I) {
        return std::pair(Keys[I] >> FirstBit, I);
      });
      EXPECT_EQ(download(L, Out, What.Kept), Want) << Range;
    }
}

INSTANTIATE_TEST_SUITE_P(Counts, SortOnDevice,
                         testing::Values(1, 15, 16, 255, 257, 4096, 70001));

TEST_F(OnDevice, ScanSaturates) {
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  L.build(kernels::scan::Program{});
  Sorter S(L);
  const cl::Buffer Out = L.allocate("sums", 4 * 1001);
  S.scan(upload(L, std::vector<uint32_t>(1000, 1U << 28)), Out, 1000);
  EXPECT_EQ(download(L, Out, 1001).back(), ~0U);
}

/// A folder with some of the program's kernel files and a kernel `test`.
class KernelFolder {
public:
  KernelFolder(const std::string &Name, const std::vector<std::string> &Files,
               const std::string &Kernel)
      : Path(testing::TempDir() + Name + std::to_string(getpid())) {
    std::filesystem::create_directory(Path);
    for (const std::string &File : Files)
      EXPECT_TRUE(writeFileAtomically(Path + "/" + File,
                                      std::string(kernelSource(File))));
    EXPECT_TRUE(writeFileAtomically(Path + "/test.cl", Kernel));
  }
  ~KernelFolder() { std::filesystem::remove_all(Path); }
  KernelFolder(const KernelFolder &) = delete;
  KernelFolder &operator=(const KernelFolder &) = delete;

  const std::string Path;
};

class KernelOnDevice : public OnDevice {
protected:
  struct Test {
    static constexpr const char *ProgramFile = "test.cl", *KernelName = "test";
    Argument<cl::Buffer> in, out;
    auto arguments() const { return std::tie(in, out); }
  };
  /// Runs the kernel `test` of \p Folder, \p PerItem floats in and out a
  /// work-item.
  std::vector<float> runTest(const KernelFolder &Folder,
                             const std::vector<float> &In, unsigned PerItem) {
    Launcher L(*Dev, Folder.Path, {});
    L.beginStage(Stage::Blend);
    L.build({"test.cl", {}});
    const cl::Buffer From = L.allocate("in", 4 * In.size());
    const cl::Buffer To = L.allocate("out", 4 * In.size());
    L.write("in", From, In.data(), 4 * In.size());
    L.run(In.size() / PerItem, 16, Test{.in = From, .out = To});
    std::vector<float> Out(In.size());
    L.read("out", Out.data(), To, 4 * Out.size());
    EXPECT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
    return Out;
  }
};

TEST_F(KernelOnDevice, ActivationIsRoundedOnce) {
  const KernelFolder Folder("activation", {"activate.cl"},
                            R"(#include "activate.cl"
__kernel void test(__global const float4 *in, __global float4 *out) {
  const uint i = 2 * get_global_id(0);
  out[i] = activate_scales_and_opacity(in[i]);
  out[i + 1] = activate_quaternion(in[i + 1]);
})");
  constexpr uint32_t Count = 20000;
  Scene S;
  std::vector<float> In;
  std::uniform_real_distribution<float> LogScale(-20, 8), Logit(-12, 12);
  std::normal_distribution<float> Part(0, 2);
  for (uint32_t I = 0; I < Count; ++I) {
    for (int K = 0; K < 3; ++K)
      In.push_back(S.LogScales.emplace_back(LogScale(Random)));
    In.push_back(S.OpacityLogits.emplace_back(Logit(Random)));
    // Any length, also where squares leave fp32's range.
    const int Power = I % 3 == 0 ? static_cast<int>(Random() % 230) - 110 : 0;
    for (int K = 0; K < 4; ++K)
      In.push_back(
          S.Quats.emplace_back(I == 0 ? 0 : std::ldexp(Part(Random), Power)));
  }
  const std::vector<float> Out = runTest(Folder, In, 8);

  const Activated<float> Want = activate<float>(S);
  // The pairs of floats are good to about 2^-40, so about one value in 2^16
  // lies too near the middle of two floats to be told.
  unsigned Wrong = 0;
  for (std::size_t I = 0; I < Count; ++I) {
    for (std::size_t K = 0; K < 3; ++K)
      Wrong += Out[8 * I + K] != Want.Scales[3 * I + K];
    Wrong += Out[8 * I + 3] != Want.Opacities[I];
    for (std::size_t K = 0; K < 4; ++K)
      Wrong += Out[8 * I + 4 + K] != Want.Quats[4 * I + K];
  }
  EXPECT_LE(Wrong, 8U) << "of " << 8 * Count;
}

TEST_F(KernelOnDevice, FalloffIsWithinItsError) {
  const KernelFolder Folder("falloff", {"falloff.cl"}, R"(#include "falloff.cl"
__kernel void test(__global const float *in, __global float *out) {
  const uint i = get_global_id(0);
  out[i] = falloff(in[i]);
})");
  std::vector<float> In{0, -0.0F, -1e-30F, -80};
  while (In.size() < 40000)
    In.push_back(-8 * static_cast<float>(Random()) / 4294967296.0F);
  const std::vector<float> Out = runTest(Folder, In, 1);
  double Worst = 0;
  for (std::size_t I = 0; I < In.size(); ++I) {
    const double Want = std::exp(double(In[I]));
    const auto Near = static_cast<float>(Want);
    const double Ulp = double(std::nextafter(Near, 2.0F)) - Near;
    Worst = std::max(Worst, std::abs(Out[I] - Want) / Ulp);
  }
  EXPECT_LE(Worst, 1.1);
}

// Of depth parts as blending leaves them, against the sum in doubles.
TEST_F(OnDevice, MergeIsTheSumOfItsParts) {
  constexpr uint32_t Count = 5000;
  std::uniform_real_distribution<float> Unit(0, 1);
  for (const uint32_t Parts : {2U, 3U, 16U}) {
    std::vector<float> In(std::size_t{4} * Parts * Count);
    std::vector<double> Want(std::size_t{4} * Count);
    for (uint32_t I = 0; I < Count; ++I)
      Want[4 * I + 3] = 1;
    for (uint32_t K = 0; K < Parts; ++K)
      for (uint32_t I = 0; I < Count; ++I) {
        float *Part = &In[4 * (std::size_t{K} * Count + I)];
        double *Sum = &Want[4 * std::size_t{I}];
        Part[3] = I % 7 == K ? 1e-4F * Unit(Random) : Unit(Random);
        for (int C = 0; C < 3; ++C) {
          Part[C] = (1 - Part[3]) * Unit(Random);
          Sum[C] += Sum[3] * double(Part[C]);
        }
        Sum[3] *= double(Part[3]);
      }
    Launcher L(*Dev, "", {});
    L.beginStage(Stage::Blend);
    L.build(kernels::merge::Program{});
    const cl::Buffer From = L.allocate("parts", 4 * In.size());
    const cl::Buffer To = L.allocate("pixels", 4 * Want.size());
    L.write("parts", From, In.data(), 4 * In.size());
    L.run((Count + 15) / 16 * 16, 16,
          kernels::merge::merge{
              .parts = From, .pixels = To, .count = Count, .num_parts = Parts});
    std::vector<float> Out(Want.size());
    L.read("pixels", Out.data(), To, 4 * Out.size());
    ASSERT_FALSE(L.failure()) << L.failure()->What << L.buildLog();
    double Worst = 0;
    for (std::size_t I = 0; I < Want.size(); ++I)
      Worst = std::max(Worst, std::abs(Out[I] - Want[I]));
    EXPECT_LE(Worst, 8e-7) << Parts;
  }
}

// It does not run with an argument too few or too many.
TEST_F(OnDevice, AnArgumentByChoiceGoesWithItsChoice) {
  for (const bool ByPlane : {false, true})
    for (const bool Given : {false, true}) {
      Launcher L(*Dev, "", {});
      L.beginStage(Stage::Adam);
      L.build(kernels::adam::Program{.MOMENTS_BY_PLANE = ByPlane});
      const cl::Buffer Values = upload(L, std::vector<float>(16));
      L.run(16, 16,
            kernels::adam::adam{.parameters = Values,
                                .gradients = Values,
                                .first = Values,
                                .second = Values,
                                .rates = Values,
                                .count = 16U,
                                .beta1 = 0.9F,
                                .rest1 = 0.1F,
                                .beta2 = 0.9F,
                                .rest2 = 0.1F,
                                .correction = 1.0F,
                                .epsilon = 1.0F,
                                .own_plane =
                                    Given ? std::optional(0U) : std::nullopt});
      EXPECT_EQ(L.failure().has_value(), ByPlane != Given)
          << ByPlane << Given << L.buildLog();
    }
}

TEST_F(OnDevice, TilesAreOrderedByListLength) {
  std::vector<uint32_t> Ranges;
  std::vector<uint32_t> Want(300);
  for (uint32_t T = 0, At = 0; T < Want.size(); ++T) {
    Ranges.push_back(At);
    Ranges.push_back(At += Random() % 50);
  }
  std::iota(Want.begin(), Want.end(), 0U);
  std::ranges::sort(Want, {}, [&](uint32_t T) {
    return std::pair(~(Ranges[2 * T + 1] - Ranges[2 * T]), T);
  });
  Launcher L(*Dev, "", {});
  L.beginStage(Stage::Blend);
  L.build(
      kernels::tiles::Program{.USE_INTERSECT_TAGS = EffectSwitch::compiled()});
  const auto Count = static_cast<uint32_t>(Want.size());
  const cl::Buffer Order = L.allocate("order", 4 * Want.size());
  L.run((Count + 15) / 16 * 16, 16,
        kernels::tiles::order_tiles{
            .ranges = upload(L, Ranges), .order = Order, .tiles = Count});
  EXPECT_EQ(download(L, Order, Count), Want);
}

} // namespace
} // namespace vorion::splat
