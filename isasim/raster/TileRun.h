/// One command that blends, in the works, stretch by stretch.
#pragma once

#include "raster/BlockTests.h"
#include "raster/CommandInput.h"
#include "raster/Datapath.h"
#include "raster/PixelRanges.h"
#include "raster/RasterMemory.h"
#include "raster/WorkLog.h"

#include <optional>
#include <utility>

namespace vorion::raster {

class TileRun {
public:
  /// The oldest command of \p Agent. Keeps references to the others, which must
  /// outlive it. \p Log: who wants to know what is fetched; nullptr for nobody.
  TileRun(RasterAgent &Agent, RasterMemory &Memory, TileBuffer &Tile,
          const Datapath &Lanes, const WorkLog *Log);

  /// Goes on with the command's list for at most LongestStretch entries. True
  /// once the command has been executed; to be called until then.
  bool goOn();

  /// What is known of a command that is not done.
  const CommandWork &begun() const { return Work; }
  /// What goOn() has fetched.
  std::vector<GaussianWork> takeFetched() {
    return std::exchange(Work.Gaussians, {});
  }
  /// What has been done, once goOn() has said so.
  CommandWork takeWork() { return std::move(Work); }

private:
  void loadPixels();
  bool blend();
  bool blendPushed();
  template <typename Record> bool blendList();
  /// \p G has been checked. \p Address: of the record, 0 if it was pushed.
  template <typename Record>
  void blendOne(const Record &G, uint32_t Address, bool Intersects,
                const BlendOptions &Options);
  bool isTail(uint32_t Remaining) const;
  void copyRow(unsigned Row, std::byte *To) const;
  void writePixels() const;
  void writeTail() const;
  void writeCounts() const;
  void writeResult();

  RasterAgent &Agent;
  const Command &Current;
  CommandWork Work;
  const Job &Task = Work.What;
  RasterMemory &Memory;
  TileBuffer &Tile;
  const Datapath &Lanes;
  bool KeepsFetches;
  BlockTests Tests;
  std::optional<PixelRanges> Ranges; ///< of a command that is not refused
  uint32_t Done = 0;                 ///< entries of the list
};

} // namespace vorion::raster
