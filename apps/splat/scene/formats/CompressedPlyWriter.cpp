#include "scene/formats/Ply.h"
#include "scene/formats/Quantize.h"
#include "scene/formats/Writers.h"

#include <fmt/format.h>
#include <numbers>

namespace vorion::splat {
namespace {

constexpr std::size_t ChunkSize = 256;

/// A kind of value that has bounds, and how each of its axes is named there.
struct Kind {
  std::array<const char *, 3> Axes;
  double (*At)(const Scene &S, std::size_t Gaussian, std::size_t Axis);
};

constexpr Kind Kinds[] = {
    {{"x", "y", "z"},
     [](const Scene &S, std::size_t I, std::size_t A) -> double {
       return S.roundedMean(3 * I + A);
     }},
    {{"scale_x", "scale_y", "scale_z"},
     [](const Scene &S, std::size_t I, std::size_t A) -> double {
       return S.LogScales[3 * I + A];
     }},
    {{"r", "g", "b"}, [](const Scene &S, std::size_t I, std::size_t A) {
       return 0.5 + ShC0 * S.Sh[3 * S.coefficients() * I + A];
     }}};
constexpr std::size_t Position = 0, Size = 1, Color = 2;

using Bounds = std::array<std::array<Range, 3>, std::size(Kinds)>;

/// Of the Gaussians from \p First to before \p End, as the file has them: a
/// reader knows no others.
Bounds boundsOf(const Scene &S, std::size_t First, std::size_t End,
                bool ColorBounds) {
  Bounds Result;
  for (std::size_t K = 0; K < std::size(Kinds); ++K)
    for (std::size_t A = 0; A < 3; ++A) {
      std::vector<double> Values;
      for (std::size_t I = First; I < End; ++I)
        Values.push_back(Kinds[K].At(S, I, A));
      const Range R = rangeOf(Values);
      Result[K][A] = K == Color && !ColorBounds
                         ? Range{0, 1}
                         : Range{float(R.Low), float(R.High)};
    }
  return Result;
}

std::string headerOf(const Scene &S, const Drawing &D, std::size_t KindsBound) {
  std::string Out =
      fmt::format("ply\nformat binary_little_endian 1.0\n{}element chunk {}\n",
                  drawingComments(D), (S.size() + ChunkSize - 1) / ChunkSize);
  for (std::size_t K = 0; K < KindsBound; ++K)
    for (const char *End : {"min", "max"})
      for (const char *Axis : Kinds[K].Axes)
        Out += fmt::format("property float {}_{}\n", End, Axis);
  Out += fmt::format("element vertex {}\n", S.size());
  for (const char *Word : {"position", "rotation", "scale", "color"})
    Out += fmt::format("property uint packed_{}\n", Word);
  if (S.ShDegree > 0) {
    Out += fmt::format("element sh {}\n", S.size());
    for (std::size_t K = 0; K < 3 * (S.coefficients() - 1); ++K)
      Out += fmt::format("property uchar f_rest_{}\n", K);
  }
  return Out + "end_header\n";
}

/// Two bits for the component that is missing, then 10 for each other one.
uint32_t packQuat(const UnitQuat &Q) {
  constexpr double End = std::numbers::sqrt2 / 2;
  auto Word = static_cast<uint32_t>(Q.Largest);
  for (const double V : Q.others())
    Word = Word << 10 | stepOf(V, {-End, End}, 10);
  return Word;
}

void putVertex(std::string &Out, const Scene &S, std::size_t I,
               const Bounds &B) {
  const auto Step = [&](std::size_t K, std::size_t A, int Bits) {
    return stepOf(Kinds[K].At(S, I, A), B[K][A], Bits);
  };
  const auto Pack = [&](std::size_t K) {
    return Step(K, 0, 11) << 21 | Step(K, 1, 10) << 11 | Step(K, 2, 11);
  };
  put(Out, Pack(Position));
  put(Out, packQuat(UnitQuat(S, I, Wxyz)));
  put(Out, Pack(Size));
  put(Out, Step(Color, 0, 8) << 24 | Step(Color, 1, 8) << 16 |
               Step(Color, 2, 8) << 8 | stepOf(opacityOf(S, I), {0, 1}, 8));
}

} // namespace

std::string compressedPlyOf(const Scene &S, const Drawing &D,
                            bool ColorBounds) {
  const std::size_t KindsBound = ColorBounds ? std::size(Kinds) : Color;
  std::string Out = headerOf(S, D, KindsBound);
  std::string Vertices;
  for (std::size_t First = 0; First < S.size(); First += ChunkSize) {
    const std::size_t End = std::min(First + ChunkSize, S.size());
    const Bounds B = boundsOf(S, First, End, ColorBounds);
    for (std::size_t K = 0; K < KindsBound; ++K) {
      for (const Range &R : B[K])
        put(Out, static_cast<float>(R.Low));
      for (const Range &R : B[K])
        put(Out, static_cast<float>(R.High));
    }
    for (std::size_t I = First; I < End; ++I)
      putVertex(Vertices, S, I, B);
  }
  Out += Vertices;
  const std::size_t ShEach = 3 * S.coefficients();
  for (std::size_t I = 0; I < S.size(); ++I)
    for (std::size_t C = 0; C < 3; ++C)
      for (std::size_t K = 1; K < S.coefficients(); ++K)
        putByte(Out, (S.Sh[ShEach * I + 3 * K + C] / 8 + 0.5) * 256);
  return Out;
}

} // namespace vorion::splat
