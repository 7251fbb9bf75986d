#include "train/Settings.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat {

double positionRate(const TrainSettings &S, unsigned Iteration) {
  const double Part =
      std::min(1.0, static_cast<double>(Iteration) / S.PositionSteps);
  return std::exp(std::log(S.PositionRate) * (1 - Part) +
                  std::log(S.LastPositionRate) * Part);
}

int shDegreeAt(const TrainSettings &S, unsigned Iteration, int Most) {
  return static_cast<int>(
      std::min(static_cast<unsigned>(Most), Iteration / S.ShInterval));
}

bool notesAt(const TrainSettings &S, unsigned Iteration) {
  return Iteration < S.DensifyUntil;
}

bool densifiesAt(const TrainSettings &S, unsigned Iteration) {
  return notesAt(S, Iteration) && Iteration > S.DensifyAfter &&
         Iteration % S.DensifyInterval == 0;
}

bool resetsAt(const TrainSettings &S, unsigned Iteration, bool White) {
  return notesAt(S, Iteration) && (Iteration % S.ResetInterval == 0 ||
                                   (White && Iteration == S.WhiteReset));
}

bool dropsLargeAt(const TrainSettings &S, unsigned Iteration) {
  return Iteration > S.ResetInterval;
}

} // namespace vorion::splat
