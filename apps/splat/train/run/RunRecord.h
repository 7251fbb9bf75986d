/// What a training run was asked to do, as checkpoints and reports have it.
#pragma once

#include "capture/Capture.h"
#include "render/Backward.h"
#include "train/optimize/DeviceRenderer.h"
#include "train/run/Trainer.h"

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vorion::splat {

/// How the pictures were made from the capture.
struct PictureSource {
  std::string Format; ///< of the capture
  int Downscale = 1;
};

/// Of all that the pictures and their poses say.
std::string hashPictures(const TrainingSet &Set);

/// Of the points that training starts from.
std::string hashPoints(const CapturePoints &Points);

/// JSON that differs where results would: pictures, poses and first
/// points (by hash), settings, seed, spherical harmonics, who renders. The
/// number of iterations is not part of it, so that a run can go on for longer.
nlohmann::ordered_json runRecord(const TrainRun &Run,
                                 const TrainingSet &Pictures,
                                 const PictureSource &Source, int ShDegree,
                                 Rules Convention, const Blender &By,
                                 const BackwardOptions &Backward);

/// An Error of usage that names the first thing in which \p Wanted differs from
/// what \p File was written for, the text \p Has, or nothing.
Expected<Success> checkSameRun(const std::string &File, const std::string &Has,
                               const nlohmann::ordered_json &Wanted);

} // namespace vorion::splat
