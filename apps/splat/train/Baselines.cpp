#include "train/Baselines.h"

#include "io/Metrics.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat {
namespace {

uint8_t rounded(double Value) {
  return static_cast<uint8_t>(std::clamp(std::lround(Value), 0L, 255L));
}

std::array<double, 3> meanColour(const std::vector<TrainView> &Views) {
  std::array<double, 3> Sum{};
  double Pixels = 0;
  for (const TrainView &V : Views) {
    // What does not count is 0.
    for (std::size_t I = 0; I < V.Picture.Rgb.size(); ++I)
      Sum[I % 3] += V.Picture.Rgb[I];
    Pixels += static_cast<double>(
        V.Counts.empty() ? V.Picture.pixels()
                         : static_cast<std::size_t>(
                               std::ranges::count(V.Counts, uint8_t{1})));
  }
  for (double &S : Sum)
    S /= Pixels;
  return Sum;
}

} // namespace

std::optional<Baselines> baselinesOf(const TrainingSet &Set) {
  if (Set.HeldOut.empty())
    return {};
  Baselines B;
  const std::array<double, 3> Colour = meanColour(Set.Training);
  for (const TrainView &V : Set.HeldOut) {
    const Photo &Target = V.Picture;
    Photo Constant = Target;
    for (std::size_t I = 0; I < Constant.Rgb.size(); ++I)
      Constant.Rgb[I] = rounded(Colour[I % 3]);
    std::vector<double> Sums(Target.Rgb.size(), 0);
    double Best = 0;
    for (const TrainView &T : Set.Training) {
      const Photo P = shrink(T.Picture, Target.Width, Target.Height);
      for (std::size_t I = 0; I < Sums.size(); ++I)
        Sums[I] += P.Rgb[I];
      Best = std::max(Best, psnrOfBytes(P.Rgb, Target.Rgb, V.Counts));
    }
    Photo Mean = Target;
    for (std::size_t I = 0; I < Sums.size(); ++I)
      Mean.Rgb[I] = rounded(Sums[I] / static_cast<double>(Set.Training.size()));
    const auto Views = static_cast<double>(Set.HeldOut.size());
    B.Constant += psnrOfBytes(Constant.Rgb, Target.Rgb, V.Counts) / Views;
    B.Mean += psnrOfBytes(Mean.Rgb, Target.Rgb, V.Counts) / Views;
    B.BestView += Best / Views;
  }
  return B;
}

} // namespace vorion::splat
