/// The optimizer step of the few parameters on the host.
#pragma once

#include "train/settings/Settings.h"

#include <cstddef>
#include <vector>

namespace vorion::splat {

/// Values and their moments, in the floats of checkpoints.
class HostAdam {
public:
  /// Resets the values to \p From and the moments to 0.
  void restart(std::vector<float> From);

  std::size_t size() const { return Values.size(); }
  float operator[](std::size_t I) const { return Values[I]; }
  const float *data() const { return Values.data(); }

  /// Step \p Iteration (from 1) by \p Gradient. Returns the new values in
  /// double precision, which \c set rounds to floats.
  std::vector<double> step(const TrainSettings &Settings,
                           const std::vector<double> &Gradient, double Rate,
                           unsigned Iteration);
  void set(std::size_t I, double Value) {
    Values[I] = static_cast<float>(Value);
  }

  /// Values, then both moments.
  std::vector<float> save() const;
  /// Restores the result of \c save; no effect if the size differs.
  void restore(const std::vector<float> &State);

private:
  std::vector<float> Values, First, Second;
};

} // namespace vorion::splat
