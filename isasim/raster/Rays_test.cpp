// Gaussians as rays meet them: bit for bit against a scalar loop on every
// vector level, against the definition in doubles, and as commands.
#include "raster/BackwardLoop.h"
#include "raster/Datapath.h"
#include "raster/RasterTest.h"
#include "raster/ScalarUnits.h"

#include <cmath>
#include <random>

namespace vorion::raster {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector &A, const Vector &B) {
  return A[0] * B[0] + A[1] * B[1] + A[2] * B[2];
}
Vector cross(const Vector &A, const Vector &B) {
  return {A[1] * B[2] - A[2] * B[1], A[2] * B[0] - A[0] * B[2],
          A[0] * B[1] - A[1] * B[0]};
}

/// In the axes of a camera: x right, y down, z ahead. Pixel (x, y) sees along
/// ((x - Centre) / Focal, (y - Centre) / Focal, 1), or in parallel.
struct Body {
  static constexpr double Focal = 80, Centre = 32;
  Vector Mean;
  std::array<Vector, 3> Axes; ///< of length 1
  Vector Scales;
  bool IsParallel;

  /// Where a ray passes the centre, in standard deviations, squared; the ray's
  /// origin and direction in the Gaussian's own frame say so.
  double definition(double X, double Y) const {
    const double A = (X - Centre) / Focal, B = (Y - Centre) / Focal;
    const Vector D = IsParallel ? Vector{0, 0, 1} : Vector{A, B, 1};
    const Vector O = IsParallel ? Vector{A, B, 0} : Vector{0, 0, 0};
    Vector OwnO, OwnD;
    for (unsigned K = 0; K != 3; ++K) {
      OwnO[K] = dot(Axes[K], {O[0] - Mean[0], O[1] - Mean[1], O[2] - Mean[2]}) /
                Scales[K];
      OwnD[K] = dot(Axes[K], D) / Scales[K];
    }
    const Vector C = cross(OwnO, OwnD);
    return dot(C, C) / dot(OwnD, OwnD);
  }

  /// docs/primitives.md#rays, in doubles; the box is the whole of a tile.
  RayGaussian record(float Opacity, uint32_t Tag) const {
    const double Depth = IsParallel ? 1 : Mean[2];
    // The ray through the centre.
    const Vector Along = IsParallel ? Vector{0, 0, 1} : Mean;
    Vector AcrossX, AcrossY, Ahead;
    double E = 0, Det2 = 1;
    for (unsigned K = 0; K != 3; ++K) {
      const Vector N = cross(Axes[K], Along);
      AcrossX[K] = Scales[K] * N[0];
      AcrossY[K] = Scales[K] * N[1];
      const double Others = Scales[(K + 1) % 3] * Scales[(K + 2) % 3];
      Ahead[K] = Others * dot(Axes[K], Along);
      E += Ahead[K] * Ahead[K];
      Det2 *= Scales[K] * Scales[K];
    }
    Vector G{};
    for (unsigned K = 0; K != 3; ++K)
      for (unsigned I = 0; I != 3; ++I)
        G[I] +=
            Ahead[K] * Axes[K][I] * Scales[(K + 1) % 3] * Scales[(K + 2) % 3];
    const double Long = std::sqrt(dot(AcrossX, AcrossX));
    const double Scale = Depth / std::sqrt(E) / Focal;
    RayGaussian R{};
    R.First = 0;
    R.Last = 63 | 63 << 16;
    R.Mean[0] = static_cast<float>(Focal * Mean[0] / Depth + Centre - 0.5);
    R.Mean[1] = static_cast<float>(Focal * Mean[1] / Depth + Centre - 0.5);
    R.Factor[0] = static_cast<float>(Scale * Long);
    R.Factor[1] = static_cast<float>(Scale * dot(AcrossX, AcrossY) / Long);
    R.Factor[2] = static_cast<float>(Depth * Along[2] / (Long * Focal));
    if (!IsParallel) {
      R.Slope[0] = static_cast<float>(Depth * G[0] / (E * Focal));
      R.Slope[1] = static_cast<float>(Depth * G[1] / (E * Focal));
      R.Near = static_cast<float>(Det2 / E);
    }
    R.Opacity = Opacity;
    R.Color[0] = 0.25F;
    R.Color[1] = 0.5F;
    R.Color[2] = 1;
    R.Tag = Tag;
    return R;
  }
};

struct RayScene {
  std::vector<Body> Bodies;
  std::vector<RayGaussian> Records;
  float Cutoff = 1e-3F;
};

/// Gaussians that the tile sees, of many shapes; the eye may be inside of one.
RayScene randomRays(uint32_t Seed, unsigned Count) {
  std::mt19937 Engine(Seed);
  const auto Uniform = [&](double Low, double High) {
    return Low + (High - Low) * Engine() / 0x1p32;
  };
  RayScene S;
  for (unsigned N = 0; N != Count; ++N) {
    Body B;
    B.Mean = {Uniform(-1, 1), Uniform(-1, 1), Uniform(0.3, 4)};
    const auto Unit = [&](Vector V) {
      const double Length = std::sqrt(dot(V, V));
      return Vector{V[0] / Length, V[1] / Length, V[2] / Length};
    };
    const auto Any = [&] {
      return Unit({Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1)});
    };
    B.Axes[0] = Any();
    B.Axes[1] = Unit(cross(B.Axes[0], Any()));
    B.Axes[2] = cross(B.Axes[0], B.Axes[1]);
    for (double &Scale : B.Scales)
      Scale = std::exp(Uniform(-5, 0));
    B.IsParallel = N % 5 == 4;
    S.Records.push_back(B.record(static_cast<float>(Uniform(0, 1.1)), N));
    // Some have small boxes, some none.
    RayGaussian &R = S.Records.back();
    if (N % 3 == 0) {
      R.First = static_cast<uint32_t>(Engine() % 40 | Engine() % 40 << 16);
      R.Last = static_cast<uint32_t>(Engine() % 80 | Engine() % 80 << 16);
      R.Mean[0] -= static_cast<float>(R.First & 0xFFFF);
      R.Mean[1] -= static_cast<float>(R.First >> 16);
    }
    S.Bodies.push_back(B);
  }
  return S;
}

struct Result {
  std::vector<Pixel> Pixels;
  uint64_t Fragments = 0, Blends = 0, Clipped = 0;
};

/// The square of the distance, or NaN where the ray has the Gaussian behind.
float squareAt(const RayGaussian &G, unsigned X, unsigned Y,
               bool IsLowPass = false) {
  const float Dx =
      (static_cast<float>(X) - static_cast<float>(G.First & 0xFFFF)) -
      G.Mean[0];
  const float Dy =
      (static_cast<float>(Y) - static_cast<float>(G.First >> 16)) - G.Mean[1];
  const float U = G.Factor[0] * Dx + G.Factor[1] * Dy;
  const float V = G.Factor[2] * Dy;
  const float Beside = U * U + V * V;
  const float L = (1.0F + G.Slope[0] * Dx) + G.Slope[1] * Dy;
  const float Q = L > 0.0F ? Beside / (L * L + G.Near * Beside) : NotANumber;
  // fmin() takes the number of a number and none.
  return IsLowPass ? std::fmin(Q, 2.0F * (Dx * Dx + Dy * Dy)) : Q;
}

/// docs/abi.md read aloud, one pixel at a time, for a whole tile at (0, 0).
Result onePixelAtATime(const RayScene &S, uint32_t Exp, uint32_t Blend,
                       RayFalloff Falloff = {}) {
  Result Out;
  Out.Pixels.assign(64 * 64, {0, 0, 0, 1});
  std::vector<bool> Saturated(Out.Pixels.size());
  for (const RayGaussian &G : S.Records) {
    uint64_t Fragments = 0;
    for (unsigned I = 0; I != Out.Pixels.size(); ++I) {
      const unsigned X = I % 64, Y = I / 64;
      if (X < (G.First & 0xFFFF) || X > (G.Last & 0xFFFF) ||
          Y < G.First >> 16 || Y > G.Last >> 16)
        continue;
      ++Fragments;
      const float Q = squareAt(G, X, Y, Falloff.IsLowPass);
      const float Power = Falloff.IsDegree4 ? -1.0F / 18.0F * Q * Q : -0.5F * Q;
      if (Saturated[I] || !(Power <= 0.0F))
        continue;
      const float Alpha = std::fmin(0.99F, G.Opacity * scalar::exp(Exp, Power));
      if (Alpha < 1.0F / 255.0F)
        continue;
      Pixel &P = Out.Pixels[I];
      const auto Rounded = [&](float V) { return scalar::operand(Blend, V); };
      float Taken = Alpha * P.T;
      float NextT = P.T * (1.0F - Alpha);
      if (Blend != VR_BLEND_FP32) {
        Taken = Rounded(Alpha) * Rounded(P.T);
        NextT = P.T - Taken;
      }
      Saturated[I] = NextT < S.Cutoff;
      if (Saturated[I])
        continue;
      P.R += Rounded(G.Color[0]) * Rounded(Taken);
      P.G += Rounded(G.Color[1]) * Rounded(Taken);
      P.B += Rounded(G.Color[2]) * Rounded(Taken);
      P.T = NextT;
      ++Out.Blends;
    }
    Out.Fragments += Fragments;
    Out.Clipped += Fragments == 0;
  }
  return Out;
}

Result onLevel(const Datapath &Level, const RayScene &S, uint32_t Exp,
               uint32_t Blend, RayFalloff Falloff) {
  auto Tile = std::make_unique<TileBuffer>();
  Tile->reset(0, 0, 64, 64);
  const BlendOptions Options{.StopBelow = S.Cutoff,
                             .MinAlpha = 1.0F / 255.0F,
                             .SkipSaturated = false,
                             .Falloff = Falloff};
  Result Out;
  for (const RayGaussian &G : S.Records) {
    const BoxWork Work = Level.Rays.Of[Exp][Blend](G, Options, *Tile);
    Out.Clipped += Work.Clipped;
    Out.Fragments += Work.Fragments;
    Out.Blends += Work.Blends;
  }
  for (unsigned I = 0; I != TileBuffer::Pixels; ++I)
    Out.Pixels.push_back(
        {Tile->R[I], Tile->G[I], Tile->B[I], std::fabs(Tile->T[I])});
  return Out;
}

constexpr RayFalloff Falloffs[] = {
    {false, false}, {true, false}, {false, true}, {true, true}};

TEST(Rays, EveryLevelHasTheBitsOfTheScalarLoop) {
  for (const Datapath *Level : datapaths()) {
    uint32_t Seed = 0;
    for (const uint32_t Exp : {VR_EXP_EXACT, VR_EXP_TABLE, VR_EXP_POLY3})
      for (const uint32_t Blend : {VR_BLEND_FP32, VR_BLEND_BF16})
        for (const RayFalloff Falloff : Falloffs) {
          const RayScene S = randomRays(Seed++, 60);
          const Result Right = onePixelAtATime(S, Exp, Blend, Falloff);
          const Result Is = onLevel(*Level, S, Exp, Blend, Falloff);
          ASSERT_EQ(Is.Pixels, Right.Pixels) << Level->Name << ' ' << Seed;
          EXPECT_EQ(Is.Fragments, Right.Fragments);
          EXPECT_EQ(Is.Blends, Right.Blends);
          EXPECT_EQ(Is.Clipped, Right.Clipped);
          EXPECT_GT(Is.Blends, 1000U);
          EXPECT_GT(Is.Clipped, 0U);
        }
  }
}

/// A tile of 40 x 24 pixels that rays drew, and a gradient of it.
SceneOf<RayGaussian> drawnRays(uint32_t Seed, RayFalloff Falloff = {}) {
  RayScene Rays = randomRays(Seed, 60);
  // Of smaller ones the low pass has more.
  if (Falloff.IsLowPass)
    for (std::size_t N = 0; N < Rays.Records.size(); N += 2)
      for (float &F : Rays.Records[N].Factor)
        F *= 30;
  const Result Drawn =
      onePixelAtATime(Rays, VR_EXP_EXACT, VR_BLEND_FP32, Falloff);
  SceneOf<RayGaussian> S{Rays.Records, 0, 0, 40, 24, {}, {}, {}};
  std::mt19937 Engine(Seed);
  const auto Any = [&] {
    return static_cast<float>(Engine()) * 0x1p-31F - 1.0F;
  };
  for (unsigned Y = 0; Y != S.Height; ++Y)
    for (unsigned X = 0; X != S.Width; ++X) {
      S.Rendered.push_back(Drawn.Pixels[Y * 64 + X]);
      S.Upstream.push_back({Any(), Any(), Any(), Any()});
      // Wherever it is: what lies behind it is not looked at.
      S.Last.push_back(Engine() % 61);
    }
  return S;
}

TEST(Rays, EveryLevelHasTheSumsOfTheScalarLoop) {
  for (const BackwardDatapath *Level : backwardDatapaths())
    for (uint32_t Seed = 0; Seed != 12; ++Seed) {
      BackwardOptions O;
      O.Unit = static_cast<Reciprocal>(Seed % ReciprocalUnitCount);
      O.ClampStops = Seed % 3 == 0;
      O.InRows = Seed % 2 == 0;
      O.Falloff = Falloffs[Seed % std::size(Falloffs)];
      const auto S = drawnRays(Seed, O.Falloff);
      const auto Right = scalarLoop(S, O), Is = onLevel(*Level, S, O);
      unsigned Deep = 0, OnPicture = 0;
      for (std::size_t I = 0; I != Right.size(); ++I) {
        ASSERT_EQ(Is[I], Right[I]) << Level->Name << ' ' << Seed << ' ' << I;
        Deep += Right[I].Sums[11] != 0;
        OnPicture += Right[I].Sums[13] != 0;
      }
      EXPECT_GT(Deep, 3U);
      EXPECT_EQ(OnPicture != 0, O.Falloff.IsLowPass);
    }
}

/// docs/primitives.md#rays has the bound. A record's own rounding counts, too.
TEST(Rays, TheQuotientIsTheDefinitionWithinItsBound) {
  constexpr double Ulp = 0x1p-24;
  double Worst = 0, Largest = 0;
  unsigned Compared = 0;
  const RayScene S = randomRays(77, 400);
  for (std::size_t N = 0; N != S.Records.size(); ++N) {
    if (N % 3 == 0)
      continue; // of a box of its own
    const RayGaussian &G = S.Records[N];
    for (unsigned Y = 0; Y < 64; Y += 7)
      for (unsigned X = 0; X < 64; X += 7) {
        const double Right = S.Bodies[N].definition(X + 0.5, Y + 0.5);
        const double Dx = X - double{G.Mean[0]}, Dy = Y - double{G.Mean[1]};
        const double L = 1 + G.Slope[0] * Dx + G.Slope[1] * Dy;
        const double Is = squareAt(G, X, Y);
        if (!(L > 1e-3) || Right < 1e-3)
          continue;
        const double U = G.Factor[0] * Dx + G.Factor[1] * Dy;
        const double V = G.Factor[2] * Dy;
        // What a half ulp of the mean is beside the distance from it.
        const double Off =
            1 + std::abs(G.Mean[0] / Dx) + std::abs(G.Mean[1] / Dy);
        const double Parts = std::abs(G.Factor[0] * Dx) +
                             std::abs(G.Factor[1] * Dy) + std::abs(V);
        const double Bound =
            Ulp * Off *
            (8 * Parts / std::hypot(U, V) +
             8 * (1 + std::abs(G.Slope[0] * Dx) + std::abs(G.Slope[1] * Dy)) /
                 L +
             10);
        Worst = std::max(Worst, std::abs(Is - Right) / Right / Bound);
        Largest = std::max(Largest, Right);
        ++Compared;
      }
  }
  EXPECT_LT(Worst, 1);
  EXPECT_GT(Worst, 0.01);
  EXPECT_GT(Largest, 9);
  EXPECT_GT(Compared, 5000U);
}

class RaysTest : public RasterTest {
protected:
  static constexpr uint32_t Lasts = Records + 0x680000;
  static constexpr uint32_t Upstream = Records + 0x700000;

  /// In front of the tile's pixel (20, 12), a few pixels wide.
  static RayGaussian near() {
    return {20 | 12U << 16,
            30 | 20U << 16,
            {1, 1},
            {0.3F, 0.1F, 0.4F},
            {0.01F, 0},
            0.001F,
            0.9F,
            {1, 0.5F, 0.25F},
            0,
            0};
  }

  void configureRays(std::span<const RayGaussian> Rays, uint32_t Mode = 0,
                     uint32_t Options = 0) {
    configure({}, {.Mode = Mode | ModePrimitive.put(VR_PRIMITIVE_RAY),
                   .Options = Options});
    Memory.put(Records, Rays);
    std::vector<uint32_t> Order(Rays.size());
    for (uint32_t I = 0; I != Order.size(); ++I)
      Order[I] = I;
    Memory.put(List, std::span<const uint32_t>(Order));
    set(Csr::Count, static_cast<uint32_t>(Rays.size()));
    set(Csr::TailCount, 0U);
  }
  std::vector<Pixel> draw(const RayGaussian &G, uint32_t Options = 0) {
    configureRays({&G, 1}, 0, Options);
    EXPECT_EQ(start(), VR_OK);
    return pixels();
  }
  static unsigned covered(std::span<const Pixel> Tile) {
    return static_cast<unsigned>(
        std::ranges::count_if(Tile, [](const Pixel &P) { return P.T != 1; }));
  }
};

TEST_F(RaysTest, ACommandBlendsAList) {
  const RayScene S = randomRays(3, 200);
  configureRays(S.Records);
  EXPECT_EQ(start(), VR_OK);
  set(Csr::Cutoff, 1e-4F);
  RayScene Own = S;
  Own.Cutoff = 1e-4F;
  const Result Right = onePixelAtATime(Own, VR_EXP_EXACT, VR_BLEND_FP32);
  EXPECT_EQ(pixels(), Right.Pixels);
  EXPECT_EQ(Agent.counters().Blends, Right.Blends);
}

TEST_F(RaysTest, ABackwardCommandHandsOverFourteenSums) {
  const RayFalloff Falloff{.IsLowPass = true};
  const SceneOf<RayGaussian> S = drawnRays(5, Falloff);
  configureRays(S.Gaussians, ModeBackward.put(1), OptionsLowPass.put(1));
  set(Csr::TileShape,
      TileShapeWidth.put(S.Width) | TileShapeHeight.put(S.Height));
  set(Csr::Last, Lasts);
  set(Csr::Upstream, Upstream);
  for (unsigned Y = 0; Y != S.Height; ++Y) {
    const std::size_t I = S.at(0, Y);
    Memory.put(Pixels + Y * Pitch, std::span(&S.Rendered[I], S.Width));
    Memory.put(Upstream + Y * Pitch, std::span(&S.Upstream[I], S.Width));
    Memory.put(Lasts + Y * Pitch / 4, std::span(&S.Last[I], S.Width));
  }
  set(Csr::Start, 1U);
  while (Unit.step()) {
  }
  const auto Right = scalarLoop(S, {.Falloff = Falloff});
  for (uint32_t Next; (Next = Agent.read(Csr::GradNext, 0)) != 0;) {
    for (unsigned L = 0; L != GradNextCount.get(Next); ++L) {
      const GradientSums &Want =
          Right[VR_GRAD_LANES * GradNextBatch.get(Next) + L];
      const BatchItem Words = itemOf(Want);
      for (uint32_t K = 0; K != Words.size(); ++K) {
        set(Csr::Index, K);
        EXPECT_EQ(Agent.read(Csr::Item, L), Words[K]) << L << ' ' << K;
      }
      EXPECT_EQ(Agent.read(Csr::GradSyy, L), Words[9]);
    }
    while (Unit.step()) {
    }
  }
  EXPECT_EQ(Agent.read(Csr::Wait, 0), VR_OK);
}

TEST_F(RaysTest, BehindTheRayIsNothing) {
  RayGaussian G = near();
  const std::vector<Pixel> All = draw(G);
  EXPECT_GT(covered(All), 40U);
  // The plane falls to 0 five columns from the mean, at column 26.
  G.Slope[0] = -0.2F;
  const std::vector<Pixel> Half = draw(G);
  EXPECT_GT(covered(Half), 10U);
  for (unsigned Y = 0; Y != 64; ++Y)
    for (unsigned X = 26; X != 64; ++X)
      EXPECT_EQ(Half[Y * 64 + X].T, 1) << X << ' ' << Y;
}

TEST_F(RaysTest, ALowPassIsAPointOfTheMeansPixel) {
  // A disc from its edge: no ray is within 3 deviations of it.
  RayGaussian G = near();
  G.Factor[0] = G.Factor[2] = 1e6F;
  G.Mean[0] = 1.5F;
  EXPECT_EQ(covered(draw(G)), 0U);
  const std::vector<Pixel> Blurred = draw(G, OptionsLowPass.put(1));
  // (0.5, 0) from it, and (1.5, 1).
  EXPECT_NEAR(Blurred[13 * 64 + 21].T, 1 - 0.9F * std::exp(-0.25F), 1e-6F);
  EXPECT_NEAR(Blurred[14 * 64 + 23].T, 1 - 0.9F * std::exp(-3.25F), 1e-6F);
  // Behind the plane there is the picture alone.
  G = near();
  G.Slope[0] = -2;
  EXPECT_NEAR(draw(G, OptionsLowPass.put(1))[13 * 64 + 22].T,
              1 - 0.9F * std::exp(-1.0F), 1e-6F);
}

TEST_F(RaysTest, DegreeFourIsFlatter) {
  const std::vector<Pixel> Two = draw(near()),
                           Four = draw(near(), OptionsDegree4.put(1));
  // At the mean they agree, and where q is 9: exp(-9/2).
  EXPECT_EQ(Two[13 * 64 + 21], Four[13 * 64 + 21]);
  EXPECT_LT(Four[14 * 64 + 23].T, Two[14 * 64 + 23].T);
}

TEST_F(RaysTest, NumbersThatAreNoneAreRefusedAndInfiniteOnesCoverNothing) {
  for (unsigned Word = 2; Word != 13; ++Word) {
    RayGaussian G = near();
    std::array<float, 16> Words;
    std::memcpy(Words.data(), &G, sizeof(G));
    Words[Word] = NotANumber;
    std::memcpy(&G, Words.data(), sizeof(G));
    configureRays({&G, 1});
    EXPECT_EQ(start(), VR_NAN) << Word;
  }
  RayGaussian G = near();
  G.Unused = ~0U; // nobody reads it
  EXPECT_EQ(draw(G), draw(near()));
  for (const float Factor : {Inf, 3e38F}) {
    G = near();
    G.Factor[0] = Factor;
    G.Mean[0] = 0.5F; // no column's centre
    EXPECT_EQ(covered(draw(G)), 0U);
  }
  // A quotient of zeros, where the plane's square is below what fp32 has.
  G = near();
  G.Factor[0] = G.Factor[1] = G.Factor[2] = G.Near = 0;
  G.Slope[0] = -1;
  G.Mean[0] = 1 - 0x1p-24F;
  EXPECT_EQ(draw(G)[13 * 64 + 21].T, 1 - 0.9F);
  // From inside, rays meet it wherever they look: q is at most 1 / near.
  G = near();
  G.First = 0;
  G.Last = 63 | 63U << 16;
  G.Near = 1;
  EXPECT_EQ(covered(draw(G)), 64U * 64U);
  // A box whose end is before its beginning.
  G = near();
  std::swap(G.First, G.Last);
  EXPECT_EQ(covered(draw(G)), 0U);
}

TEST_F(RaysTest, CommandsThatRaysDoNotHaveAreRefused) {
  struct Case {
    Csr Where;
    uint32_t Value, Status;
  };
  const uint32_t Mode = ModePrimitive.put(VR_PRIMITIVE_RAY);
  const Case Cases[] = {
      {Csr::Mode, Mode, VR_OK},
      {Csr::Mode, Mode | ModeDrain.put(1), VR_OK},
      {Csr::Mode, Mode | ModePushed.put(1), VR_BAD_MODE},
      {Csr::Mode, Mode | ModeFragments.put(1), VR_BAD_MODE},
      {Csr::Options, OptionsDegree4.put(1), VR_OK},
      {Csr::Options, OptionsLowPass.put(1), VR_OK},
      {Csr::Options, 1U << 12, VR_BAD_MODE},
      {Csr::Ztile, ZtileCount.put(2), VR_OK},
      {Csr::TailCount, 3, VR_BAD_TAIL},
  };
  const RayGaussian G = near();
  for (const Case &C : Cases) {
    configureRays({&G, 1});
    set(C.Where, C.Value);
    EXPECT_EQ(start(), C.Status)
        << std::hex << static_cast<unsigned>(C.Where) << ' ' << C.Value;
    Agent.read(Csr::GradNext, 0);
  }
  for (const uint32_t Falloff :
       {OptionsDegree4.put(1), OptionsLowPass.put(1)}) {
    configure({}, {.Options = Falloff});
    EXPECT_EQ(start(), VR_BAD_MODE);
  }
}

} // namespace
} // namespace vorion::raster
