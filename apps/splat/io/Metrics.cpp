#include "Metrics.h"

#include "Image.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace vorion::splat {
namespace {

constexpr double Infinity = std::numeric_limits<double>::infinity();

} // namespace

Difference compare(const std::vector<double> &A, const std::vector<double> &B,
                   std::size_t Channels,
                   const std::vector<std::uint8_t> &Skip) {
  assert(A.size() == B.size() && "pictures of different sizes");
  assert((Skip.empty() || Skip.size() * Channels == A.size()) &&
         "mask of another size");
  Difference D;
  double Squares = 0;
  bool Undefined = false;
  for (std::size_t P = 0; P < A.size() / Channels; ++P) {
    if (!Skip.empty() && Skip[P])
      continue;
    ++D.Pixels;
    for (std::size_t I = P * Channels; I < (P + 1) * Channels; ++I) {
      if (A[I] == B[I] || (std::isnan(A[I]) && std::isnan(B[I])))
        continue;
      const double Delta = A[I] - B[I];
      Undefined |= std::isnan(Delta);
      Squares += Delta * Delta;
      D.MaxAbs = std::fmax(D.MaxAbs, std::abs(Delta));
    }
  }
  if (Undefined)
    return {D.Pixels, -Infinity, Infinity};
  const double Samples = double(D.Pixels) * double(Channels);
  D.PsnrDb = Squares > 0 ? -10 * std::log10(Squares / Samples) : Infinity;
  return D;
}

double psnr8Bit(const std::vector<float> &A, const std::vector<float> &B) {
  assert(A.size() == B.size() && "pictures of different sizes");
  double Squares = 0;
  for (std::size_t I = 0; I < A.size(); ++I) {
    const double Delta = int(toByte(A[I])) - int(toByte(B[I]));
    Squares += Delta * Delta;
  }
  return Squares > 0
             ? 10 * std::log10(255.0 * 255.0 * double(A.size()) / Squares)
             : Infinity;
}

} // namespace vorion::splat
