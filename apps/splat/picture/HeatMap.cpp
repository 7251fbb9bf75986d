#include "picture/HeatMap.h"

#include "device/ClockedMachine.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

using Colour = std::array<float, 3>;

/// From dark to bright, so that the order shows without colours too.
constexpr Colour Ramp[] = {{0.02F, 0.02F, 0.10F},
                           {0.28F, 0.07F, 0.43F},
                           {0.72F, 0.21F, 0.33F},
                           {0.97F, 0.55F, 0.16F},
                           {0.99F, 0.98F, 0.72F}};
constexpr Colour Nothing = {0.25F, 0.25F, 0.25F}; ///< where no tile was drawn

} // namespace

Colour heatColour(double Share) {
  constexpr std::size_t Steps = std::size(Ramp) - 1;
  const double At = std::clamp(Share, 0.0, 1.0) * Steps;
  const std::size_t Step = std::min(static_cast<std::size_t>(At), Steps - 1);
  const auto Rest = static_cast<float>(At - static_cast<double>(Step));
  Colour C{};
  for (std::size_t I = 0; I != C.size(); ++I)
    C[I] = std::lerp(Ramp[Step][I], Ramp[Step + 1][I], Rest);
  return C;
}

namespace {

/// Characters of 3 x 5 pixels, a row an octal digit from the top.
constexpr std::pair<char, unsigned> Glyphs[] = {
    {'0', 075557}, {'1', 026227}, {'2', 071747}, {'3', 071717},
    {'4', 055711}, {'5', 074717}, {'6', 074757}, {'7', 071111},
    {'8', 075757}, {'9', 075717}, {'%', 051245}};
constexpr int GlyphWidth = 3, GlyphHeight = 5, GlyphScale = 2;
constexpr int GlyphPitch = (GlyphWidth + 1) * GlyphScale;

void fill(Image &I, int X, int Y, int Width, int Height, const Colour &C) {
  for (int Row = std::max(Y, 0); Row < std::min(Y + Height, I.Height); ++Row)
    for (int Column = std::max(X, 0); Column < std::min(X + Width, I.Width);
         ++Column)
      std::ranges::copy(C, I.Render.begin() + 3 * (Row * I.Width + Column));
}

void write(Image &I, int X, int Y, std::string_view Text) {
  for (const char Each : Text) {
    const auto *Glyph =
        std::ranges::find(Glyphs, Each, &std::pair<char, unsigned>::first);
    for (int Bit = 0; Bit != GlyphWidth * GlyphHeight; ++Bit)
      if (Glyph->second >> (GlyphWidth * GlyphHeight - 1 - Bit) & 1)
        fill(I, X + Bit % GlyphWidth * GlyphScale,
             Y + Bit / GlyphWidth * GlyphScale, GlyphScale, GlyphScale,
             {1, 1, 1});
    X += GlyphPitch;
  }
}

/// 0, the colours, the scale's end.
void drawLegend(Image &I, int Top, const std::string &End) {
  constexpr int Margin = 7;
  const int First = Margin + GlyphPitch + Margin;
  const int Last =
      I.Width - 2 * Margin - GlyphPitch * static_cast<int>(End.size());
  for (int X = First; X < Last; ++X)
    fill(I, X, Top + Margin - 2, 1, LegendHeight - 2 * Margin + 4,
         heatColour(double(X - First) / std::max(Last - 1 - First, 1)));
  write(I, Margin, Top + Margin, "0");
  write(I, Last + Margin, Top + Margin, End);
}

} // namespace

std::string_view name(Heat H) {
  constexpr std::array<std::string_view, Heats.size()> Names{
      "list", "blends", "cycles", "saturation"};
  return Names[static_cast<std::size_t>(H)];
}

double valueOf(const TileWork &T, Heat H) {
  switch (H) {
  case Heat::List:
    return static_cast<double>(T.List);
  case Heat::Blends:
    return static_cast<double>(T.Blends);
  case Heat::Cycles:
    return static_cast<double>(T.Cycles);
  case Heat::Saturation:
    return T.Pixels ? 100.0 * static_cast<double>(T.Saturated) /
                          static_cast<double>(T.Pixels)
                    : 0.0;
  }
  return 0;
}

double scaleOf(const std::vector<TileWork> &Tiles, Heat H) {
  if (H == Heat::Saturation)
    return 100;
  double Most = 0;
  for (const TileWork &T : Tiles)
    Most = std::max(Most, valueOf(T, H));
  return Most;
}

Image drawHeat(const std::vector<TileWork> &Tiles, Heat H, int Width,
               int Height) {
  Image I;
  I.Width = Width;
  I.Height = Height + LegendHeight;
  I.Render.resize(3 * I.pixels());
  fill(I, 0, 0, Width, Height, Nothing);
  const double Scale = scaleOf(Tiles, H);
  for (const TileWork &T : Tiles)
    fill(I, T.X, T.Y, T.Width, std::min(T.Height, Height - T.Y),
         heatColour(Scale > 0 ? valueOf(T, H) / Scale : 0));
  drawLegend(I, Height,
             fmt::format("{:.0f}{}", Scale, H == Heat::Saturation ? "%" : ""));
  return I;
}

Json heatJson(const DrawnTiles &Of) {
  Json Scales, All = Json::array();
  for (const Heat H : Heats)
    Scales[std::string(name(H))] = scaleOf(Of.Tiles, H);
  for (const TileWork &T : Of.Tiles)
    All.push_back({{"x", T.X},
                   {"y", T.Y},
                   {"width", T.Width},
                   {"height", T.Height},
                   {"list", T.List},
                   {"blends", T.Blends},
                   {"cycles", T.Cycles},
                   {"pixel_unit_cycles", T.PixelUnitCycles},
                   {"saturation", valueOf(T, Heat::Saturation)}});
  return {{ClockedMachineKey, Of.On}, {"scales", Scales}, {"tiles", All}};
}

} // namespace vorion::splat
