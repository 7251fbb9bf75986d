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

/// Training pictures beside the held-out views of one size.
struct OfSize {
  std::vector<std::size_t> Views; ///< places of the held-out views
  std::vector<double> Best;       ///< PSNR of the most similar picture of each
  std::vector<uint8_t> Mean;      ///< of each byte over the training pictures
};

/// Resizes each training picture once.
void compare(const TrainingSet &Set, OfSize &S) {
  const Photo &Size = Set.HeldOut[S.Views.front()].Picture;
  S.Best.assign(S.Views.size(), 0);
  std::vector<uint64_t> Sums(Size.Rgb.size());
  Photo Resized;
  for (const TrainView &T : Set.Training) {
    const bool Fits =
        T.Picture.Width == Size.Width && T.Picture.Height == Size.Height;
    if (!Fits)
      Resized = shrink(T.Picture, Size.Width, Size.Height);
    const std::vector<uint8_t> &Rgb = Fits ? T.Picture.Rgb : Resized.Rgb;
    for (std::size_t I = 0; I < Sums.size(); ++I)
      Sums[I] += Rgb[I];
    for (std::size_t N = 0; N < S.Views.size(); ++N) {
      const TrainView &V = Set.HeldOut[S.Views[N]];
      S.Best[N] =
          std::max(S.Best[N], psnrOfBytes(Rgb, V.Picture.Rgb, V.Counts));
    }
  }
  S.Mean.resize(Sums.size());
  std::ranges::transform(Sums, S.Mean.begin(), [&](uint64_t Sum) {
    return rounded(static_cast<double>(Sum) /
                   static_cast<double>(Set.Training.size()));
  });
}

} // namespace

std::optional<Baselines> baselinesOf(const TrainingSet &Set) {
  if (Set.HeldOut.empty())
    return {};
  const std::array<double, 3> Colour = meanColour(Set.Training);
  std::map<std::pair<int, int>, OfSize> Sizes;
  for (std::size_t I = 0; I < Set.HeldOut.size(); ++I) {
    const Photo &P = Set.HeldOut[I].Picture;
    Sizes[{P.Width, P.Height}].Views.push_back(I);
  }
  std::vector<Baselines> OfView(Set.HeldOut.size());
  for (auto &[Size, S] : Sizes) {
    compare(Set, S);
    std::vector<uint8_t> Constant(S.Mean.size());
    for (std::size_t I = 0; I < Constant.size(); ++I)
      Constant[I] = rounded(Colour[I % 3]);
    for (std::size_t N = 0; N < S.Views.size(); ++N) {
      const TrainView &V = Set.HeldOut[S.Views[N]];
      OfView[S.Views[N]] = {psnrOfBytes(Constant, V.Picture.Rgb, V.Counts),
                            psnrOfBytes(S.Mean, V.Picture.Rgb, V.Counts),
                            S.Best[N]};
    }
  }
  Baselines B;
  const auto Views = static_cast<double>(Set.HeldOut.size());
  for (const Baselines &Of : OfView) {
    B.Constant += Of.Constant / Views;
    B.Mean += Of.Mean / Views;
    B.BestView += Of.BestView / Views;
  }
  return B;
}

} // namespace vorion::splat
