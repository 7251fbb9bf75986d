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
  /// outlive it. \p Log: who wants to know what is fetched; nullptr for nobody.
  BackwardRun(const RasterAgent &Agent, RasterMemory &Memory,
              BackwardBuffer &Tile, const BackwardDatapath &Unit,
              const WorkLog *Log);

  /// The next batch, or nothing if there is none or the command fails. Not
  /// once isDone().
  std::optional<GradientBatch> next();
  /// Whether there is no other batch.
  bool isDone() const { return Work.hasFailed() || Left == 0; }

  /// What is known of a command that is not done.
  const CommandWork &begun() const { return Work; }
  /// What next() has fetched.
  std::vector<GaussianWork> takeFetched() {
    return std::exchange(Work.Gaussians, {});
  }
  /// What has been done, once isDone().
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
  bool KeepsFetches;
};

} // namespace vorion::raster
