/// Measurement of training with each reciprocal unit and summation order, over
/// seeds.
#pragma once

#include "accuracy/Setting.h"
#include "study/Study.h"

#include "device/DeviceOptions.h"

#include <array>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// The parameters of a training sweep.
struct TrainSweepPlan {
  std::string Capture, Folder;
  DeviceOptions Machine;
  std::vector<std::string> Exclude;
  bool AllowOutside = false; ///< of the capture's folder (CaptureOptions)
  int Downscale = 1;
  std::array<float, 3> Background{};
  unsigned MostGaussians = 0; ///< 0: the default of `splat train`
  unsigned Iterations = 500;
  unsigned Seeds = 3; ///< 0, 1, ...
  unsigned ScoreEvery = 25, TimeEvery = 25;
  bool Energy = false; ///< also measure the chip's joules
  Provenance From;     ///< common provenance of all points: provenanceOf()
};

/// A training run with a setting and a seed, or the gradients with a setting at
/// the end of the default's run with seed 0.
struct TrainPoint {
  Setting Chosen;
  std::optional<unsigned> Seed; ///< of the run; empty: gradients

  /// "gradients" or "seed0", ...
  std::string at() const;
  std::string name() const { return Chosen.name() + "@" + at(); }
};

/// All points of the single changes of trainKnobs().
std::vector<TrainPoint> trainPoints(const TrainSweepPlan &P);

/// The common provenance of the points of \p P, whose capture is \p C.
Expected<Provenance> provenanceOf(const TrainSweepPlan &P, const Capture &C);

/// \p Points as points of a study. \p P must outlive their measurement.
std::vector<StudyPoint>
studyPoints(const TrainSweepPlan &P, const std::vector<TrainPoint> &Points,
            const std::function<void(std::string_view)> &Log);

/// The stored measurements in \p P's folder; \p Log is called for each rejected
/// file.
PointStore storeOf(const TrainSweepPlan &P,
                   std::function<void(std::string_view)> Log);

/// All points, which must be measured, and a summary for each setting: gradient
/// error, area, cycles, PSNR, and machine-seconds to a PSNR that every run
/// reaches.
Expected<nlohmann::ordered_json> trainResults(const TrainSweepPlan &P,
                                              PointStore &Kept);

/// The summary as a Markdown table.
std::string trainTable(const nlohmann::ordered_json &Results);

} // namespace vorion::splat
