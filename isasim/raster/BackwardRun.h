/// One backward command in the works, batch by batch.
#pragma once

#include "raster/Backward.h"
#include "raster/BatchRun.h"
#include "raster/CommandInput.h"
#include "raster/RasterMemory.h"
#include "raster/WorkLog.h"

namespace vorion::raster {

class BackwardRun : public BatchRun {
public:
  /// The oldest command of \p Agent. Keeps references to the others, which must
  /// outlive it. \p Log: who wants to know what is fetched; nullptr for nobody.
  BackwardRun(const RasterAgent &Agent, RasterMemory &Memory,
              BackwardBuffer &Tile, const BackwardDatapath &Unit,
              const WorkLog *Log);

  std::optional<Batch> next() override;
  bool isDone() const override { return Work.hasFailed() || Left == 0; }

private:
  void load();
  template <typename Record>
  uint32_t through(uint32_t Entry, GradientSums &Sums);

  RasterMemory &Memory;
  BackwardBuffer &Tile;
  const BackwardDatapath &Unit;
  BackwardOptions Options;
  uint32_t Left = 0; ///< entries in front of what has been handed over
  bool KeepsFetches;
};

} // namespace vorion::raster
