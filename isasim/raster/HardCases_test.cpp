// Numerically hard input of the rasterizer itself: the part of the catalogue
// (docs/numerics.md) that no scene reaches. A scalar fp32 loop is the contract;
// the loop with a guard removed or a rounding lost must differ from the unit.
#include "raster/Datapath.h"
#include "raster/RasterTest.h"

#include <cmath>
#include <random>

namespace vorion::raster {
namespace {

/// What a broken loop does otherwise.
struct Loop {
  float MostAlpha = 0.99F;
  float LeastAlpha = 1.0F / 255.0F;
  bool KeepsRising = false; ///< power above 0 is blended
  bool NeverStops = false;
  bool RoundsT = false;   ///< to bf16
  bool OpenBox = false;   ///< the border is outside
  bool EachOnce = false;  ///< duplicate entries count once
  std::size_t Most = ~0U; ///< entries
};

/// docs/abi.md, "Rasterizer", one pixel at a time.
Pixel blended(const std::vector<Gaussian> &Records,
              const std::vector<uint32_t> &List, unsigned X, unsigned Y,
              float Cutoff, const Loop &L = {}) {
  const float Px = static_cast<float>(X) + 0.5F;
  const float Py = static_cast<float>(Y) + 0.5F;
  Pixel P{0, 0, 0, 1};
  std::vector<bool> Seen(Records.size());
  for (std::size_t I = 0; I < std::min(List.size(), L.Most); ++I) {
    const Gaussian &G = Records[List[I]];
    if (L.EachOnce && Seen[List[I]])
      continue;
    Seen[List[I]] = true;
    const float Dx = G.Mean[0] - Px;
    const float Dy = G.Mean[1] - Py;
    const bool Inside =
        L.OpenBox
            ? std::fabs(Dx) < G.Extent[0] && std::fabs(Dy) < G.Extent[1]
            : std::fabs(Dx) <= G.Extent[0] && std::fabs(Dy) <= G.Extent[1];
    if (!Inside)
      continue;
    const float Power = -0.5F * (G.Conic[0] * Dx * Dx + G.Conic[2] * Dy * Dy) -
                        G.Conic[1] * Dx * Dy;
    if (!(Power <= 0.0F) && !L.KeepsRising)
      continue;
    const auto Falloff = static_cast<float>(std::exp(double{Power}));
    const float Alpha = std::fmin(L.MostAlpha, G.Opacity * Falloff);
    if (!(Alpha >= L.LeastAlpha))
      continue;
    float Next = P.T * (1.0F - Alpha);
    if (Next < Cutoff && !L.NeverStops)
      break;
    if (L.RoundsT)
      Next = std::bit_cast<float>(std::bit_cast<uint32_t>(Next) & 0xffff0000U);
    P.R += G.Color[0] * (Alpha * P.T);
    P.G += G.Color[1] * (Alpha * P.T);
    P.B += G.Color[2] * (Alpha * P.T);
    P.T = Next;
  }
  return P;
}

/// A box that is a Gaussian of one alpha in all its pixels.
Gaussian flat(float X, float Y, float Extent, float Opacity, float Red) {
  return {{X, Y},           {0, 0, 0}, Opacity, {Red, 0.5F, 1 - Red},
          {Extent, Extent}, 0};
}

class HardCases : public RasterTest {
protected:
  /// The pixels of one command in memory of its own: records, list, pixels.
  std::vector<Pixel> blend(const std::vector<Gaussian> &Scene,
                           const std::vector<uint32_t> &Entries,
                           const TileCommand &T) {
    constexpr uint32_t AllEntries = TestMemory::Base + 0x10000;
    const auto AllPixels =
        static_cast<uint32_t>(AllEntries + (4 * Entries.size() + 63) / 64 * 64);
    TestMemory Wide(AllPixels - TestMemory::Base + 16 * TileBuffer::Pixels);
    RasterAgent Asking;
    Rasterizer Serving(Wide, {&Asking});
    Wide.put<Gaussian>(Records, Scene);
    Wide.put<uint32_t>(AllEntries, Entries);
    const std::pair<Csr, uint32_t> Bank[] = {
        {Csr::Cutoff, std::bit_cast<uint32_t>(T.Cutoff)},
        {Csr::Gaussians, Records},
        {Csr::List, AllEntries},
        {Csr::Count, static_cast<uint32_t>(Entries.size())},
        {Csr::TileOrigin, TileOriginX.put(T.X) | TileOriginY.put(T.Y)},
        {Csr::TileShape,
         TileShapeWidth.put(T.Width) | TileShapeHeight.put(T.Height)},
        {Csr::Output, AllPixels},
        {Csr::OutputPitch, T.Width * uint32_t{sizeof(Pixel)}},
        {Csr::Start, 1}};
    for (const auto &[C, Value] : Bank)
      Asking.write(C, std::span(&Value, 1), 1);
    Serving.finish(Asking);
    EXPECT_EQ(Asking.read(Csr::Wait, 0), VR_OK);
    return Wide.get<Pixel>(AllPixels, std::size_t{T.Width} * T.Height);
  }

  /// Expects the scalar loop's bits, and that none of \p Broken has them all.
  void expectLoop(const std::vector<Gaussian> &Scene,
                  const std::vector<uint32_t> &Entries, const TileCommand &T,
                  const std::vector<Loop> &Broken) {
    const std::vector<Pixel> Is = blend(Scene, Entries, T);
    std::vector<bool> Differs(Broken.size());
    for (unsigned I = 0; I != Is.size(); ++I) {
      const unsigned X = T.X + I % T.Width, Y = T.Y + I / T.Width;
      ASSERT_EQ(Is[I], blended(Scene, Entries, X, Y, T.Cutoff))
          << X << ' ' << Y;
      for (std::size_t B = 0; B != Broken.size(); ++B)
        Differs[B] = Differs[B] || Is[I] != blended(Scene, Entries, X, Y,
                                                    T.Cutoff, Broken[B]);
    }
    for (std::size_t B = 0; B != Broken.size(); ++B)
      EXPECT_TRUE(Differs[B]) << "broken loop " << B << " is not noticed";
  }
};

TEST_F(HardCases, ListsOfEveryLength) {
  const std::vector<Gaussian> Scene{flat(2, 2, 9, 0.004F, 1),
                                    flat(2, 2, 9, 0.005F, 0)};
  for (const uint32_t Length : {1U, 16U, 17U, 1000U}) {
    std::vector<uint32_t> Entries(Length);
    for (uint32_t I = 0; I != Length; ++I)
      Entries[I] = I % 2;
    expectLoop(Scene, Entries, {.Cutoff = 0, .Width = 4, .Height = 4},
               {Loop{.RoundsT = true}, Loop{.Most = Length - 1}});
  }
  const TileCommand None{.Width = 4, .Height = 4};
  for (const Pixel &P : blend(Scene, {}, None))
    EXPECT_EQ(P, (Pixel{0, 0, 0, 1}));
}

TEST_F(HardCases, AMillionLayersEndAtTheirColor) {
  const std::vector<Gaussian> Scene{flat(2, 2, 9, 0.004F, 0.75F)};
  const std::vector<uint32_t> Entries(1U << 20);
  const std::vector<Pixel> Is =
      blend(Scene, Entries, {.Cutoff = 0, .Width = 2, .Height = 2});
  for (const Pixel &P : Is) {
    // The weights add up to 1 - 0.996^(2^20), which is 1; their sum is rounded
    // some 4000 times before they are too small to count.
    EXPECT_NEAR(P.R, 0.75, 2e-5);
    EXPECT_NEAR(P.G, 0.5, 2e-5);
    EXPECT_LT(P.T, 1e-30F);
  }
}

TEST_F(HardCases, UnsortedAndDuplicateEntries) {
  std::mt19937 Random(3);
  std::vector<Gaussian> Scene;
  for (int I = 0; I != 30; ++I)
    Scene.push_back(flat(static_cast<float>(Random() % 24),
                         static_cast<float>(Random() % 24), 6, 0.3F,
                         static_cast<float>(Random() % 100) / 100));
  std::vector<uint32_t> Entries(200);
  for (uint32_t &E : Entries)
    E = Random() % 30;
  expectLoop(
      Scene, Entries, {.Width = 24, .Height = 24},
      {Loop{.EachOnce = true}, Loop{.Most = 20}, Loop{.NeverStops = true}});
}

TEST_F(HardCases, BoxEdgesOnCentresAndTileBorders) {
  // The last tile of the largest picture: centres up to 65535.5, an ulp of
  // which is 1/256 px.
  for (const unsigned Origin : {0U, 64U, 16384U, 65472U}) {
    std::vector<Gaussian> Scene;
    std::vector<uint32_t> Entries;
    const auto Far = static_cast<float>(Origin);
    for (const float Edge : {0.0F, 0.5F, 1.0F, 31.5F, 63.0F, 63.5F, 64.0F})
      for (const int Ulp : {-1, 0, 1}) {
        float At = Far + Edge;
        if (Ulp != 0)
          At = std::nextafter(At, Ulp < 0 ? -1e9F : 1e9F);
        // A box that ends at the edge, and one that begins there.
        Scene.push_back(flat(At - 8, Far + 20, 8, 0.2F, 0.3F));
        Scene.push_back(flat(At + 8, Far + 20, 8, 0.3F, 0.9F));
      }
    for (uint32_t I = 0; I != Scene.size(); ++I)
      Entries.push_back(I);
    expectLoop(Scene, Entries, {.X = Origin, .Y = Origin},
               {Loop{.OpenBox = true}});
  }
}

TEST_F(HardCases, RadiiBeyondAnInt) {
  std::vector<Gaussian> Scene;
  for (const float Extent : {2.2e9F, 1e19F, 3e38F, Inf})
    for (const float Mean : {0.0F, -2e4F, 1e9F}) {
      Scene.push_back(flat(Mean, -Mean, Extent, 0.1F, 0.5F));
      Scene.back().Conic[0] = Scene.back().Conic[2] = 1e-20F;
    }
  std::vector<uint32_t> Entries(Scene.size());
  for (uint32_t I = 0; I != Entries.size(); ++I)
    Entries[I] = I;
  expectLoop(Scene, Entries, {.X = 65472, .Width = 17, .Height = 5},
             {Loop{.Most = Entries.size() - 1}});
}

TEST_F(HardCases, OpaqueStacks) {
  for (const float Opacity : {0.99F, 1.0F})
    for (const uint32_t Depth : {2U, 3U, 16U, 64U}) {
      std::vector<Gaussian> Scene;
      std::vector<uint32_t> Entries;
      for (uint32_t I = 0; I != Depth; ++I) {
        Scene.push_back(flat(4, 4, 9, Opacity, static_cast<float>(I % 5) / 5));
        Entries.push_back(I);
      }
      // fp32's T after two is 9.9999e-5, so that the second stops the pixel.
      std::vector<Loop> Broken{Loop{.NeverStops = true}};
      if (Opacity == 1)
        Broken.push_back(Loop{.MostAlpha = 1});
      expectLoop(Scene, Entries, {.Width = 8, .Height = 8}, Broken);

      const Pixel Open =
          blend(Scene, Entries, {.Cutoff = 0, .Width = 1, .Height = 1})[0];
      const double Exact = std::pow(1 - double{0.99F}, Depth);
      EXPECT_NEAR(Open.T, Exact, Depth < 18 ? 1e-5 * Exact : 1e-38);
    }
}

TEST_F(HardCases, AlphaAtItsThresholds) {
  std::vector<Gaussian> Scene;
  std::vector<uint32_t> Entries;
  uint32_t I = 0;
  for (const float Alpha : {1.0F / 255.0F, 0.5F, 0.99F})
    for (const float Toward : {0.0F, Alpha, 2.0F}) {
      Scene.push_back(flat(static_cast<float>(I) + 0.5F, 0.5F, 0.25F,
                           std::nextafter(Alpha, Toward), 0.75F));
      Entries.push_back(I++);
    }
  Scene.push_back(flat(static_cast<float>(I) + 0.5F, 0.5F, 0.25F, 0.5F, 1));
  Scene.back().Conic[1] = -1e-3F; // power above 0 beside the centre
  Scene.back().Mean[0] += 0.2F;
  Scene.back().Mean[1] += 0.2F;
  Entries.push_back(I);
  expectLoop(
      Scene, Entries, {.Width = 16, .Height = 1},
      {Loop{.LeastAlpha = 0}, Loop{.MostAlpha = 1}, Loop{.KeepsRising = true}});
}

} // namespace
} // namespace vorion::raster
