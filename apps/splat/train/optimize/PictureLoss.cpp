#include "train/optimize/PictureLoss.h"

#include "kernels/loss.cl.h"
#include "kernels/mask.cl.h"
#include "render/Pipeline.h"

#include <algorithm>

namespace vorion::splat {
namespace {

// A group of kernels/loss.cl has a channel of a tile, of as many rows as local
// memory has room for.
constexpr uint32_t TileRows = 42, Channels = 3;
// Rows and columns of the window on each side of a pixel.
constexpr uint32_t Reach = 5;
constexpr uint64_t SlopePlanes = uint64_t{3} * Channels;

constexpr uint32_t divideUp(uint32_t A, uint32_t B) { return (A + B - 1) / B; }

} // namespace

ProgramSpec lossProgram(bool Divided) {
  return kernels::loss::Program{.TILE_ROWS = TileRows, .DIVIDED = Divided};
}

ProgramSpec maskProgram() { return kernels::mask::Program{}; }

void PictureLoss::reserve(uint64_t Pixels, uint64_t Tiles) {
  if (Pixels > Room) {
    Room = Pixels;
    Packed = Launch.allocate("photograph", 4 * Pixels);
    Gradient = Launch.allocate("picture's gradient", 12 * Pixels);
    NoAlpha = Launch.allocate("alpha's gradient", 4 * Pixels);
    const std::vector<float> Zeros(Pixels, 0);
    Launch.write("alpha's gradient", NoAlpha, Zeros.data(), 4 * Zeros.size());
  }
  if (Tiles > TileRoom) {
    TileRoom = Tiles;
    Slopes = Launch.allocate("loss's slopes",
                             4 * SlopePlanes * Tiles * Lanes * TileRows);
    Totals = Launch.allocate("loss's sums", 8 * Channels * Tiles);
  }
}

LossValues PictureLoss::evaluate(const cl::Buffer &Drawn, const Photo &Target,
                                 const std::vector<uint8_t> &Counts,
                                 TileDivision *Among) {
  if (const bool Divided = Among; Divided != BuiltDivided) {
    Launch.build(lossProgram(Divided));
    BuiltDivided = Divided;
  }
  const auto Width = static_cast<uint32_t>(Target.Width);
  const auto Height = static_cast<uint32_t>(Target.Height);
  const auto Pixels = static_cast<uint32_t>(Target.pixels());
  const uint32_t Across = divideUp(Width, Lanes);
  const uint32_t Down = divideUp(Height, TileRows);
  // The gradient is written for more rows than there are.
  reserve(uint64_t{Width} * Down * TileRows, uint64_t{Across} * Down);
  HostPacked.resize(Pixels);
  for (std::size_t I = 0; I < Pixels; ++I)
    HostPacked[I] = Target.Rgb[3 * I] | Target.Rgb[3 * I + 1] << 8 |
                    Target.Rgb[3 * I + 2] << 16;
  uint32_t Counted = Pixels;
  for (std::size_t I = 0; I < Counts.size(); ++I)
    if (Counts[I] != 0) {
      HostPacked[I] |= uint32_t{1} << 24;
    } else {
      HostPacked[I] = 0;
      --Counted;
    }
  Launch.write("photograph", Packed, HostPacked.data(), 4 * HostPacked.size());

  cl::Buffer Picture = Drawn;
  if (!Counts.empty()) {
    if (Pixels > MaskRoom) {
      MaskRoom = Pixels;
      Masked = Launch.allocate("masked picture", 16 * uint64_t{Pixels});
    }
    Picture = Masked;
    Launch.run(itemsFor(Pixels), GroupSize,
               kernels::mask::mask_picture{.picture = Drawn,
                                           .photo = Packed,
                                           .masked = Masked,
                                           .pixels = Pixels});
  }
  const double Samples = 3.0 * Counted;
  // The gradient of a row needs the slopes of all rows in its windows.
  TileDivision::PixelRows Own{0, Height}, Around = Own;
  if (Among) {
    Own = Among->ownRows();
    Around = {Own.First - std::min(Own.First, Reach),
              std::min(Own.End + Reach, Height)};
  }
  const auto RunTiles = [&](const TileDivision::PixelRows &Of, auto Kernel) {
    if (Own.First == Own.End)
      return;
    const uint32_t First = Of.First / TileRows;
    if (Among) {
      Kernel.first_row = First;
      Kernel.rows_of_tiles = Down;
    }
    Launch.run(cl::NDRange(std::size_t{Across} * Lanes,
                           divideUp(Of.End, TileRows) - First, Channels),
               cl::NDRange(Lanes, 1, 1), Kernel);
  };
  RunTiles(Around, kernels::loss::loss_slopes{.picture = Picture,
                                              .photo = Packed,
                                              .slopes = Slopes,
                                              .totals = Totals,
                                              .width = Width,
                                              .height = Height});
  RunTiles(Own, kernels::loss::loss_gradient{
                    .picture = Picture,
                    .photo = Packed,
                    .slopes = Slopes,
                    .gradient = Gradient,
                    .width = Width,
                    .height = Height,
                    .per_absolute = static_cast<float>((1 - DSsim) / Samples),
                    .per_ssim = static_cast<float>(DSsim / Samples)});
  if (!Counts.empty())
    Launch.run(itemsFor(Pixels), GroupSize,
               kernels::mask::mask_gradient{
                   .photo = Packed, .gradient = Gradient, .pixels = Pixels});

  HostTotals.assign(std::size_t{2} * Channels * Across * Down, 0);
  Launch.read("loss", HostTotals.data(), Totals, 4 * HostTotals.size());
  if (Among)
    Among->completeStrips(HostTotals, Channels, Down, TileRows);
  LossValues V;
  for (std::size_t I = 0; I < HostTotals.size(); I += 2) {
    V.Absolute += HostTotals[I];
    V.Ssim += HostTotals[I + 1];
  }
  V.Absolute /= Samples;
  // Where nothing counts all around, SSIM is 1 by definition.
  V.Ssim = (V.Ssim - (3.0 * Pixels - Samples)) / Samples;
  V.Value = (1 - DSsim) * V.Absolute + DSsim * (1 - V.Ssim);
  return V;
}

} // namespace vorion::splat
