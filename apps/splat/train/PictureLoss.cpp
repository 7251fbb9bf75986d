#include "PictureLoss.h"

#include "../render/Pipeline.h"

namespace vorion::splat {
namespace {

// As kernels/loss.cl has them: planes of three channels.
constexpr std::uint64_t MomentPlanes = 3 * 5, SlopePlanes = 3 * 3;

} // namespace

ProgramSpec lossProgram() { return {LossProgram, {"loss.cl"}, {}}; }

void PictureLoss::reserve(std::uint64_t Pixels, std::uint32_t Rows) {
  if (Pixels > Room) {
    Room = Pixels;
    Packed = L.allocate("photograph", 4 * Pixels);
    Moments = L.allocate("loss's sums", 4 * MomentPlanes * Pixels);
    Slopes = L.allocate("loss's slopes", 4 * SlopePlanes * Pixels);
    Terms = L.allocate("loss's terms", 8 * Pixels);
    Gradient = L.allocate("picture's gradient", 12 * Pixels);
    NoAlpha = L.allocate("alpha's gradient", 4 * Pixels);
    const std::vector<float> Zeros(Pixels, 0);
    L.write("alpha's gradient", NoAlpha, Zeros.data(), 4 * Zeros.size());
  }
  if (Rows > RowRoom) {
    RowRoom = Rows;
    RowSums = L.allocate("loss's rows", 8 * std::uint64_t{Rows});
  }
}

LossValues PictureLoss::evaluate(const cl::Buffer &Picture,
                                 const Photo &Target) {
  const auto Width = static_cast<std::uint32_t>(Target.Width);
  const auto Height = static_cast<std::uint32_t>(Target.Height);
  const auto Pixels = static_cast<std::uint32_t>(Target.pixels());
  reserve(Pixels, Height);
  HostPacked.resize(Pixels);
  for (std::size_t I = 0; I < Pixels; ++I)
    HostPacked[I] = Target.Rgb[3 * I] | Target.Rgb[3 * I + 1] << 8 |
                    Target.Rgb[3 * I + 2] << 16;
  L.write("photograph", Packed, HostPacked.data(), 4 * HostPacked.size());

  const double Samples = 3.0 * Pixels;
  const cl::NDRange Items = itemsFor(Pixels);
  L.run(LossProgram, "loss_rows", Items, GroupSize, Picture, Packed, Moments,
        Width, Height);
  L.run(LossProgram, "loss_columns", Items, GroupSize, Picture, Packed, Moments,
        Slopes, Terms, Width, Height);
  // The sums are done with; their buffer takes the slopes' window along rows.
  L.run(LossProgram, "loss_spread", Items, GroupSize, Slopes, Moments, Width,
        Height);
  L.run(LossProgram, "loss_gradient", Items, GroupSize, Picture, Packed,
        Moments, Gradient, Width, Height,
        static_cast<float>((1 - DSsim) / Samples),
        static_cast<float>(DSsim / Samples));
  L.run(LossProgram, "loss_sum", itemsFor(Height), GroupSize, Terms, RowSums,
        Width, Height);

  HostRows.assign(2 * std::size_t{Height}, 0);
  L.read("loss", HostRows.data(), RowSums, 4 * HostRows.size());
  LossValues V;
  for (std::size_t Row = 0; Row < Height; ++Row) {
    V.Absolute += HostRows[2 * Row];
    V.Ssim += HostRows[2 * Row + 1];
  }
  V.Absolute /= Samples;
  V.Ssim /= Samples;
  V.Value = (1 - DSsim) * V.Absolute + DSsim * (1 - V.Ssim);
  return V;
}

} // namespace vorion::splat
