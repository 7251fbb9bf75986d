#include "demo/BenchmarkScene.h"

#include "demo/PortableMath.h"
#include "demo/ShFit.h"
#include "vorion/support/SplitMix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

namespace vorion::splat::demo {

namespace {

using glm::dvec3;

/// Uniform random numbers from 0 to 1, a stream for each Gaussian.
class Draw {
public:
  Draw(uint64_t A, uint64_t B)
      : State(splitmix::mix(splitmix::mix(A + splitmix::Step) ^
                            (B * splitmix::Step))) {}

  double uniform() {
    return (static_cast<double>(splitmix::next(State) >> 11) + 0.5) * 0x1p-53;
  }
  /// Nearly normal: the sum of four uniform numbers, of standard deviation 1
  /// and at most 3.5.
  double normal() {
    double Sum = 0; // one after the other: the order of operands is open
    for (int N = 0; N != 4; ++N)
      Sum += uniform();
    return (Sum - 2) * std::numbers::sqrt3;
  }

private:
  uint64_t State;
};

/// A part's surface is divided into cells of about this side, metres; they and
/// blocks of them differ in how many Gaussians they have.
double cellSide(BenchmarkKind K) {
  switch (K) {
  case BenchmarkKind::Indoor:
    return 0.15;
  case BenchmarkKind::Outdoor:
    return 0.3;
  case BenchmarkKind::Object:
    return 0.06;
  }
  __builtin_unreachable();
}
constexpr int CellsAcross = 4; // of a block

/// A cell and its weight, the number of Gaussians but for a factor.
struct Cell {
  const Part *Of;
  uint64_t Id;
  double S, T, Width, Height; ///< in the part
  double Area, Weight;
  double Size, Faint, Opaque; ///< of the shape, as they are in the block
};

void addCells(std::vector<Cell> &Cells, const Part &P, uint64_t Id,
              BenchmarkKind K, const dvec3 &FirstView,
              const BenchmarkShape &Shape) {
  const double Seen = P.From == Seen::InViews  ? 1
                      : P.From == Seen::Behind ? Shape.Behind
                                               : Shape.Nowhere;
  if (Seen == 0)
    return;
  const auto [Along, Up] = P.lengths();
  const auto Count = [&](double Length) {
    return std::clamp(static_cast<int>(std::lround(Length / cellSide(K))), 1,
                      100);
  };
  const int Columns = Count(Along), Rows = Count(Up);
  // Crowns have leaves inside, too.
  const double Leaves = P.Shape == Part::Form::Crown ? 2.5 : 1;
  const double Area = Leaves * P.area() / (Columns * Rows);
  const Focus Subject = benchmarkFocus(K);
  for (int Y = 0; Y < Rows; ++Y)
    for (int X = 0; X < Columns; ++X) {
      const auto Place = [&](int Div) {
        return Id << 32 | static_cast<uint64_t>(Y / Div) << 16 |
               static_cast<uint64_t>(X / Div);
      };
      Draw Block(Place(CellsAcross), 2);
      const double Z = 0.7 * Draw(Place(1), 1).normal() + 0.7 * Block.normal();
      Cell C;
      C.Of = &P;
      C.Id = Place(1);
      C.Width = 1.0 / Columns;
      C.Height = 1.0 / Rows;
      C.S = X * C.Width;
      C.T = Y * C.Height;
      C.Area = Area;
      C.Size = Shape.Size * portableExp(Shape.BlockSize * Block.normal());
      C.Faint = Shape.Faint * portableExp(Shape.BlockFaint * Block.normal());
      C.Opaque = Shape.Opaque * portableExp(Shape.BlockOpaque * Block.normal());
      const Part::Point At = P.at(C.S + 0.5 * C.Width, C.T + 0.5 * C.Height);
      const dvec3 Away = (At.Position - Subject.Middle) / Subject.Radius;
      const bool IsBack = P.Shape != Part::Form::Crown &&
                          glm::dot(At.Normal, FirstView - At.Position) < 0;
      C.Weight = Seen * (IsBack ? Shape.Back : 1) * Area *
                 portableExp(Shape.Clumps * Z) *
                 portablePower(1 + glm::dot(Away, Away), -0.5 * Shape.Fading);
      Cells.push_back(C);
    }
}

/// Linear light to display value: gamma 2.
dvec3 toDisplay(const dvec3 &Linear) {
  return glm::sqrt(glm::clamp(Linear, dvec3(0), dvec3(1)));
}

const dvec3 Sun = glm::normalize(dvec3(0.5, 0.75, 0.45));

/// Display colour of a part at a place, of cell \p Cell.
dvec3 colorOf(const Part &P, const Part::Point &At, uint64_t Cell, Draw &D) {
  dvec3 Albedo = P.Albedo;
  const dvec3 &X = At.Position;
  const auto Odd = [](double V) {
    return (static_cast<int64_t>(std::floor(V)) & 1) != 0;
  };
  switch (P.Surface) {
  case Texture::Plain:
    break;
  case Texture::Tiles:
    Albedo *= Odd(2.5 * X.x) != Odd(2.5 * (X.y + X.z)) ? 0.75 : 1.1;
    break;
  case Texture::Boards:
    Albedo *= Odd(9 * (X.x + X.y)) ? 0.7 : 1.05;
    break;
  case Texture::Ground:
    Albedo *= 0.65 + 0.7 * D.uniform();
    break;
  case Texture::Leaves:
    Albedo *= 0.4 + 1.1 * D.uniform();
    break;
  case Texture::Colors: {
    Draw Hue(Cell, 3);
    Albedo = dvec3{Hue.uniform(), Hue.uniform(), Hue.uniform()} * 0.7 + 0.08;
    break;
  }
  }
  const double Lit = std::max(0.0, glm::dot(At.Normal, Sun));
  const double Sky = 0.45 + 0.15 * At.Normal.y;
  return toDisplay(Albedo * (0.9 * Lit + Sky) * (0.94 + 0.12 * D.uniform()));
}

/// Gaussian \p I of \p S: a soft highlight where a view sees the sun mirrored.
void setColor(Scene &S, std::size_t I, const dvec3 &Color, const dvec3 &N) {
  // Of bands 1 to 3: those of a lobe.
  static constexpr std::array<double, 16> Band = {
      0,   1,    1,    1,    0.7,  0.7,  0.7,  0.7,
      0.7, 0.35, 0.35, 0.35, 0.35, 0.35, 0.35, 0.35};
  constexpr double Gloss = 0.05;
  const dvec3 View = 2 * glm::dot(N, -Sun) * N + Sun;
  const auto Y = shBasis(View);
  float *const To = &S.Sh[48 * I];
  for (std::size_t C = 0; C < 3; ++C)
    To[C] = static_cast<float>((Color[static_cast<int>(C)] - 0.5) / ShC0);
  for (std::size_t K = 1; K < 16; ++K)
    for (std::size_t C = 0; C < 3; ++C)
      To[3 * K + C] = static_cast<float>(Gloss * Band[K] * Y[K]);
}

/// Gaussian \p I of \p S, the \p K-th of \p Count in its cell.
void setGaussian(Scene &S, std::size_t I, const Cell &C, int64_t K,
                 double Count, const BenchmarkShape &Shape) {
  Draw D(C.Id, 16 + static_cast<uint64_t>(K));
  // Places by the additive recurrence of the plastic number: evenly spread,
  // but not in rows.
  const auto Fraction = [](double V) { return V - std::floor(V); };
  Draw Start(C.Id, 4);
  const double Index = static_cast<double>(K);
  const double U = Fraction(Start.uniform() + 0.7548776662466927 * Index),
               V = Fraction(Start.uniform() + 0.5698402909980532 * Index);
  Part::Point At = C.Of->at(C.S + U * C.Width, C.T + V * C.Height);
  const double Spacing = std::sqrt(C.Area / Count);
  if (C.Of->Shape == Part::Form::Crown) {
    // A leaf, turned anyhow, from the outside on inwards.
    const double In = D.uniform();
    At.Position =
        C.Of->Origin + (At.Position - C.Of->Origin) * (1 - 0.4 * In * In);
    At.Normal = glm::normalize(At.Normal +
                               0.8 * dvec3{D.normal(), D.normal(), D.normal()});
  } else
    At.Position += Shape.Depth * Spacing * D.normal() * At.Normal;

  double LogSize =
      portableLog(C.Size * Spacing) + Shape.SizeSpread * D.normal();
  const double Stretch = std::abs(Shape.Stretch * D.normal());
  if (D.uniform() < Shape.Large)
    LogSize += portableLog(Shape.LargeSize);
  const double Opacity =
      D.uniform() < C.Opaque
          ? 0.99
          : std::clamp(Shape.Most * portablePower(D.uniform(), C.Faint), 0.005,
                       0.99);
  constexpr double LogFlat = -2; // of the deviation across the surface
  const std::array<double, 3> LogScales = {LogSize, LogSize - Stretch,
                                           LogSize - 0.5 * Stretch + LogFlat};

  const dvec3 Helper =
      std::abs(At.Normal.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  const dvec3 A = glm::normalize(glm::cross(Helper, At.Normal)),
              B = glm::cross(At.Normal, A);
  const auto [Co, Si] = portableCosSin(D.uniform());
  const dvec3 Long = Co * A + Si * B;
  const glm::dquat Q =
      glm::quat_cast(glm::dmat3(Long, glm::cross(At.Normal, Long), At.Normal));
  const std::array<double, 4> Quat = {Q.w, Q.x, Q.y, Q.z};
  for (std::size_t J = 0; J < 3; ++J) {
    S.Means[3 * I + J] = static_cast<float>(At.Position[static_cast<int>(J)]);
    S.LogScales[3 * I + J] = static_cast<float>(LogScales[J]);
  }
  for (std::size_t J = 0; J < 4; ++J)
    S.Quats[4 * I + J] = static_cast<float>(Quat[J]);
  S.OpacityLogits[I] = static_cast<float>(portableLog(Opacity / (1 - Opacity)));
  setColor(S, I, colorOf(*C.Of, At, C.Id, D), At.Normal);
}

} // namespace

Scene makeBenchmark(BenchmarkKind K, const BenchmarkShape &Shape, int Gaussians,
                    unsigned Seed) {
  const std::vector<Part> Parts = benchmarkParts(K);
  const std::array<double, 3> Eye =
      benchmarkCameras(K, Shape.distances()).front().Position;
  std::vector<Cell> Cells;
  // Random numbers follow from a cell's identity, of which this is a part.
  constexpr std::size_t PartsASeed = 1000;
  for (std::size_t I = 0; I < Parts.size(); ++I)
    addCells(Cells, Parts[I], PartsASeed * Seed + I + 1, K,
             {Eye[0], Eye[1], Eye[2]}, Shape);
  double Whole = 0;
  for (const Cell &C : Cells)
    Whole += C.Weight;
  Scene S = Scene::sized(static_cast<std::size_t>(Gaussians), 3);
  double Before = 0;
  std::size_t Made = 0;
  for (const Cell &C : Cells) {
    const double Count = Gaussians * C.Weight / Whole;
    Before += C.Weight;
    // The last cell ends at the last Gaussian whatever rounding does.
    const std::size_t End =
        &C == &Cells.back()
            ? S.size()
            : std::min(S.size(),
                       static_cast<std::size_t>(Gaussians * (Before / Whole)));
    for (int64_t N = 0; Made < End; ++Made, ++N)
      setGaussian(S, Made, C, N, Count, Shape);
  }
  return S;
}

} // namespace vorion::splat::demo
