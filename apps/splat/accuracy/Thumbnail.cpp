#include "accuracy/Thumbnail.h"

#include "page/Page.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vorion::splat {

namespace {

/// Blocks of a picture's pixels, one a pixel of the thumbnail.
struct Blocks {
  std::size_t Width, Height, OfWidth, OfHeight;

  Blocks(const ExactImage &I, unsigned Wanted)
      : Width(std::min(static_cast<std::size_t>(I.Width),
                       static_cast<std::size_t>(Wanted))),
        Height(std::max<std::size_t>(1, Width *
                                            static_cast<std::size_t>(I.Height) /
                                            static_cast<std::size_t>(I.Width))),
        OfWidth(static_cast<std::size_t>(I.Width)),
        OfHeight(static_cast<std::size_t>(I.Height)) {}

  /// Calls Use(block, first place among a picture's values) for each pixel.
  template <typename Function> void forPixels(Function Use) const {
    for (std::size_t Y = 0; Y < OfHeight; ++Y)
      for (std::size_t X = 0; X < OfWidth; ++X)
        Use(std::min(Y * Height / OfHeight, Height - 1) * Width +
                X * Width / OfWidth,
            3 * (Y * OfWidth + X));
  }
};

Expected<std::string> dataUri(const Blocks &B, std::vector<float> Render) {
  const Image I{static_cast<int>(B.Width),
                static_cast<int>(B.Height),
                std::move(Render),
                {}};
  const auto Png = encodePng(I);
  if (!Png)
    return Png.error();
  return pngUri(*Png);
}

} // namespace

Expected<std::string> thumbnail(const ExactImage &I, unsigned Width) {
  const Blocks B(I, Width);
  std::vector<double> Sums(3 * B.Width * B.Height);
  std::vector<double> Counts(B.Width * B.Height);
  B.forPixels([&](std::size_t Block, std::size_t At) {
    ++Counts[Block];
    for (std::size_t C = 0; C < 3; ++C)
      Sums[3 * Block + C] += std::clamp(I.Render[At + C], 0.0, 1.0);
  });
  std::vector<float> Render(Sums.size());
  for (std::size_t K = 0; K < Sums.size(); ++K)
    Render[K] = static_cast<float>(Sums[K] / Counts[K / 3]);
  return dataUri(B, std::move(Render));
}

Expected<std::string> differenceThumbnail(const ExactImage &A,
                                          const ExactImage &B, unsigned Width) {
  constexpr double Least = 1e-5;
  const Blocks Shape(A, Width);
  std::vector<double> Largest(Shape.Width * Shape.Height);
  Shape.forPixels([&](std::size_t Block, std::size_t At) {
    for (std::size_t C = 0; C < 3; ++C)
      Largest[Block] = std::max(Largest[Block],
                                std::abs(A.Render[At + C] - B.Render[At + C]));
  });
  std::vector<float> Render;
  for (const double D : Largest) {
    const double Bright = 1 - std::log(std::max(D, Least)) / std::log(Least);
    const auto Value = static_cast<float>(std::min(Bright, 1.0));
    const float Others = D > 1.0 / 255 ? Value / 4 : Value;
    Render.insert(Render.end(), {Value, Others, Others});
  }
  return dataUri(Shape, std::move(Render));
}

} // namespace vorion::splat
