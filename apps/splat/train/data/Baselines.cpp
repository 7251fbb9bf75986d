#include "train/data/Baselines.h"

#include "io/Metrics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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

/// What each pixel of \p Width x \p Height is on average over the views.
std::vector<uint8_t> meanPicture(const std::vector<TrainView> &Views, int Width,
                                 int Height) {
  std::vector<uint64_t> Sums;
  for (const TrainView &V : Views) {
    const Photo P = shrink(V.Picture, Width, Height);
    Sums.resize(P.Rgb.size());
    for (std::size_t I = 0; I < Sums.size(); ++I)
      Sums[I] += P.Rgb[I];
  }
  std::vector<uint8_t> Mean(Sums.size());
  std::ranges::transform(Sums, Mean.begin(), [&](uint64_t Sum) {
    return rounded(static_cast<double>(Sum) /
                   static_cast<double>(Views.size()));
  });
  return Mean;
}

} // namespace

std::optional<Baselines> baselinesOf(const TrainingSet &Set) {
  if (Set.HeldOut.empty())
    return {};
  Baselines B;
  const std::array<double, 3> Colour = meanColour(Set.Training);
  std::map<std::pair<int, int>, std::vector<uint8_t>> Means; ///< by size
  for (const TrainView &V : Set.HeldOut) {
    const Photo &Target = V.Picture;
    Photo Constant = Target;
    for (std::size_t I = 0; I < Constant.Rgb.size(); ++I)
      Constant.Rgb[I] = rounded(Colour[I % 3]);
    double Best = 0;
    for (const TrainView &T : Set.Training)
      Best = std::max(
          Best, psnrOfBytes(shrink(T.Picture, Target.Width, Target.Height).Rgb,
                            Target.Rgb, V.Counts));
    std::vector<uint8_t> &Mean = Means[{Target.Width, Target.Height}];
    if (Mean.empty())
      Mean = meanPicture(Set.Training, Target.Width, Target.Height);
    const auto Views = static_cast<double>(Set.HeldOut.size());
    B.Constant += psnrOfBytes(Constant.Rgb, Target.Rgb, V.Counts) / Views;
    B.Mean += psnrOfBytes(Mean, Target.Rgb, V.Counts) / Views;
    B.BestView += Best / Views;
  }
  return B;
}

} // namespace vorion::splat
