#include "view/Paint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorion::splat {

namespace {

constexpr std::array<float, 3> Nothing{0.25F, 0.25F, 0.25F};

void append(std::string &To, const std::array<float, 3> &Colour) {
  for (const float Channel : Colour)
    To += static_cast<char>(toByte(Channel));
  To += static_cast<char>(0xff);
}

} // namespace

Painted paintPicture(const Image &I) {
  Painted P;
  P.Rgba.reserve(4 * I.pixels());
  for (std::size_t At = 0; At != 3 * I.pixels(); At += 3)
    append(P.Rgba, {I.Render[At], I.Render[At + 1], I.Render[At + 2]});
  return P;
}

Painted paintDepth(const DepthMap &D) {
  // Less than this of a pixel is as good as nothing.
  constexpr float LeastAlpha = 1.0F / 255;
  Painted P{"", std::numeric_limits<double>::infinity(), 0, "scene units"};
  const auto At = [&D](std::size_t Pixel) {
    return double(D.Depth[Pixel]) / double(D.Alpha[Pixel]);
  };
  for (std::size_t Pixel = 0; Pixel != D.Depth.size(); ++Pixel)
    if (D.Alpha[Pixel] >= LeastAlpha) {
      P.Low = std::min(P.Low, At(Pixel));
      P.High = std::max(P.High, At(Pixel));
    }
  if (P.Low > P.High)
    P.Low = P.High = 0;
  P.Rgba.reserve(4 * D.Depth.size());
  for (std::size_t Pixel = 0; Pixel != D.Depth.size(); ++Pixel)
    append(P.Rgba, D.Alpha[Pixel] >= LeastAlpha
                       ? heatColour((At(Pixel) - P.Low) /
                                    std::max(P.High - P.Low, 1e-30))
                       : Nothing);
  return P;
}

Painted paintError(const Image &I, const std::vector<double> &Reference) {
  Painted P{"", 1e-8, 1, "of a channel's range", true};
  std::vector<double> Errors(I.pixels());
  for (std::size_t Value = 0; Value != Reference.size(); ++Value) {
    double &Error = Errors[Value / 3];
    Error = std::max(Error, std::abs(I.Render[Value] - Reference[Value]));
  }
  P.Rgba.reserve(4 * I.pixels());
  for (const double Error : Errors)
    append(P.Rgba,
           heatColour(1 - std::log(std::max(Error, P.Low)) / std::log(P.Low)));
  return P;
}

Painted paintHeat(const std::vector<TileWork> &Tiles, Heat H, int Width,
                  int Height) {
  constexpr std::array<std::string_view, Heats.size()> Units{
      "entries of a list", "fragments blended", "cycles",
      "% of saturated pixels"};
  // The page has a legend of its own.
  Image Map = drawHeat(Tiles, H, Width, Height);
  Map.Height = Height;
  Painted P = paintPicture(Map);
  P.High = scaleOf(Tiles, H);
  P.Unit = Units[static_cast<std::size_t>(H)];
  return P;
}

} // namespace vorion::splat
