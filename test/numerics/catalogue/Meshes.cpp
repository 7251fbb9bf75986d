// Meshes whose triangles are hard to set up: slivers, shared edges,
// T-junctions, ties, corners beside and behind the camera, decals.
//
// The contract is about each pixel of the mesh that the machine shows
// (docs/hard-cases.md, "Meshes"). A corner is displaced by at most e on the
// picture, in columns and in rows: half a sub-pixel, and what fp32 rounds. So
// an edge, which lies between its corners, is displaced by at most sqrt(2) e,
// and a pixel whose sample is farther from all edges is covered exactly as in
// fp64. Its depth is that of the plane at most sqrt(2) e away, and what
// vx_triangle_setup and the lanes round.
#include "Build.h"
#include "TrainingCase.h"

#include "mesh/Mesh.h"
#include "picture/View.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace vorion::test {
namespace {

constexpr double Unit = 0x1p-24; ///< the relative error of an operation
constexpr double Snap = 0x1p-9;  ///< half of 1/256 pixel
constexpr int Width = 64, Height = 48;
constexpr double Focal = 50;
/// Columns and rows at which the kernels cut triangles have no more digits.
constexpr double GuardBand = 130000;

using Point = std::array<double, 3>;

struct MeshScene {
  splat::Mesh Mesh;
  splat::Scene Scene;

  /// The axes are the camera's, so that no rounding comes before the
  /// projection.
  void triangle(const Point &A, const Point &B, const Point &C) {
    if (Mesh.Materials.empty())
      Mesh.Materials.emplace_back();
    std::vector<splat::MeshCorner> Polygon;
    for (const Point &P : {A, B, C})
      Polygon.push_back({.Vertex = Mesh.addVertex({static_cast<float>(P[0]),
                                                   static_cast<float>(P[1]),
                                                   static_cast<float>(P[2])},
                                                  {0.25F, 0.5F, 0.75F, 1})});
    Mesh.addPolygon(Polygon, 0);
  }
  Point corner(std::size_t Number) const {
    const std::size_t At = 3 * std::size_t{Mesh.Corners[Number]};
    return {double(Mesh.Positions[At]), double(Mesh.Positions[At + 1]),
            double(Mesh.Positions[At + 2])};
  }
};

/// The point that is seen at a column and a row, at depth \p Z.
Point seen(double X, double Y, double Z) {
  return {(X - Width / 2.0) * Z / Focal, (Y - Height / 2.0) * Z / Focal, Z};
}

/// A triangle in fp64: its polygon in front of the near plane, on the picture,
/// its plane of 1/z there, and by how much the machine may be off.
class Exact {
public:
  Exact(const MeshScene &S, std::size_t Triangle, double Near) {
    std::array<Point, 3> P;
    double Reach = 0, Nearest = HUGE_VAL;
    for (std::size_t K = 0; K != 3; ++K) {
      P[K] = S.corner(3 * Triangle + K);
      for (const double X : P[K])
        Reach = std::max(Reach, std::abs(X));
    }
    bool IsCut = false;
    for (std::size_t K = 0; K != 3; ++K) {
      const Point &A = P[K], &B = P[(K + 1) % 3];
      const bool Here = A[2] >= Near, There = B[2] >= Near;
      if (Here)
        add(A);
      IsCut |= !Here;
      if (Here != There) {
        const double Part = (A[2] - Near) / (A[2] - B[2]);
        add({A[0] + Part * (B[0] - A[0]), A[1] + Part * (B[1] - A[1]), Near});
      }
    }
    for (const Point &C : Corners) {
      IsCut |= std::abs(C[0]) > GuardBand / 2 || std::abs(C[1]) > GuardBand / 2;
      Nearest = std::min(Nearest, 1 / C[2]);
    }
    // A projection is three operations on numbers of at most the place and the
    // centre's. A cut is six on the corners' coordinates, twice as large for
    // their differences, and the projection magnifies it.
    for (const Point &C : Corners)
      for (int K = 0; K != 2; ++K)
        Displaced = std::max(
            Displaced,
            Snap +
                3 * Unit *
                    (std::min(std::abs(C[std::size_t(K)]), GuardBand) + Width));
    if (IsCut)
      Displaced += 12 * Unit * Reach * Focal / Nearest;
    Displaced *= std::sqrt(2.0);
    setPlane(P, IsCut ? 12 * Unit * Reach / Nearest : 0);
  }

  /// How far inside of the polygon a place is, px; negative outside.
  double inside(double X, double Y) const {
    if (Corners.size() < 3 || !HasPlane)
      return -HUGE_VAL;
    double Least = HUGE_VAL;
    for (std::size_t K = 0; K != Corners.size(); ++K) {
      const Point &A = Corners[K], &B = Corners[(K + 1) % Corners.size()];
      const double Dx = B[0] - A[0], Dy = B[1] - A[1];
      const double Length = std::hypot(Dx, Dy);
      if (Length > 0)
        Least = std::min(Least,
                         Side * (Dx * (Y - A[1]) - Dy * (X - A[0])) / Length);
    }
    return Least;
  }
  double depth(double X, double Y) const {
    return Plane[0] * X + Plane[1] * Y + Plane[2];
  }
  double displaced() const { return Displaced; }
  double depthError() const { return DepthError; }

private:
  void add(const Point &P) {
    Corners.push_back({Focal * P[0] / P[2] + Width / 2.0,
                       Focal * P[1] / P[2] + Height / 2.0, 1 / P[2]});
  }

  /// 1/z = (N, ray) / (N, A) with the normal N and the ray through a pixel.
  void setPlane(const std::array<Point, 3> &P, double OfCuts) {
    Point U{}, V{};
    for (std::size_t K = 0; K != 3; ++K) {
      U[K] = P[1][K] - P[0][K];
      V[K] = P[2][K] - P[0][K];
    }
    const Point N{U[1] * V[2] - U[2] * V[1], U[2] * V[0] - U[0] * V[2],
                  U[0] * V[1] - U[1] * V[0]};
    const double Off = N[0] * P[0][0] + N[1] * P[0][1] + N[2] * P[0][2];
    HasPlane = Off != 0 && Corners.size() >= 3;
    if (!HasPlane)
      return;
    Plane = {N[0] / Off / Focal, N[1] / Off / Focal, N[2] / Off};
    Plane[2] -= Plane[0] * Width / 2 + Plane[1] * Height / 2;
    double Area = 0, Perimeter = 0, Largest = 0;
    for (std::size_t K = 0; K != Corners.size(); ++K) {
      const Point &A = Corners[K], &B = Corners[(K + 1) % Corners.size()];
      Area += A[0] * B[1] - A[1] * B[0];
      Perimeter += std::hypot(B[0] - A[0], B[1] - A[1]);
      Largest = std::max(Largest, A[2]);
    }
    Side = Area < 0 ? -1 : 1;
    // Set-up adds three products of an edge's value and a depth, and divides by
    // the area: six operations. The box's first pixel, and the tile's, are at
    // most the picture and a tile away from a pixel, so edges have at most
    // Perimeter x Away there. Steps likewise; the lanes add four operations.
    // Of a fan's triangles none has less than what is left of the area.
    const double Away = Width + Height + 128;
    const double Least =
        std::max(std::abs(Area) / (2.0 * double(Corners.size() - 2)) -
                     Perimeter * Displaced,
                 0x1p-17);
    DepthError = Unit * Largest * (6 * 4 * Perimeter * Away / Least + 2) +
                 OfCuts * Largest + std::hypot(Plane[0], Plane[1]) * Displaced;
  }

  std::vector<Point> Corners; ///< column, row, 1/z
  Point Plane{};              ///< steps by column and row, value at (0, 0)
  double Displaced = 0, DepthError = 0, Side = 1;
  bool HasPlane = false;
};

/// What the machine shows of a mesh.
struct Shown {
  splat::RenderResult Result;
  double Near;

  int32_t triangle(int X, int Y) const {
    return Result.MeshShown->Triangles[place(X, Y)];
  }
  double depth(int X, int Y) const {
    return 1 / double(Result.MeshShown->Depth[place(X, Y)]);
  }

private:
  static std::size_t place(int X, int Y) {
    return std::size_t{Width} * std::size_t(Y) + std::size_t(X);
  }
};

Expected<Shown> draw(splat::Launcher &L, const Way &W, const MeshScene &S) {
  splat::RenderOptions O;
  O.Blending = W.Blending;
  O.Surface = std::make_shared<const splat::Mesh>(S.Mesh);
  O.KeepVisible = true;
  O.Cutoff = 0;
  splat::Scene Scene = S.Scene;
  if (Scene.size() == 0)
    add(Scene, {.Mean = {0, 0, -5}}); // behind the camera
  const splat::Camera View = frontView(Width, Height, Focal);
  const splat::ViewFacts Facts =
      splat::factsOf(Scene, splat::makeView(View, O), O);
  auto R = splat::render(
      L, splat::planRender(splat::EffectPlan({}, {Scene, O, Facts}), O), Scene,
      View, O, /*KeepPairs=*/false);
  if (!R)
    return R.error();
  return Shown{.Result = std::move(*R), .Near = double(O.nearLimit())};
}

/// The contract of every pixel.
void judge(Worst &W, const MeshScene &S, const Shown &Is) {
  std::vector<Exact> All;
  for (std::size_t T = 0; T != S.Mesh.triangles(); ++T)
    All.emplace_back(S, T, Is.Near);
  for (int Y = 0; Y != Height; ++Y)
    for (int X = 0; X != Width; ++X) {
      const double At[] = {X + 0.5, Y + 0.5};
      const int32_t Triangle = Is.triangle(X, Y);
      // Read back as z, which rounds twice.
      const double Depth = Is.depth(X, Y) * (1 - 2 * Unit);
      if (Triangle >= 0) {
        const Exact &E = All[std::size_t(Triangle)];
        W.demand(E.inside(At[0], At[1]) >= -E.displaced(),
                 fmt::format("pixel {}, {} has triangle {}, which is {:.3g} px "
                             "away, expected at most {:.3g}",
                             X, Y, Triangle, -E.inside(At[0], At[1]),
                             E.displaced()));
        W.take(fmt::format("1/z of pixel {}, {}", X, Y), Depth,
               E.depth(At[0], At[1]), E.depthError());
      }
      for (std::size_t T = 0; T != All.size(); ++T) {
        const Exact &E = All[T];
        if (E.inside(At[0], At[1]) <= E.displaced())
          continue;
        W.demand(Triangle >= 0, fmt::format("pixel {}, {} shows no triangle, "
                                            "expected {}",
                                            X, Y, T));
        W.demand(Triangle < 0 ||
                     Depth >= E.depth(At[0], At[1]) - E.depthError(),
                 fmt::format("pixel {}, {} shows triangle {}, expected {} in "
                             "front of it",
                             X, Y, Triangle, T));
      }
    }
}

/// All pixels show a triangle.
void demandFilled(Worst &W, const Shown &Is) {
  for (int Y = 0; Y != Height; ++Y)
    for (int X = 0; X != Width; ++X)
      W.demand(Is.triangle(X, Y) >= 0,
               fmt::format("pixel {}, {} shows no triangle, expected a mesh "
                           "without cracks",
                           X, Y));
}

/// Draws and judges; \p More has further demands, or none.
TrainingCase meshCase(const char *Name, const char *Why, MeshScene (*Make)(),
                      void (*More)(Worst &, const Shown &),
                      std::vector<std::string> FoundIn) {
  return {Name, Why,
          "coverage and depth within the derived bounds (part of the bound)",
          [=](splat::Launcher &L, const Way &Of) -> Expected<Finding> {
            const MeshScene S = Make();
            const auto Is = draw(L, Of, S);
            if (!Is)
              return Is.error();
            Worst W(1);
            judge(W, S, *Is);
            if (More)
              More(W, *Is);
            return W.finding(L);
          },
          std::move(FoundIn)};
}

void nothing(Worst & /*W*/, const Shown & /*Is*/) {}

/// Long triangles of half a pixel to 1/300 pixel, across and along the rows.
MeshScene slivers() {
  MeshScene S;
  Numbers R(71);
  for (int I = 0; I != 40; ++I) {
    const double X = R.uniform(0, Width), Y = R.uniform(0, Height);
    const double Angle = R.uniform(0, 6.3), Long = R.uniform(10, 60);
    const double Thick = std::pow(2.0, -R.uniform(1, 8.2));
    const double Dx = std::cos(Angle), Dy = std::sin(Angle);
    S.triangle(seen(X, Y, R.uniform(1, 3)),
               seen(X + Long * Dx, Y + Long * Dy, R.uniform(1, 3)),
               seen(X - Thick * Dy, Y + Thick * Dx, R.uniform(1, 3)));
  }
  return S;
}

/// A grid of shifted knots over the whole picture and its rim; a fan in it.
MeshScene sharedEdges() {
  constexpr int Cells = 12;
  MeshScene S;
  Numbers R(72);
  Point Knots[Cells + 1][Cells + 1];
  for (int I = 0; I <= Cells; ++I)
    for (int J = 0; J <= Cells; ++J)
      Knots[I][J] = seen(-8 + (Width + 16.0) * J / Cells + R.uniform(-2, 2),
                         -8 + (Height + 16.0) * I / Cells + R.uniform(-2, 2),
                         R.uniform(1, 4));
  for (int I = 0; I != Cells; ++I)
    for (int J = 0; J != Cells; ++J) {
      const Point &A = Knots[I][J], &B = Knots[I][J + 1],
                  &C = Knots[I + 1][J + 1], &D = Knots[I + 1][J];
      const Point Hub = seen(-8 + (Width + 16.0) * (J + 0.5) / Cells,
                             -8 + (Height + 16.0) * (I + 0.5) / Cells, 2);
      S.triangle(A, B, Hub);
      S.triangle(C, B, Hub);
      S.triangle(C, D, Hub);
      S.triangle(D, A, Hub);
    }
  return S;
}

/// Edges with a corner of other triangles in the middle: pixels may be empty
/// only within the bound.
MeshScene tJunctions() {
  MeshScene S;
  Numbers R(73);
  for (int I = 0; I != 8; ++I) {
    const double Y = 3 + 5.5 * I;
    const Point A = seen(2, Y + R.uniform(-1, 1), 2),
                B = seen(62, Y + R.uniform(-1, 1), 3);
    Point T{};
    const double Part = R.uniform(0.2, 0.8);
    for (std::size_t K = 0; K != 3; ++K)
      T[K] = A[K] + Part * (B[K] - A[K]);
    const Point Above = seen(30, Y - 3, 2.5), Below = seen(34, Y + 3, 2.5);
    S.triangle(A, B, Above);
    S.triangle(A, T, Below);
    S.triangle(T, B, Below);
  }
  return S;
}

/// Each triangle twice: the first of the file is seen.
MeshScene ties() {
  MeshScene S;
  Numbers R(74);
  for (int I = 0; I != 12; ++I) {
    const auto Any = [&] {
      return seen(R.uniform(0, Width), R.uniform(0, Height), R.uniform(1, 5));
    };
    const Point A = Any(), B = Any(), C = Any();
    S.triangle(A, B, C);
    S.triangle(A, B, C);
  }
  return S;
}
void demandFirst(Worst &W, const Shown &Is) {
  for (int Y = 0; Y != Height; ++Y)
    for (int X = 0; X != Width; ++X)
      W.demand(Is.triangle(X, Y) < 0 || Is.triangle(X, Y) % 2 == 0,
               fmt::format("pixel {}, {} shows triangle {}, expected the one "
                           "before it, which is the same",
                           X, Y, Is.triangle(X, Y)));
}

/// Corners at, beside and behind the camera: w is 0 or less.
MeshScene behindCamera() {
  MeshScene S;
  S.triangle({-1, -1, -1}, {1, -1, -1}, {0, 1, -2}); // all behind
  S.triangle({-3, 1, 0}, {3, 1, 0}, {0, 2, 8});      // two with z = 0
  S.triangle({0, 0, 0}, {-4, -2, 6}, {-2, -3, 6});   // the camera itself
  S.triangle({5, -1, -5}, {1, -2, 6}, {2, -1, 6});
  S.triangle({-5, 0.5, 6}, {5, 0.5, -6}, {5, 3, 6});
  return S;
}

/// Triangles through the near plane, one along it and one in it.
MeshScene nearCrossing() {
  const double Near = double(0.2F);
  MeshScene S;
  Numbers R(75);
  for (int I = 0; I != 10; ++I) {
    const auto Any = [&](double Z) {
      return Point{R.uniform(-0.15, 0.15), R.uniform(-0.1, 0.1), Z};
    };
    S.triangle(Any(R.uniform(-1, 0.19)), Any(R.uniform(0.21, 3)),
               Any(R.uniform(0.1, 0.5)));
  }
  S.triangle({-0.1, 0.02, Near}, {0.1, 0.02, Near}, {0, 0.08, 0.1});
  S.triangle({-0.02, -0.09, Near}, {0.02, -0.09, Near}, {0, -0.05, Near});
  return S;
}

/// A floor, a wall and needles whose corners are seen at columns up to 10^7.
MeshScene guardCrossing() {
  MeshScene S;
  S.triangle({-4e4, 1, 0.25}, {4e4, 1, 0.25}, {0, 1, 1e4});
  S.triangle({-1, -1e5, 2}, {-0.5, 1e5, 2}, {-0.8, 1e5, 3});
  S.triangle({0.2, -0.3, 2}, {1e5, -0.2, 3}, {1e5, -0.21, 3});
  S.triangle({0.5, -0.5, 2}, {-9e4, -7e4, 0.3}, {9e4, -7e4, 0.3});
  S.triangle(seen(5, 5, 2), seen(2e6, 1e6, 2), seen(5, 20, 2));
  return S;
}

/// Small triangles in the plane of a large one, in its very plane and in front
/// of it by a thousandth.
MeshScene decals() {
  MeshScene S;
  Numbers R(76);
  const auto At = [](double X, double Y, double Nearer) {
    Point P = seen(X, Y, 1 / (0.5 + 0.002 * X + 0.001 * Y));
    for (double &Part : P)
      Part *= 1 - Nearer;
    return P;
  };
  S.triangle(At(-60, -60, 0), At(180, -60, 0), At(-60, 180, 0));
  for (int I = 0; I != 20; ++I) {
    const double X = R.uniform(4, 56), Y = R.uniform(4, 40);
    const double Nearer = I % 2 ? 1e-3 : 0;
    S.triangle(At(X, Y, Nearer), At(X + 7, Y + R.uniform(-2, 2), Nearer),
               At(X + R.uniform(-2, 2), Y + 7, Nearer));
  }
  return S;
}

/// Gaussians in the mesh's depth, and one step of fp32 before and behind it.
Expected<Finding> gaussianTies(splat::Launcher &L, const Way &Of) {
  Worst W(0);
  for (const int Steps : {-1, 0, 1}) {
    MeshScene S;
    S.triangle({-9, -9, 2}, {9, -9, 2}, {-9, 9, 2});
    S.triangle({9, 9, 2}, {9, -9, 2}, {-9, 9, 2});
    const float Z = Steps == 0 ? 2.0F : std::nextafter(2.0F, Steps * 9.0F);
    add(S.Scene, {.Mean = {0, 0, Z}, .Scale = {0.3, 0.3, 0.01}});
    const auto Is = draw(L, Of, S);
    if (!Is)
      return Is.error();
    const std::size_t Middle = 3 * std::size_t{Height / 2 * Width + Width / 2};
    const double Red = double(Is->Result.Picture.Render[Middle]);
    W.demand((std::abs(Red - 0.25) < 1e-6) == (Steps >= 0),
             fmt::format("a Gaussian at {:.9g} gives red {:.6g}, expected {} "
                         "mesh at 2",
                         Z, Red,
                         Steps < 0 ? "more than of the" : "0.25 of the"));
  }
  return W.finding(L);
}

} // namespace

void addMeshes(std::vector<TrainingCase> &Cases) {
  Cases.push_back(meshCase("mesh-slivers",
                           "triangles of half a pixel to 1/300 pixel across",
                           slivers, nothing, {"mesh-snapped-coarsely"}));
  Cases.push_back(meshCase(
      "mesh-shared-edges",
      "a grid of fans over the picture: no pixel may be missed or cracked",
      sharedEdges, demandFilled, {"mesh-depth-not-inverse"}));
  Cases.push_back(meshCase("mesh-t-junctions",
                           "a corner in the middle of another's edge: a crack "
                           "is at most as wide as the bound",
                           tJunctions, nothing, {"mesh-depth-not-inverse"}));
  Cases.push_back(meshCase("mesh-ties", "each triangle twice, to the last bit",
                           ties, demandFirst, {"mesh-ties-last"}));
  Cases.push_back(meshCase("mesh-behind-camera", "corners with z of 0 and less",
                           behindCamera, nothing, {"mesh-uncut"}));
  Cases.push_back(meshCase("mesh-near-crossing",
                           "triangles through the near plane and in it",
                           nearCrossing, nothing, {"mesh-near-uncut"}));
  Cases.push_back(meshCase("mesh-guard-crossing",
                           "corners at columns up to 10 million: cut at the "
                           "guard band, where fp32 has steps of 1/128 px",
                           guardCrossing, nothing, {"mesh-guard-uncut"}));
  Cases.push_back(meshCase("mesh-decals",
                           "triangles in the plane of another, and in front "
                           "of it by a thousandth",
                           decals, nothing, {"mesh-depth-not-inverse"}));
  Cases.push_back({"mesh-gaussian-ties",
                   "a Gaussian at the mesh's depth is hidden, one a step of "
                   "fp32 nearer is not",
                   "hidden from the mesh's depth on",
                   gaussianTies,
                   {"mesh-limit-behind-ties"}});
}

} // namespace vorion::test
