/// Measuring training: each reciprocal unit and order of sums, over seeds.
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

/// What is trained, how often, and where measurements are kept.
struct TrainSweepPlan {
  std::string Capture, Folder;
  DeviceOptions Machine;
  std::vector<std::string> Exclude;
  bool AllowOutside = false; ///< of the capture's folder (CaptureOptions)
  int Downscale = 1;
  std::array<float, 3> Background{};
  unsigned MostGaussians = 0; ///< 0: as `splat train` has it
  unsigned Iterations = 500;
  unsigned Seeds = 3; ///< 0, 1, ...
  unsigned ScoreEvery = 25, TimeEvery = 25;
  bool Energy = false; ///< the chip's joules, too
  Provenance From;     ///< what all points are made from: provenanceOf()
};

/// A training run with a setting and a seed, or what a setting makes of the
/// gradients at the end of the default's run with seed 0.
struct TrainPoint {
  Setting Chosen;
  std::optional<unsigned> Seed; ///< of the run; nothing: the gradients

  /// "gradients" or "seed0", ...
  std::string at() const;
  std::string name() const { return Chosen.name() + "@" + at(); }
};

/// All points of the settings of trainKnobs(), one knob at a time.
std::vector<TrainPoint> trainPoints(const TrainSweepPlan &P);

/// What all points of \p P, whose capture is \p C, are made from.
Expected<Provenance> provenanceOf(const TrainSweepPlan &P, const Capture &C);

/// \p Points as points of a study. They read \p P while they are measured.
std::vector<StudyPoint>
studyPoints(const TrainSweepPlan &P, const std::vector<TrainPoint> &Points,
            const std::function<void(std::string_view)> &Log);

/// The measurements that \p P's folder has; \p Log is told of each file that
/// is not used.
PointStore storeOf(const TrainSweepPlan &P,
                   std::function<void(std::string_view)> Log);

/// All points, which are measured, and what they say together: of each setting
/// gradient error, area, cycles, PSNR, and machine-seconds until a PSNR that
/// every run reaches.
Expected<nlohmann::ordered_json> trainResults(const TrainSweepPlan &P,
                                              PointStore &Kept);

/// These as a Markdown table.
std::string trainTable(const nlohmann::ordered_json &Results);

} // namespace vorion::splat
