/// The parameters of a training run in checkpoints and reports.
#pragma once

#include "capture/Capture.h"
#include "render/Backward.h"
#include "train/optimize/DeviceRenderer.h"
#include "train/run/Trainer.h"

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vorion::splat {

/// The conversion of the capture to training pictures.
struct PictureSource {
  std::string Format; ///< of the capture
  int Downscale = 1;
};

/// The key of TrainRun::Origin in records, which have none if it is 0.
inline constexpr const char *OriginKey = "origin";
/// That origin in \p Run, the record of the checkpoint \p File.
Expected<WorldPoint> originOf(const std::string &File, const std::string &Run);

/// Hash of pictures and poses.
std::string hashPictures(const TrainingSet &Set);

/// Hash of the initial points of training.
std::string hashPoints(const CapturePoints &Points);

/// JSON of all parameters that affect results: pictures, poses and initial
/// points (by hash), settings, seed, spherical harmonics, renderer. It excludes
/// the number of iterations, so that a run can be extended.
nlohmann::ordered_json runRecord(const TrainRun &Run,
                                 const TrainingSet &Pictures,
                                 const PictureSource &Source, int ShDegree,
                                 Rules Convention, const Blender &By,
                                 const BackwardOptions &Backward);

/// A usage error that names the first difference between \p Wanted and \p Has,
/// the parameters in \p File; success if they are equal.
Expected<Success> checkSameRun(const std::string &File, const std::string &Has,
                               const nlohmann::ordered_json &Wanted);

} // namespace vorion::splat
