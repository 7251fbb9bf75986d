/// A rasterizer's command as far as the clock knows it: its Gaussians may come
/// in parts, while the first are timed.
#pragma once

#include "raster/WorkLog.h"

#include <cassert>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace vorion::isasim {

class RasterWork {
public:
  RasterWork() = default;
  /// Nothing is known but Core, What and Entries.
  explicit RasterWork(const raster::CommandWork &Begun) {
    Of.Core = Begun.Core;
    Of.What = Begun.What;
    Of.Entries = Begun.Entries;
  }

  /// The rest is known. Of \p Done, but its Gaussians.
  void complete(raster::CommandWork &&Done) {
    add(std::exchange(Done.Gaussians, {}));
    Of = std::move(Done);
    Complete = true;
  }
  /// The next Gaussians, in the order of the fetches.
  void add(std::vector<raster::GaussianWork> &&More) {
    if (More.empty())
      return;
    const size_t First = known();
    Parts.push_back({First, std::move(More)});
  }
  /// Gaussians before \p Number are not asked for again. Returns how many are
  /// forgotten.
  size_t drop(size_t Number) {
    const size_t Before = Dropped;
    while (!Parts.empty() && Parts.front().end() <= Number) {
      Dropped = Parts.front().end();
      Parts.pop_front();
    }
    return Dropped - Before;
  }

  const raster::CommandWork &command() const { return Of; }
  /// Whether all is known: command() as well.
  bool isComplete() const { return Complete; }
  /// Gaussians that are.
  size_t known() const { return Parts.empty() ? Dropped : Parts.back().end(); }
  /// One that has not been dropped.
  const raster::GaussianWork &operator[](size_t Number) const {
    assert(Number < known());
    auto Part = Parts.begin();
    while (Part->end() <= Number)
      ++Part;
    return Part->Gaussians[Number - Part->First];
  }
  /// The command, which is not asked for again.
  raster::CommandWork take() { return std::move(Of); }

private:
  struct Part {
    size_t First;
    std::vector<raster::GaussianWork> Gaussians;
    size_t end() const { return First + Gaussians.size(); }
  };
  raster::CommandWork Of;
  std::deque<Part> Parts;
  size_t Dropped = 0;
  bool Complete = false;
};

} // namespace vorion::isasim
