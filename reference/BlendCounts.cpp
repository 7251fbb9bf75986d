#include "BlendCounts.h"

#include "Walk.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace vorion::reference {

BlendCounts countBlends(const std::vector<Splat<float>> &Splats, int Width,
                        int Height, const Options &O) {
  BlendCounts Counts;
  const std::size_t Pixels =
      static_cast<std::size_t>(Width) * static_cast<std::size_t>(Height);
  Counts.Blends.resize(Pixels);
  Counts.Walked.resize(Pixels);
  const TileWalk<float> Walk(Splats, Width, Height, O);
  // Summed in the order of the tiles, whichever thread is first.
  std::vector<double> Sums(Walk.tiles());
  std::mutex Histogram;
  const double BinsALog = BlendCounts::Bins / std::log(255.0);
  forEachTile(Walk.tiles(), O.Threads, [&](std::size_t Tile) {
    const auto List = Walk.candidates(Tile);
    const Rect Area = Walk.pixels(Tile);
    std::array<uint64_t, BlendCounts::Bins> ByAlpha{};
    for (int Y = Area.Y0; Y < Area.Y1; ++Y)
      for (int X = Area.X0; X < Area.X1; ++X) {
        const auto At =
            static_cast<std::size_t>(Y) * static_cast<std::size_t>(Width) +
            static_cast<std::size_t>(X);
        uint32_t Blends = 0;
        const PixelEnd<float> End =
            Walk.pixel(List, X, Y, [&](const Contribution<float> &C) {
              ++Blends;
              Sums[Tile] += double{C.Alpha};
              const auto Bin = static_cast<std::size_t>(
                  -std::log(double{C.Alpha}) * BinsALog);
              ++ByAlpha[std::min(Bin, BlendCounts::Bins - 1)];
            });
        Counts.Blends[At] = Blends;
        Counts.Walked[At] = static_cast<uint32_t>(End.Walked);
      }
    const std::scoped_lock Lock(Histogram);
    for (std::size_t Bin = 0; Bin < ByAlpha.size(); ++Bin)
      Counts.ByAlpha[Bin] += ByAlpha[Bin];
  });
  for (const double Sum : Sums)
    Counts.AlphaSum += Sum;
  return Counts;
}

} // namespace vorion::reference
