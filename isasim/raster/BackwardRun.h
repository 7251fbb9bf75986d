/// One backward command in the works, batch by batch.
#pragma once

#include "raster/Backward.h"
#include "raster/Command.h"
#include "raster/CommandInput.h"
#include "raster/RasterMemory.h"
#include "raster/WorkLog.h"

#include <optional>

namespace vorion::raster {

class BackwardRun {
public:
  /// Keeps references, which must outlive it. \p KeepWork: see takeWork().
  BackwardRun(const Command &C, RasterMemory &Memory, BackwardBuffer &Tile,
              const BackwardDatapath &Unit, bool KeepWork);

  /// The next batch, or nothing once there is no other or the command has
  /// failed.
  std::optional<GradientBatch> next();

  /// What has been found so far; final when next() gives nothing.
  std::uint32_t status() const { return Status; }
  const Counters &work() const { return Work; }
  /// The details of the work, where they are kept.
  CommandWork takeWork();

private:
  void load();
  std::uint32_t through(std::uint32_t Entry, GradientSums &Sums);

  const Command &C;
  RasterMemory &Memory;
  BackwardBuffer &Tile;
  const BackwardDatapath &Unit;
  BackwardOptions Options;
  std::uint32_t Status;
  GaussianList List;
  std::uint32_t Left = 0; ///< entries in front of what has been handed over
  Counters Work;
  bool Keeps;
  std::vector<GaussianWork> Kept;
};

} // namespace vorion::raster
