// Triangles: coverage against exact integers, meshes without cracks or double
// pixels, depth tests, visibility, fragments, and what is refused.
#include "raster/RasterTest.h"
#include "raster/Surfaces.h"
#include "testing/Setting.h"

#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
// After the tables, whose names it has as macros.
#include <vorion_abi.h>
#include <vorion_triangles.h>

namespace vorion::raster {
namespace {

static_assert(sizeof(vx_triangle) == sizeof(Triangle));

using Wide = __int128;

/// A corner in 1/256 pixel.
struct Corner {
  int X, Y;
};

/// RasterTest with triangles instead of Gaussians.
class SurfacesTest : public RasterTest {
protected:
  void setWord(uint32_t Index, uint32_t Value) {
    set(Csr::Index, Index);
    set(Csr::Word, Value);
  }
  void setDepth(uint32_t Function, bool Writes = true, bool Loads = false,
                float Clear = 0, bool IsInteger = false) {
    setWord(VR_WORD_DEPTH, DepthFunction.put(Function) |
                               DepthWrite.put(Writes) | DepthLoad.put(Loads) |
                               DepthInteger.put(IsInteger));
    setWord(VR_WORD_DEPTH_CLEAR, std::bit_cast<uint32_t>(Clear));
  }

  /// Puts \p All in memory and sets the bank, without starting.
  void configureTriangles(std::span<const Triangle> All,
                          const TileCommand &T = {}) {
    configure({}, T);
    Memory.put(Records, All);
    std::vector<uint32_t> Order(All.size());
    for (uint32_t I = 0; I != Order.size(); ++I)
      Order[I] = I;
    Memory.put(List, std::span<const uint32_t>(Order));
    set(Csr::Count, static_cast<uint32_t>(All.size()));
    set(Csr::Mode, T.Mode | ModePrimitive.put(VR_PRIMITIVE_TRIANGLE));
    set(Csr::OutputPitch, uint32_t{VR_MAX_TILE * sizeof(Visibility)});
  }

  std::vector<Visibility> visible(const TileCommand &T) {
    std::vector<Visibility> All;
    for (unsigned Row = 0; Row != T.Height; ++Row)
      for (const Visibility &V : Memory.get<Visibility>(
               Pixels + Row * VR_MAX_TILE * sizeof(Visibility), T.Width))
        All.push_back(V);
    return All;
  }

  std::vector<Visibility> draw(std::span<const Triangle> All,
                               const TileCommand &T = {}) {
    configureTriangles(All, T);
    EXPECT_EQ(start(), VR_OK);
    return visible(T);
  }

  /// Starts a command that hands fragments over and takes them all. Where
  /// \p Status is null, it must succeed.
  std::vector<Fragment> drawFragments(std::span<const Triangle> All,
                                      TileCommand T = {},
                                      uint32_t *Status = nullptr) {
    T.Mode |= ModeFragments.put(1);
    configureTriangles(All, T);
    set(Csr::Start, 1U);
    std::vector<Fragment> Got;
    for (uint32_t Number = 0;; ++Number) {
      while (Unit.step()) {
      }
      EXPECT_TRUE(Agent.canTakeBatch());
      const uint32_t Next = Agent.read(Csr::GradNext, 0);
      if (Next == 0)
        break;
      EXPECT_EQ(GradNextBatch.get(Next), Number);
      for (unsigned Lane = 0; Lane != GradNextCount.get(Next); ++Lane)
        Got.push_back({item(VR_ITEM_PRIMITIVE, Lane), item(VR_ITEM_PIXEL, Lane),
                       std::bit_cast<float>(item(VR_ITEM_DEPTH, Lane))});
      EXPECT_EQ(item(VR_ITEM_PRIMITIVE, GradNextCount.get(Next)), 0U);
    }
    while (Unit.step()) {
    }
    const uint32_t Code = Agent.read(Csr::Wait, 0);
    if (Status)
      *Status = Code;
    else
      EXPECT_EQ(Code, VR_OK);
    return Got;
  }

private:
  uint32_t item(uint32_t Word, unsigned Lane) {
    set(Csr::Index, Word);
    return Lane < VR_GRAD_LANES ? Agent.read(Csr::Item, Lane) : 0;
  }
};

/// Set up in the largest picture; Last before First if it covers nothing.
Triangle setUp(const Corner (&C)[3], uint32_t Tag = 0,
               std::array<float, 3> Depth = {1, 1, 1}) {
  const int X[] = {C[0].X, C[1].X, C[2].X}, Y[] = {C[0].Y, C[1].Y, C[2].Y};
  vx_triangle T{};
  T.first = ~0U;
  vx_triangle_setup(&T, X, Y, Depth.data(), Tag, 65536, 65536);
  return std::bit_cast<Triangle>(T);
}

/// Whether the triangle covers the sample of a pixel, by the top-left rule on
/// the corners themselves.
bool isInside(const Corner (&C)[3], int Column, int Row) {
  const Wide X = 256 * Wide(Column) + 128, Y = 256 * Wide(Row) + 128;
  const auto Cross = [](Wide Ax, Wide Ay, Wide Bx, Wide By) {
    return Ax * By - Ay * Bx;
  };
  const Wide Area =
      Cross(C[1].X - C[0].X, C[1].Y - C[0].Y, C[2].X - C[0].X, C[2].Y - C[0].Y);
  if (Area == 0)
    return false;
  for (unsigned From = 0; From != 3; ++From) {
    Corner P = C[From], Q = C[(From + 1) % 3];
    if (Area < 0)
      std::swap(P, Q);
    const Wide Side = Cross(Q.X - P.X, Q.Y - P.Y, X - P.X, Y - P.Y);
    // Clockwise with y down: a left edge goes up, a top edge to the right.
    const bool IsLeft = Q.Y < P.Y, IsTop = Q.Y == P.Y && Q.X > P.X;
    if (Side < 0 || (Side == 0 && !IsLeft && !IsTop))
      return false;
  }
  return true;
}

/// Edges as they are, in integers that hold every product.
bool isInside(const Triangle &T, unsigned Column, unsigned Row) {
  for (unsigned Edge = 0; Edge != 3; ++Edge) {
    const Wide C = (Wide(T.CHigh[Edge]) << 32) + T.CLow[Edge];
    if (C + Wide(T.A[Edge]) * Column + Wide(T.B[Edge]) * Row < 0)
      return false;
  }
  return Column >= columnOf(T.First) && Column <= columnOf(T.Last) &&
         Row >= rowOf(T.First) && Row <= rowOf(T.Last);
}

/// Random numbers of all sizes, about evenly by their digits.
class Random {
public:
  explicit Random(uint32_t Seed) : Engine(Seed) {}
  uint32_t below(uint32_t Limit) { return Engine() % Limit; }
  /// Of at most \p Bits bits, with a sign.
  int64_t wide(unsigned Bits) {
    const uint64_t All = uint64_t{Engine()} << 32 | Engine();
    return static_cast<int64_t>(All) >> (63 - below(Bits));
  }

private:
  std::mt19937 Engine;
};

/// A tile anywhere, and a triangle about it: small or as large as the guard
/// band, with corners on samples, on edges of pixels or anywhere.
struct AboutTile {
  TileCommand Tile;
  Corner Corners[3];
};

AboutTile randomAboutTile(Random &R) {
  AboutTile All;
  All.Tile.Width = 1 + R.below(9);
  All.Tile.Height = 1 + R.below(9);
  All.Tile.X = R.below(65536 - 9) >> R.below(12);
  All.Tile.Y = R.below(65536 - 9) >> R.below(12);
  const unsigned Bits = 9 + R.below(16);
  const int Grid = R.below(3) == 0 ? 128 : 1;
  for (Corner &C : All.Corners) {
    const auto Near = [&](unsigned First) {
      const int64_t At = (First + R.below(9)) * 256 + R.wide(Bits);
      return static_cast<int>(std::clamp<int64_t>(At, -VX_GUARD_BAND,
                                                  2 * VX_GUARD_BAND - 1)) /
             Grid * Grid;
    };
    C = {Near(All.Tile.X), Near(All.Tile.Y)};
  }
  return All;
}

/// Pixels of the tile for which \p Expected and what was drawn differ.
template <typename Inside>
unsigned wrong(const std::vector<Visibility> &Drawn, const TileCommand &T,
               Inside Expected) {
  unsigned Wrong = 0;
  for (unsigned Row = 0; Row != T.Height; ++Row)
    for (unsigned Column = 0; Column != T.Width; ++Column)
      Wrong += (Drawn[Row * T.Width + Column].Primitive != VR_NO_PRIMITIVE) !=
               Expected(T.X + Column, T.Y + Row);
  return Wrong;
}

/// How many random triangles are tried.
uint32_t triangles() { return setting("VORION_TRIANGLES", 30000); }

TEST_F(SurfacesTest, RandomTrianglesAreThoseOfExactIntegers) {
  Random R(66);
  setDepth(7);
  uint64_t Covered = 0;
  for (uint32_t N = 0; N != triangles(); ++N) {
    const AboutTile A = randomAboutTile(R);
    const Triangle T = setUp(A.Corners);
    const auto Drawn = draw({&T, 1}, A.Tile);
    ASSERT_EQ(wrong(Drawn, A.Tile,
                    [&](unsigned Column, unsigned Row) {
                      const bool Is =
                          isInside(A.Corners, static_cast<int>(Column),
                                   static_cast<int>(Row));
                      Covered += Is;
                      return Is;
                    }),
              0U)
        << "triangle " << N;
  }
  EXPECT_GT(Covered, triangles());
}

TEST_F(SurfacesTest, RandomEdgesAreThoseOfExactIntegers) {
  Random R(67);
  setDepth(7);
  uint64_t Covered = 0;
  for (uint32_t N = 0; N != triangles(); ++N) {
    const TileCommand Tile = randomAboutTile(R).Tile;
    Triangle T{};
    T.Last = 0xFFFFFFFF;
    for (unsigned Edge = 0; Edge != 3; ++Edge) {
      T.A[Edge] = static_cast<int32_t>(R.wide(31));
      T.B[Edge] = static_cast<int32_t>(R.wide(31));
      // Near 0 in the tile, mostly; far away at times.
      const int64_t C = R.wide(R.below(8) == 0 ? 62 : 36) -
                        int64_t{T.A[Edge]} * Tile.X -
                        int64_t{T.B[Edge]} * Tile.Y;
      T.CLow[Edge] = static_cast<uint32_t>(C);
      T.CHigh[Edge] = static_cast<int32_t>(C >> 32);
    }
    const auto Drawn = draw({&T, 1}, Tile);
    ASSERT_EQ(wrong(Drawn, Tile,
                    [&](unsigned Column, unsigned Row) {
                      const bool Is = isInside(T, Column, Row);
                      Covered += Is;
                      return Is;
                    }),
              0U)
        << "triangle " << N;
  }
  EXPECT_GT(Covered, triangles());
}

/// How often each pixel of a tile of 64 x 64 at \p T is covered.
std::vector<unsigned> timesCovered(const std::vector<Fragment> &All,
                                   const TileCommand &T) {
  std::vector<unsigned> Times(T.Width * T.Height);
  for (const Fragment &F : All)
    ++Times[(rowOf(F.Pixel) - T.Y) * T.Width + columnOf(F.Pixel) - T.X];
  return Times;
}

TEST_F(SurfacesTest, FansCoverEachPixelOnce) {
  Random R(68);
  setDepth(7);
  for (unsigned N = 0; N != 40; ++N) {
    const TileCommand Tile{.X = R.below(60000), .Y = R.below(60000)};
    const int Grid = N % 2 ? 128 : 1;
    const auto In = [&](unsigned First, unsigned Pixels) {
      return static_cast<int>(First * 256 + R.below(Pixels * 256)) / Grid *
             Grid;
    };
    const Corner Hub{In(Tile.X, 64), In(Tile.Y, 64)};
    // Corners on a square about the tile, one after the other.
    const int Left = static_cast<int>(Tile.X) * 256 - 300,
              Top = static_cast<int>(Tile.Y) * 256 - 300, Side = 64 * 256 + 600;
    std::vector<int> Along{0, Side, 2 * Side, 3 * Side};
    for (unsigned K = 0; K != 3 + N; ++K)
      Along.push_back(static_cast<int>(R.below(4U * Side)) / Grid * Grid);
    std::ranges::sort(Along);
    const auto Place = [&](int At) {
      const int Rest = At % Side;
      switch (At / Side) {
      case 0:
        return Corner{Left + Rest, Top};
      case 1:
        return Corner{Left + Side, Top + Rest};
      case 2:
        return Corner{Left + Side - Rest, Top + Side};
      default:
        return Corner{Left, Top + Side - Rest};
      }
    };
    std::vector<Triangle> Fan;
    for (std::size_t K = 0; K != Along.size(); ++K) {
      Corner C[] = {Hub, Place(Along[K]), Place(Along[(K + 1) % Along.size()])};
      if (R.below(2))
        std::swap(C[1], C[2]);
      Fan.push_back(setUp(C));
    }
    for (const unsigned Times : timesCovered(drawFragments(Fan, Tile), Tile))
      ASSERT_EQ(Times, 1U) << "fan " << N;
  }
}

TEST_F(SurfacesTest, GridsCoverEachPixelOnce) {
  Random R(69);
  setDepth(7);
  for (unsigned N = 0; N != 20; ++N) {
    const TileCommand Tile{.X = R.below(60000), .Y = R.below(60000)};
    constexpr int Cells = 9;
    const int Cell = N == 0 ? 8 * 256 : 9 * 256; // once all on samples
    Corner Knots[Cells + 1][Cells + 1];
    for (int Row = 0; Row <= Cells; ++Row)
      for (int Column = 0; Column <= Cells; ++Column) {
        const bool IsRim =
            Row == 0 || Column == 0 || Row == Cells || Column == Cells;
        const auto Shift = [&] {
          return N == 0 || IsRim ? 0 : static_cast<int>(R.wide(9));
        };
        Knots[Row][Column] = {
            static_cast<int>(Tile.X) * 256 - 128 + Column * Cell + Shift(),
            static_cast<int>(Tile.Y) * 256 - 128 + Row * Cell + Shift()};
      }
    std::vector<Triangle> Grid;
    for (int Row = 0; Row != Cells; ++Row)
      for (int Column = 0; Column != Cells; ++Column) {
        const Corner A = Knots[Row][Column], B = Knots[Row][Column + 1],
                     C = Knots[Row + 1][Column + 1], D = Knots[Row + 1][Column];
        Grid.push_back(setUp({A, B, C}));
        Grid.push_back(setUp({C, A, D}));
      }
    for (const unsigned Times : timesCovered(drawFragments(Grid, Tile), Tile))
      ASSERT_EQ(Times, 1U) << "grid " << N;
  }
}

// A million triangles have their corners in one pixel. They are drawn as 50
// lists, each onto the depths of those before. The nearest triangle that covers
// the sample is found.
TEST_F(SurfacesTest, AMillionTrianglesMayLieInAPixel) {
  constexpr uint32_t Lists = 50, Count = 20000;
  constexpr TileCommand Tile{.X = 40, .Y = 50, .Width = 3, .Height = 3};
  Random R(70);
  std::vector<Triangle> All(Count);
  std::vector<Visibility> Drawn;
  float Nearest = 0;
  uint32_t First = VR_NO_PRIMITIVE;
  for (uint32_t L = 0; L != Lists; ++L) {
    for (uint32_t N = 0; N != Count; ++N) {
      const auto In = [&](unsigned Pixel) {
        return static_cast<int>(Pixel * 256 + R.below(257));
      };
      const Corner C[] = {{In(41), In(51)}, {In(41), In(51)}, {In(41), In(51)}};
      All[N] = setUp(C, L * Count + N);
      All[N].Depth = static_cast<float>(1 + R.below(1U << 24));
      All[N].DepthStep[0] = All[N].DepthStep[1] = 0;
      if (isInside(C, 41, 51) && All[N].Depth > Nearest) {
        Nearest = All[N].Depth;
        First = All[N].Tag;
      }
    }
    setDepth(4, true, L != 0);
    Drawn = draw(All, Tile);
  }
  EXPECT_EQ(Drawn[4].Primitive, First);
  EXPECT_EQ(Drawn[4].Depth, Nearest);
  EXPECT_EQ(wrong(Drawn, Tile,
                  [](unsigned Column, unsigned Row) {
                    return Column == 41 && Row == 51;
                  }),
            0U);
}

// A triangle from corner to corner of the largest picture, in the tiles along
// its edges and in some others.
TEST_F(SurfacesTest, ATriangleMayCover65536Pixels) {
  constexpr int End = 65536 * 256;
  const Corner Shapes[][3] = {{{0, 0}, {End, 0}, {0, End}},
                              {{0, End}, {End, 77}, {End, End - 1}},
                              {{-VX_GUARD_BAND, 5000},
                               {2 * VX_GUARD_BAND - 1, End / 2},
                               {-VX_GUARD_BAND, 5300}}};
  setDepth(7);
  for (const auto &C : Shapes) {
    const Triangle T = setUp(C);
    unsigned Covered = 0;
    for (unsigned N = 0; N < 1024; N += 31)
      for (const unsigned Row : {1023 - N, N, N / 2 + 1, N / 6 + 171}) {
        const TileCommand Tile{.X = 64 * N, .Y = 64 * std::min(Row, 1023U)};
        ASSERT_EQ(wrong(draw({&T, 1}, Tile), Tile,
                        [&](unsigned Column, unsigned Line) {
                          const bool Is = isInside(C, static_cast<int>(Column),
                                                   static_cast<int>(Line));
                          Covered += Is;
                          return Is;
                        }),
                  0U)
            << Tile.X << " " << Tile.Y;
      }
    EXPECT_GT(Covered, 100U);
  }
}

/// Covers all of the picture at one depth.
Triangle flat(float Depth, uint32_t Tag) {
  Triangle T{};
  T.Depth = Depth;
  T.Last = 0xFFFFFFFF;
  T.Tag = Tag;
  return T;
}

TEST_F(SurfacesTest, DepthFunctionsAreTheEight) {
  constexpr TileCommand Pixel{.Width = 1, .Height = 1};
  const float Depths[] = {1, 2, 3};
  const auto Expected = [](unsigned Function, float New, float Stored) {
    switch (Function) {
    case 0:
      return false;
    case 1:
      return New < Stored;
    case 2:
      return New == Stored;
    case 3:
      return New <= Stored;
    case 4:
      return New > Stored;
    case 5:
      return New != Stored;
    case 6:
      return New >= Stored;
    default:
      return true;
    }
  };
  for (unsigned Function = 0; Function != 8; ++Function) {
    for (const float New : Depths) {
      setDepth(Function, true, false, 2);
      const Triangle T = flat(New, 5);
      const Visibility V = draw({&T, 1}, Pixel)[0];
      const bool Passes = Expected(Function, New, 2);
      EXPECT_EQ(V.Primitive, Passes ? 5 : VR_NO_PRIMITIVE) << Function << New;
      EXPECT_EQ(V.Depth, Passes ? New : 2);
      // Without writing nothing changes, and the fragment still passes.
      setDepth(Function, false, false, 2);
      EXPECT_EQ(draw({&T, 1}, Pixel)[0].Primitive, VR_NO_PRIMITIVE);
      EXPECT_EQ(drawFragments({&T, 1}, Pixel).size(), Passes ? 1U : 0U);
    }
    EXPECT_EQ(passesDepth(Function, NotANumber, 1),
              Expected(Function, NotANumber, 1));
    EXPECT_EQ(passesDepth(Function, 1, NotANumber),
              Expected(Function, 1, NotANumber));
    EXPECT_EQ(passesDepth(Function, -0.0F, 0.0F), Expected(Function, 0, 0));
  }
}

TEST_F(SurfacesTest, IntegerDepthsAreRoundedBeforeTheTest) {
  constexpr TileCommand Pixel{.Width = 1, .Height = 1};
  constexpr float Largest = (1 << 24) - 1;
  const std::pair<float, float> Depths[] = {{0.5F, 0},
                                            {1.5F, 2},
                                            {2.5F, 2},
                                            {2.25F, 2},
                                            {2.75F, 3},
                                            {-0.5F, 0},
                                            {Largest, Largest},
                                            {65534.5F, 65534},
                                            {3, 3},
                                            {8388607.5F, 8388608}};
  for (const auto &[Given, Rounded] : Depths) {
    setDepth(VR_DEPTH_ALWAYS, true, false, 0, true);
    const Triangle T = flat(Given, 5);
    EXPECT_EQ(draw({&T, 1}, Pixel)[0].Depth, Rounded);
    const auto Handed = drawFragments({&T, 1}, Pixel);
    ASSERT_EQ(Handed.size(), 1U);
    EXPECT_EQ(Handed[0].Depth, Rounded);
  }
  // Of two that become equal the first stays, though the second is nearer.
  const Triangle Both[] = {flat(6.75F, 1), flat(7.25F, 2)};
  setDepth(VR_DEPTH_GREATER, true, false, 0, true);
  EXPECT_EQ(draw(Both, Pixel)[0].Primitive, 1U);
  setDepth(VR_DEPTH_GREATER);
  EXPECT_EQ(draw(Both, Pixel)[0].Primitive, 2U);
}

TEST_F(SurfacesTest, DepthIsAPlaneAboutTheFirstPixelOfTheBox) {
  Triangle T = flat(8, 3);
  T.DepthStep[0] = 0.5F;
  T.DepthStep[1] = -0.25F;
  T.First = 10 | 20 << 16;
  T.Last = 40 | 50 << 16;
  setDepth(7);
  const TileCommand Tile{.X = 8, .Y = 16, .Width = 64, .Height = 64};
  const auto V = draw({&T, 1}, Tile);
  for (unsigned Y = 0; Y != 64; ++Y)
    for (unsigned X = 0; X != 64; ++X) {
      const int FromX = int(8 + X) - 10, FromY = int(16 + Y) - 20;
      const bool In = FromX >= 0 && FromX <= 30 && FromY >= 0 && FromY <= 30;
      ASSERT_EQ(V[Y * 64 + X].Primitive, In ? 3 : VR_NO_PRIMITIVE);
      ASSERT_EQ(V[Y * 64 + X].Depth, In ? 8 + 0.5F * FromX - 0.25F * FromY : 0);
    }
}

TEST_F(SurfacesTest, SetUpInterpolatesTheCornersDepths) {
  const Corner C[] = {{1000, 700}, {15000, 2000}, {4000, 14000}};
  const Triangle T = setUp(C, 1, {0.5F, 0.25F, 0.125F});
  // Of the plane through the corners, in doubles.
  const double X1 = C[1].X - C[0].X, Y1 = C[1].Y - C[0].Y, X2 = C[2].X - C[0].X,
               Y2 = C[2].Y - C[0].Y, Area = X1 * Y2 - X2 * Y1, D1 = -0.25,
               D2 = -0.375;
  const double StepX = (D1 * Y2 - D2 * Y1) / Area,
               StepY = (X1 * D2 - X2 * D1) / Area;
  setDepth(7);
  for (const Fragment &F : drawFragments({&T, 1})) {
    const double X = 256. * columnOf(F.Pixel) + 128 - C[0].X,
                 Y = 256. * rowOf(F.Pixel) + 128 - C[0].Y;
    ASSERT_NEAR(F.Depth, 0.5 + StepX * X + StepY * Y, 1e-6);
  }
}

TEST_F(SurfacesTest, AnEmptyListClearsTheTile) {
  const Triangle T = flat(2, 1);
  setDepth(7);
  draw({&T, 1});
  setDepth(7, true, false, 0.5F);
  for (const Visibility &V : draw({})) {
    ASSERT_EQ(V.Depth, 0.5F);
    ASSERT_EQ(V.Primitive, VR_NO_PRIMITIVE);
  }
}

TEST_F(SurfacesTest, ATileGoesOnWithWhatWasStored) {
  const TileCommand Tile{.Width = 5, .Height = 3};
  const Triangle Near = flat(2, 1), Far = flat(1, 2), Nearest = flat(3, 4);
  setDepth(4); // 1/z: greater is nearer
  draw({&Near, 1}, Tile);
  setDepth(4, true, true);
  EXPECT_EQ(draw({&Far, 1}, Tile)[14].Primitive, 1U);
  EXPECT_TRUE(drawFragments({&Far, 1}, Tile).empty());
  EXPECT_EQ(draw({&Nearest, 1}, Tile)[0].Primitive, 4U);
  // Fragments leave memory as it is.
  setDepth(7, true, true);
  EXPECT_EQ(drawFragments({&Far, 1}, Tile).size(), 15U);
  EXPECT_EQ(visible(Tile)[0].Primitive, 4U);
}

TEST_F(SurfacesTest, FragmentsComeInTheOrderOfSubmission) {
  const TileCommand Tile{.X = 100, .Y = 7, .Width = 3, .Height = 2};
  const Triangle All[] = {flat(1, 10), flat(3, 11), flat(2, 12)};
  setDepth(4);
  const auto Got = drawFragments(All, Tile);
  ASSERT_EQ(Got.size(), 12U); // the third is behind the second
  for (unsigned N = 0; N != 12; ++N) {
    EXPECT_EQ(Got[N].Primitive, 10 + N / 6);
    EXPECT_EQ(Got[N].Pixel, (100 + N % 3) | (7 + N % 6 / 3) << 16);
    EXPECT_EQ(Got[N].Depth, N < 6 ? 1 : 3);
  }
}

TEST_F(SurfacesTest, FullBatchesHaltTheRasterizer) {
  const std::vector<Triangle> All(3, flat(1, 9));
  setDepth(7);
  configureTriangles(All, {.Mode = ModeFragments.put(1)});
  set(Csr::Start, 1U);
  while (Unit.step()) {
  }
  EXPECT_TRUE(Agent.isBusy());
  EXPECT_TRUE(Agent.canTakeBatch());
  unsigned Batches = 0;
  while (Agent.read(Csr::GradNext, 0) != 0) {
    ++Batches;
    while (Unit.step()) {
    }
  }
  EXPECT_EQ(Batches, 3U * 64 * 64 / VR_GRAD_LANES);
  EXPECT_EQ(Agent.counters().Fragments, 3U * 64 * 64);
  EXPECT_EQ(Agent.counters().Blends, 3U * 64 * 64);
}

TEST_F(SurfacesTest, ABadRecordEndsTheCommand) {
  std::vector<Triangle> All(5, flat(1, 9));
  All[3].DepthStep[1] = NotANumber;
  const TileCommand Tile{.Width = 4, .Height = 4};
  setDepth(7);
  uint32_t Status = VR_OK;
  EXPECT_EQ(drawFragments(All, Tile, &Status).size(), 48U);
  EXPECT_EQ(Status, VR_NAN);
  // Nothing of a tile that fails is written.
  draw({All.data(), 1}, Tile);
  All[0].Tag = 77;
  configureTriangles(All, Tile);
  EXPECT_EQ(start(), VR_NAN);
  EXPECT_EQ(visible(Tile)[0].Primitive, 9U);
}

TEST_F(SurfacesTest, BadConfigurationsHaveTheirCodes) {
  struct Case {
    Csr Where;
    uint32_t Value, Status;
  };
  const uint32_t Mode = ModePrimitive.put(VR_PRIMITIVE_TRIANGLE);
  const Case Cases[] = {
      {Csr::Mode, Mode | ModePushed.put(1), VR_BAD_MODE},
      {Csr::Mode, Mode | ModeDrain.put(1), VR_BAD_MODE},
      {Csr::Mode, Mode | ModeKeepLast.put(1), VR_BAD_MODE},
      {Csr::Mode, Mode | ModeKeepCounts.put(1), VR_BAD_MODE},
      {Csr::Mode, Mode | ModeBackward.put(1), VR_BAD_MODE},
      {Csr::Mode, Mode | 1U << 9, VR_BAD_MODE},
      {Csr::Mode, ModePrimitive.put(2), VR_BAD_MODE},
      {Csr::Mode, ModePrimitive.put(7), VR_BAD_MODE},
      {Csr::Mode, ModeFragments.put(1), VR_BAD_MODE},
      {Csr::Ztile, ZtileCount.put(2), VR_BAD_MODE},
      {Csr::Options, OptionsSkipSaturated.put(1), VR_BAD_MODE},
      {Csr::Word, 1U << 6, VR_BAD_MODE},
      {Csr::TileShape, TileShapeWidth.put(65) | TileShapeHeight.put(8),
       VR_BAD_SHAPE},
      {Csr::Count, VR_MAX_COUNT + 1, VR_BAD_COUNT},
      {Csr::TailCount, 3, VR_BAD_TAIL},
      {Csr::Output, Pixels + 4, VR_MISALIGNED},
      {Csr::OutputPitch, 12, VR_MISALIGNED},
      {Csr::Output, 0, VR_UNMAPPED},
      {Csr::List, 0, VR_UNMAPPED},
  };
  const Triangle T = flat(1, 1);
  for (const Case &C : Cases) {
    configureTriangles({&T, 1});
    set(Csr::Options, 0U);
    set(Csr::TailCount, 0U);
    setDepth(7);
    set(Csr::Index, VR_WORD_DEPTH);
    set(C.Where, C.Value);
    set(Csr::Start, 1U);
    while (Unit.step()) {
    }
    if (C.Where == Csr::Mode)
      EXPECT_EQ(Agent.read(Csr::GradNext, 0), 0U);
    while (Unit.step()) {
    }
    EXPECT_EQ(Agent.read(Csr::Wait, 0), C.Status)
        << std::hex << static_cast<unsigned>(C.Where) << " " << C.Value;
  }
  // What is aligned to a pixel is not misaligned.
  configureTriangles({&T, 1});
  set(Csr::TailCount, 0U);
  set(Csr::Output, Pixels + 8);
  EXPECT_EQ(start(), VR_OK);
}

TEST_F(SurfacesTest, LastContributorsTakeAFifthWord) {
  for (const auto [Width, Height, Status] :
       {std::array{64U, 64U, VR_BAD_SHAPE}, std::array{33U, 64U, VR_BAD_SHAPE},
        std::array{32U, 64U, VR_OK}, std::array{64U, 32U, VR_OK}}) {
    configure({},
              {.Mode = ModeKeepLast.put(1), .Width = Width, .Height = Height});
    set(Csr::Last, Records + 0x680000);
    EXPECT_EQ(start(), Status) << Width << " " << Height;
  }
}

TEST_F(SurfacesTest, WordsThatDoNotExistReadAsZero) {
  setWord(VR_WORD_DEPTH, 9);
  EXPECT_EQ(Agent.read(Csr::Word, 0), 9U);
  setWord(1000, 5);
  EXPECT_EQ(Agent.read(Csr::Word, 0), 0U);
  EXPECT_EQ(Agent.read(Csr::Index, 0), 1000U);
}

} // namespace
} // namespace vorion::raster
