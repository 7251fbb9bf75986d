/// The state of a training run in a file.
#pragma once

#include "io/Bytes.h"
#include "train/optimize/Density.h"
#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// Everything that the rest of a run depends on. Arrays are planes as the
/// device has them (DeviceScene.h).
struct Checkpoint {
  /// What the run was asked to do, one line; a run goes on only if it is asked
  /// the same.
  std::string Run;
  unsigned Iteration = 0; ///< done
  int ShDegree = 0;
  std::vector<float> Geometry, Sh;
  std::vector<float> FirstGeometry, FirstSh, SecondGeometry, SecondSh;
  std::vector<uint32_t> Identities; ///< of Gaussians, DeviceScene.h
  DensityNotes Notes;
  std::vector<float> Losses;    ///< of every iteration
  std::vector<float> Exposures; ///< Exposure.h; of most runs none
  std::vector<float> Poses;     ///< Pose.h; the same

  std::size_t gaussians() const { return Notes.Views.size(); }
};

/// Writes aside and renames: an interrupted or failed write leaves the file
/// that was there. So does a run whose values are no finite numbers any more,
/// which is an Error (GuestFailed).
Expected<Success> writeCheckpoint(const std::string &Path, const Checkpoint &C);

/// Refused: other versions, files that are shorter, longer or otherwise than
/// they were written (a checksum tells), values that are no finite numbers.
/// Takes no more memory than a few times the file's size.
Expected<Checkpoint> readCheckpoint(const std::string &Path);

/// The same of \p File, the bytes of \p Path.
Expected<Checkpoint> parseCheckpoint(const std::string &Path, Bytes File);

} // namespace vorion::splat
