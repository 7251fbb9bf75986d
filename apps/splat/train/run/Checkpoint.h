/// The state of a training run in a file.
#pragma once

#include "io/Bytes.h"
#include "train/optimize/Density.h"
#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// The complete state of a run. Arrays are planes in the layout of the device
/// (DeviceScene.h).
struct Checkpoint {
  /// The parameters of the run, one line. A run can be continued only with the
  /// same parameters.
  std::string Run;
  unsigned Iteration = 0; ///< completed iterations
  int ShDegree = 0;
  std::vector<float> Geometry, Sh;
  std::vector<float> FirstGeometry, FirstSh, SecondGeometry, SecondSh;
  std::vector<uint32_t> Identities; ///< of Gaussians (DeviceScene.h)
  DensityNotes Notes;
  std::vector<float> Losses;    ///< of every iteration
  std::vector<float> Exposures; ///< Exposure.h; empty in most runs
  std::vector<float> Poses;     ///< Pose.h; empty in most runs

  std::size_t gaussians() const { return Notes.Views.size(); }
};

/// Writes a temporary file and renames it: an interrupted or failed write does
/// not change the old file. A value that is not finite is an Error
/// (GuestFailed), and does not change the old file either.
Expected<Success> writeCheckpoint(const std::string &Path, const Checkpoint &C);

/// Errors: other versions, truncated or corrupted files (by checksum), values
/// that are not finite. Memory use is bounded by a few times the file size.
Expected<Checkpoint> readCheckpoint(const std::string &Path);

/// The same for \p File, the content of \p Path.
Expected<Checkpoint> parseCheckpoint(const std::string &Path, Bytes File);

} // namespace vorion::splat
