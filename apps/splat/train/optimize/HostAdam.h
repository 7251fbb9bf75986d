/// The optimiser's step of the few parameters that stay on the host.
#pragma once

#include "train/settings/Settings.h"

#include <cstddef>
#include <vector>

namespace vorion::splat {

/// Values and their moments, floats as a checkpoint has them.
class HostAdam {
public:
  /// Begins anew from \p From.
  void restart(std::vector<float> From);

  std::size_t size() const { return Values.size(); }
  float operator[](std::size_t I) const { return Values[I]; }
  const float *data() const { return Values.data(); }

  /// Step \p Iteration (from 1) by \p Gradient, in double: the new values, of
  /// which \c set makes floats.
  std::vector<double> step(const TrainSettings &Settings,
                           const std::vector<double> &Gradient, double Rate,
                           unsigned Iteration);
  void set(std::size_t I, double Value) {
    Values[I] = static_cast<float>(Value);
  }

  /// Values, then both moments.
  std::vector<float> save() const;
  /// What \c save gave; nothing happens if it was of another size.
  void restore(const std::vector<float> &State);

private:
  std::vector<float> Values, First, Second;
};

} // namespace vorion::splat
