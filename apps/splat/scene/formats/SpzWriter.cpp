#include "scene/formats/Quantize.h"
#include "scene/formats/Writers.h"

#include <algorithm>
#include <cassert>
#include <numbers>

namespace vorion::splat {
namespace {

constexpr double LargestFixed = (1 << 23) - 1; // of 24 bits with a sign

double largestMean(const Scene &S) {
  double Largest = 0;
  for (std::size_t I = 0; I < S.Means.size(); ++I)
    Largest = std::max(Largest, std::abs(double(S.roundedMean(I))));
  return Largest;
}

/// As many as the format's own programs use, or fewer for a larger scene.
int fractionalBits(const Scene &S) {
  int Bits = 12;
  const double Largest = largestMean(S);
  while (Bits > 0 && std::round(std::ldexp(Largest, Bits)) > LargestFixed)
    --Bits;
  return Bits;
}

/// Two bits for which component is missing, then a sign and nine bits for each
/// of the others.
uint32_t packQuat(const UnitQuat &Q) {
  auto Word = static_cast<uint32_t>(Q.Largest);
  for (const double V : Q.others())
    Word = Word << 10 | (V < 0 ? 0x200U : 0U) |
           stepOf(std::abs(V), {0, std::numbers::sqrt2 / 2}, 9);
  return Word;
}

/// The format's programs keep 5 bits of degree 1 and 4 above, so that the rest
/// compresses; zero is in the middle of a step.
int harmonicByte(float Value, std::size_t Coefficient) {
  const int Step = Coefficient < shCoefficients(1) ? 8 : 16;
  const auto Fine = static_cast<int>(
      std::round(std::clamp(double(Value), -1.0, 1.0) * 128) + 128);
  return (Fine + Step / 2) / Step * Step;
}

} // namespace

bool fitsSpz(const Scene &S) {
  return std::round(largestMean(S)) <= LargestFixed;
}

std::string spzBodyOf(const Scene &S, int Version, const Drawing &D) {
  assert(fitsSpz(S) && (Version == 2 || Version == 3));
  std::string Out = "NGSP";
  put(Out, static_cast<uint32_t>(Version));
  put(Out, static_cast<uint32_t>(S.size()));
  const int Bits = fractionalBits(S);
  for (const int Byte : {S.ShDegree, Bits, D.Antialiased ? 1 : 0, 0})
    putByte(Out, Byte);
  for (std::size_t I = 0; I < S.Means.size(); ++I) {
    const auto Fixed =
        static_cast<int32_t>(std::lround(std::ldexp(S.roundedMean(I), Bits)));
    for (const int Shift : {0, 8, 16})
      Out += static_cast<char>(Fixed >> Shift & 0xFF);
  }
  for (std::size_t I = 0; I < S.size(); ++I)
    putByte(Out, std::round(255 * opacityOf(S, I)));
  const std::size_t ShEach = 3 * S.coefficients();
  for (std::size_t I = 0; I < S.size(); ++I)
    for (std::size_t C = 0; C < 3; ++C)
      putByte(Out, std::round(255 * (0.5 + 0.15 * S.Sh[ShEach * I + C])));
  for (const float V : S.LogScales)
    putByte(Out, std::round((V + 10) * 16));
  for (std::size_t I = 0; I < S.size(); ++I) {
    if (Version == 3) {
      put(Out, packQuat(UnitQuat(S, I, Xyzw)));
      continue;
    }
    const UnitQuat Q(S, I, Wxyz);
    for (std::size_t K = 1; K < 4; ++K)
      putByte(Out, std::round(127.5 + 127.5 * (Q.Q[0] < 0 ? -1 : 1) * Q.Q[K]));
  }
  for (std::size_t I = 0; I < S.size(); ++I)
    for (std::size_t K = 3; K < ShEach; ++K)
      putByte(Out, harmonicByte(S.Sh[ShEach * I + K], K / 3));
  return Out;
}

} // namespace vorion::splat
