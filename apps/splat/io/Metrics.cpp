#include "io/Metrics.h"

#include "io/Image.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace vorion::splat {
namespace {

constexpr double Infinity = std::numeric_limits<double>::infinity();

using Plane = std::vector<double>;

constexpr std::size_t HalfWindow = SsimWindow / 2;

/// SSIM's window along one axis; sums to 1.
std::array<double, SsimWindow> windowWeights() {
  std::array<double, SsimWindow> W{};
  double Sum = 0;
  for (int I = 0; I < SsimWindow; ++I) {
    const double D = I - static_cast<int>(HalfWindow);
    Sum += W[static_cast<std::size_t>(I)] =
        std::exp(-D * D / (2 * SsimSigma * SsimSigma));
  }
  for (double &Weight : W)
    Weight /= Sum;
  return W;
}

/// \p In under the window along its \p Rows, or along its columns.
Plane blurAlong(const Plane &In, std::size_t Width, bool Rows) {
  static const std::array<double, SsimWindow> Weights = windowWeights();
  const auto W = static_cast<std::ptrdiff_t>(Width);
  const auto H = static_cast<std::ptrdiff_t>(In.size()) / W;
  Plane Out(In.size());
  for (std::ptrdiff_t Y = 0; Y < H; ++Y)
    for (std::ptrdiff_t X = 0; X < W; ++X) {
      double Sum = 0;
      for (std::ptrdiff_t K = 0; K < SsimWindow; ++K) {
        const std::ptrdiff_t D = K - static_cast<std::ptrdiff_t>(HalfWindow);
        const std::ptrdiff_t At = Rows ? X + D : Y + D;
        if (At >= 0 && At < (Rows ? W : H))
          Sum += Weights[static_cast<std::size_t>(K)] *
                 In[static_cast<std::size_t>(Rows ? Y * W + At : At * W + X)];
      }
      Out[static_cast<std::size_t>(Y * W + X)] = Sum;
    }
  return Out;
}

Plane blurred(const Plane &In, std::size_t Width) {
  return blurAlong(blurAlong(In, Width, true), Width, false);
}

Plane product(const Plane &A, const Plane &B) {
  Plane Out(A.size());
  for (std::size_t I = 0; I < A.size(); ++I)
    Out[I] = A[I] * B[I];
  return Out;
}

Plane channel(const std::vector<double> &Pixels, std::size_t Channels,
              std::size_t C) {
  Plane Out(Pixels.size() / Channels);
  for (std::size_t I = 0; I < Out.size(); ++I)
    Out[I] = Pixels[I * Channels + C];
  return Out;
}

/// What SSIM divides at a pixel: of its means, and of what varies around them.
struct Similarity {
  double Mean, OfMean, Structure, OfStructure;
};

/// Calls \p Take with each pixel's number and its Similarity.
template <typename Function>
void compareWindows(const Plane &X, const Plane &Y, std::size_t Width,
                    Function Take) {
  constexpr double C1 = 0.01 * 0.01, C2 = 0.03 * 0.03;
  const Plane MeanX = blurred(X, Width), MeanY = blurred(Y, Width);
  const Plane XX = blurred(product(X, X), Width);
  const Plane YY = blurred(product(Y, Y), Width);
  const Plane XY = blurred(product(X, Y), Width);
  for (std::size_t I = 0; I < X.size(); ++I) {
    const double Both = MeanX[I] * MeanY[I];
    const double Squares = MeanX[I] * MeanX[I] + MeanY[I] * MeanY[I];
    Take(I, Similarity{2 * Both + C1, Squares + C1, 2 * (XY[I] - Both) + C2,
                       XX[I] + YY[I] - Squares + C2});
  }
}

/// Half as large along each axis: the mean of 2x2 pixels.
Plane halved(const Plane &In, std::size_t Width) {
  const std::size_t Across = Width / 2, Down = In.size() / Width / 2;
  Plane Out(Across * Down);
  for (std::size_t Y = 0; Y < Down; ++Y)
    for (std::size_t X = 0; X < Across; ++X) {
      const std::size_t At = 2 * Y * Width + 2 * X;
      Out[Y * Across + X] =
          (In[At] + In[At + 1] + In[At + Width] + In[At + Width + 1]) / 4;
    }
  return Out;
}

/// Of one channel.
double msSsimOf(Plane X, Plane Y, std::size_t Width) {
  double Product = 1;
  for (std::size_t Scale = 0; Scale < MsSsimWeights.size(); ++Scale) {
    const bool IsLast = Scale + 1 == MsSsimWeights.size();
    const std::size_t Height = X.size() / Width;
    double Sum = 0, Windows = 0;
    compareWindows(X, Y, Width, [&](std::size_t I, const Similarity &S) {
      const std::size_t Column = I % Width, Row = I / Width;
      if (Column < HalfWindow || Column + HalfWindow >= Width ||
          Row < HalfWindow || Row + HalfWindow >= Height)
        return;
      Sum += S.Structure / S.OfStructure * (IsLast ? S.Mean / S.OfMean : 1);
      ++Windows;
    });
    Product *= std::pow(std::max(Sum / Windows, 0.0), MsSsimWeights[Scale]);
    X = halved(X, Width);
    Y = halved(Y, Width);
    Width /= 2;
  }
  return Product;
}

} // namespace

Difference compare(const std::vector<double> &A, const std::vector<double> &B,
                   std::size_t Channels, const std::vector<uint8_t> &Skip) {
  assert(A.size() == B.size() && "pictures of different sizes");
  assert((Skip.empty() || Skip.size() * Channels == A.size()) &&
         "mask of another size");
  Difference D;
  double Squares = 0;
  std::size_t Off = 0;
  for (std::size_t P = 0; P < A.size() / Channels; ++P) {
    if (!Skip.empty() && Skip[P])
      continue;
    ++D.Pixels;
    bool IsOff = false, Finite = true;
    for (std::size_t I = P * Channels; I < (P + 1) * Channels; ++I) {
      Finite &= std::isfinite(A[I]) && std::isfinite(B[I]);
      const double Delta = A[I] - B[I];
      IsOff |= !(std::abs(Delta) <= 1.0 / 255);
      Squares += Delta * Delta;
      D.MaxAbs = std::fmax(D.MaxAbs, std::abs(Delta));
    }
    Off += IsOff;
    D.NotFinite += !Finite;
  }
  if (D.Pixels != 0)
    D.OffShare = static_cast<double>(Off) / static_cast<double>(D.Pixels);
  if (D.NotFinite != 0) {
    D.PsnrDb = -Infinity;
    D.MaxAbs = Infinity;
    return D;
  }
  const double Samples = double(D.Pixels) * double(Channels);
  D.PsnrDb = Squares > 0 ? -10 * std::log10(Squares / Samples) : Infinity;
  return D;
}

double ssim(const std::vector<double> &A, const std::vector<double> &B,
            std::size_t Width, std::size_t Channels) {
  assert(A.size() == B.size() && A.size() % (Width * Channels) == 0 &&
         "pictures of different sizes");
  double Sum = 0;
  for (std::size_t C = 0; C < Channels; ++C)
    compareWindows(channel(A, Channels, C), channel(B, Channels, C), Width,
                   [&Sum](std::size_t, const Similarity &S) {
                     Sum += S.Mean * S.Structure / (S.OfMean * S.OfStructure);
                   });
  return A.empty() ? 1 : Sum / static_cast<double>(A.size());
}

std::optional<double> msSsim(const std::vector<double> &A,
                             const std::vector<double> &B, std::size_t Width,
                             std::size_t Channels) {
  assert(A.size() == B.size() && A.size() % (Width * Channels) == 0 &&
         "pictures of different sizes");
  if (std::min(Width, A.size() / (Width * Channels)) < MsSsimLeastSide)
    return {};
  double Sum = 0;
  for (std::size_t C = 0; C < Channels; ++C)
    Sum += msSsimOf(channel(A, Channels, C), channel(B, Channels, C), Width);
  return Sum / static_cast<double>(Channels);
}

double psnrOfBytes(const std::vector<uint8_t> &A,
                   const std::vector<uint8_t> &B) {
  assert(A.size() == B.size() && "pictures of different sizes");
  constexpr std::size_t Stretch = std::size_t{1} << 15; // a sum fits 32 bits
  uint64_t Squares = 0;
  for (std::size_t Done = 0; Done < A.size();) {
    const std::size_t End = std::min(A.size(), Done + Stretch);
    uint32_t Sum = 0;
    for (; Done < End; ++Done) {
      const int Delta = int{A[Done]} - int{B[Done]};
      Sum += static_cast<uint32_t>(Delta * Delta);
    }
    Squares += Sum;
  }
  return Squares > 0 ? 10 * std::log10(255.0 * 255.0 * double(A.size()) /
                                       static_cast<double>(Squares))
                     : Infinity;
}

double psnrOfBytes(const std::vector<uint8_t> &A, const std::vector<uint8_t> &B,
                   const std::vector<uint8_t> &Counts) {
  if (Counts.empty())
    return psnrOfBytes(A, B);
  std::vector<uint8_t> Left, Right;
  for (std::size_t I = 0; I < Counts.size(); ++I)
    if (Counts[I] != 0)
      for (std::size_t K = 0; K < 3; ++K) {
        Left.push_back(A[3 * I + K]);
        Right.push_back(B[3 * I + K]);
      }
  return psnrOfBytes(Left, Right);
}

double psnr8Bit(const std::vector<float> &A, const std::vector<float> &B) {
  const auto Rounded = [](const std::vector<float> &Values) {
    std::vector<uint8_t> Bytes(Values.size());
    std::ranges::transform(Values, Bytes.begin(), toByte);
    return Bytes;
  };
  return psnrOfBytes(Rounded(A), Rounded(B));
}

double relativeL2(std::span<const double> A, std::span<const double> B,
                  double Least) {
  assert(A.size() == B.size() && "gradients of different scenes");
  double Off = 0, Whole = 0;
  for (std::size_t I = 0; I < B.size(); ++I)
    if (!std::isnan(B[I])) {
      Off += (A[I] - B[I]) * (A[I] - B[I]);
      Whole += B[I] * B[I];
    }
  // Where all are 0, so must the others be.
  return std::sqrt(Off) / std::max({std::sqrt(Whole), Least, 1e-300});
}

} // namespace vorion::splat
