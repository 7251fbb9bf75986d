#include "capture/Photo.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat {
namespace {

/// Which source pixels a result pixel covers along one axis: from \c First on,
/// with these shares of their length.
struct Cover {
  std::size_t First = 0;
  std::vector<double> Shares;
};

std::vector<Cover> coversOf(std::size_t From, std::size_t To) {
  std::vector<Cover> Covers(To);
  const double Step = static_cast<double>(From) / static_cast<double>(To);
  for (std::size_t I = 0; I < To; ++I) {
    const double Begin = static_cast<double>(I) * Step, End = Begin + Step;
    Cover &C = Covers[I];
    C.First = std::min(static_cast<std::size_t>(Begin), From - 1);
    const auto Last = std::min(
        From, std::max(C.First + 1, static_cast<std::size_t>(std::ceil(End))));
    for (std::size_t K = C.First; K < Last; ++K) {
      const auto Left = static_cast<double>(K);
      C.Shares.push_back(
          std::max(0.0, std::min(End, Left + 1) - std::max(Begin, Left)));
    }
  }
  return Covers;
}

/// \p At(pixel, channel) gives 0 to 255.
template <typename Function>
Photo averaged(std::size_t FromWidth, std::size_t FromHeight, int Width,
               int Height, Function At) {
  Photo Out;
  Out.Width = Width;
  Out.Height = Height;
  const auto Round = [](double Level) {
    return static_cast<uint8_t>(std::clamp(std::lround(Level), 0L, 255L));
  };
  if (FromWidth == static_cast<std::size_t>(Width) &&
      FromHeight == static_cast<std::size_t>(Height)) {
    Out.Rgb.resize(3 * FromWidth * FromHeight);
    for (std::size_t I = 0; I < Out.Rgb.size(); ++I)
      Out.Rgb[I] = Round(At(I / 3, I % 3));
    return Out;
  }
  const std::vector<Cover> Columns =
      coversOf(FromWidth, static_cast<std::size_t>(Width));
  const std::vector<Cover> Rows =
      coversOf(FromHeight, static_cast<std::size_t>(Height));
  Out.Rgb.reserve(3 * Columns.size() * Rows.size());
  for (const Cover &Row : Rows)
    for (const Cover &Column : Columns) {
      std::array<double, 3> Sum{};
      double Area = 0;
      for (std::size_t R = 0; R < Row.Shares.size(); ++R)
        for (std::size_t C = 0; C < Column.Shares.size(); ++C) {
          const double Share = Row.Shares[R] * Column.Shares[C];
          const std::size_t Pixel =
              (Row.First + R) * FromWidth + Column.First + C;
          for (std::size_t K = 0; K < 3; ++K)
            Sum[K] += Share * At(Pixel, K);
          Area += Share;
        }
      for (const double S : Sum)
        Out.Rgb.push_back(Round(S / Area));
    }
  return Out;
}

} // namespace

Photo shrink(const Plane &P, int Width, int Height,
             const std::array<float, 3> &Background) {
  return averaged(P.Width, P.Height, Width, Height,
                  [&](std::size_t Pixel, std::size_t Channel) {
                    const double Alpha = P.at(Pixel, 3) / 255.0;
                    return P.at(Pixel, Channel) * Alpha +
                           255.0 * Background[Channel] * (1 - Alpha);
                  });
}

Photo shrink(const Photo &P, int Width, int Height) {
  if (Width == P.Width && Height == P.Height)
    return P;
  return averaged(static_cast<std::size_t>(P.Width),
                  static_cast<std::size_t>(P.Height), Width, Height,
                  [&](std::size_t Pixel, std::size_t Channel) -> double {
                    return P.Rgb[3 * Pixel + Channel];
                  });
}

std::vector<uint8_t> shrinkAlpha(const Plane &P, int Width, int Height) {
  // The same in all channels.
  const Photo All =
      averaged(P.Width, P.Height, Width, Height,
               [&](std::size_t Pixel, std::size_t /*Channel*/) -> double {
                 return P.at(Pixel, 3);
               });
  std::vector<uint8_t> Alpha(All.pixels());
  for (std::size_t I = 0; I < Alpha.size(); ++I)
    Alpha[I] = All.Rgb[3 * I];
  return Alpha;
}

Camera stretched(const Camera &C, int Width, int Height) {
  Camera R = C;
  const double X = static_cast<double>(Width) / C.Width;
  const double Y = static_cast<double>(Height) / C.Height;
  R.Width = Width;
  R.Height = Height;
  R.Fx *= X;
  R.Cx *= X;
  R.Fy *= Y;
  R.Cy *= Y;
  return R;
}

int shrunkSide(int Side, int Factor) {
  return std::max(1, (Side + Factor / 2) / Factor);
}

} // namespace vorion::splat
