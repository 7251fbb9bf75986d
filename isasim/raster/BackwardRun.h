/// One backward command in the works, batch by batch.
#pragma once

#include "raster/Backward.h"
#include "raster/CommandInput.h"
#include "raster/RasterMemory.h"
#include "raster/WorkLog.h"

#include <optional>
#include <utility>

namespace vorion::raster {

class BackwardRun {
public:
  /// The oldest command of \p Agent. Keeps references to the others, which must
  /// outlive it. \p KeepDetails: the Gaussians too, for the log.
  BackwardRun(const RasterAgent &Agent, RasterMemory &Memory,
              BackwardBuffer &Tile, const BackwardDatapath &Unit,
              bool KeepDetails);

  /// The next batch, or nothing once there is no other or the command has
  /// failed.
  std::optional<GradientBatch> next();

  /// What has been done, once next() has given nothing.
  CommandWork takeWork() { return std::move(Work); }

private:
  void load();
  uint32_t through(uint32_t Entry, GradientSums &Sums);

  CommandWork Work;
  const Job &Task = Work.What;
  RasterMemory &Memory;
  BackwardBuffer &Tile;
  const BackwardDatapath &Unit;
  BackwardOptions Options;
  GaussianList List;
  uint32_t Left = 0; ///< entries in front of what has been handed over
  bool KeepsDetails;
};

} // namespace vorion::raster
