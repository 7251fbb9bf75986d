#include "train/settings/Settings.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat {

namespace {

double falling(double First, double Last, double Part) {
  return std::exp(std::log(First) * (1 - Part) + std::log(Last) * Part);
}

double partOf(const TrainSettings &S, unsigned Iteration) {
  return std::min(1.0, static_cast<double>(Iteration) / S.PositionSteps);
}

} // namespace

double positionRate(const TrainSettings &S, unsigned Iteration) {
  return falling(S.PositionRate, S.LastPositionRate, partOf(S, Iteration));
}

double exposureRate(const TrainSettings &S, unsigned Iteration) {
  return falling(S.ExposureRate, S.LastExposureRate, partOf(S, Iteration));
}

double poseRate(const TrainSettings &S, unsigned Iteration) {
  return falling(S.PoseRate, S.LastPoseRate, partOf(S, Iteration));
}

int shrinkAt(const TrainSettings &S, unsigned Iteration) {
  if (S.SizeInterval == 0)
    return 1;
  const unsigned Step = (Iteration - 1) / S.SizeInterval;
  return Step == 0 ? 4 : Step == 1 ? 2 : 1;
}

int shDegreeAt(const TrainSettings &S, unsigned Iteration, int Most) {
  return static_cast<int>(
      std::min(static_cast<unsigned>(Most), Iteration / S.ShInterval));
}

bool notesAt(const TrainSettings &S, unsigned Iteration) {
  return S.Method == DensityMethod::Classic && Iteration < S.DensifyUntil;
}

bool densifiesAt(const TrainSettings &S, unsigned Iteration) {
  return Iteration < S.DensifyUntil && Iteration > S.DensifyAfter &&
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
