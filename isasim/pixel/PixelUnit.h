/// The pixel unit of a cluster (paper, "Pixel unit"; docs/rasterizer.md).
#pragma once

#include "raster/RasterAgent.h"
#include "raster/RasterMemory.h"
#include "raster/WorkLog.h"

#include <deque>
#include <memory>
#include <span>

namespace vorion::raster {
struct Datapath;
struct TileBuffer;
} // namespace vorion::raster

namespace vorion::pixel {

/// Goes on with the lists that the rasterizers of its cluster hand over: each
/// live pixel examines the rest of the list until it is saturated. It has the
/// rasterizer's arithmetic and order, so a hand-over changes no pixel.
///
/// Function only. The machine's unit goes pixel by pixel; a pixel's result does
/// not depend on when the others get their Gaussians, so here a Gaussian is
/// blended into all live pixels at once, by the rasterizer's own datapath.
///
/// Threads: one at a time; units of different clusters share nothing but
/// RasterMemory.
class PixelUnit {
public:
  /// \p Memory must outlive it.
  explicit PixelUnit(raster::RasterMemory &Memory);
  ~PixelUnit();

  /// Queues \p Handed behind what is there.
  void accept(std::span<const raster::HandOver> Handed);

  /// \p Receiver is told of every hand-over; nullptr for nobody.
  void setLog(raster::WorkLog *Receiver) { Log = Receiver; }

  /// Executes the next hand-over; false if there is none.
  bool step();
  bool canStep() const { return !Queue.empty(); }
  /// Whether the log has room for what the next step() tells it.
  bool hasRoomInLog() const;

private:
  raster::RasterMemory &Memory;
  std::deque<raster::HandOver> Queue;
  std::unique_ptr<raster::TileBuffer> Tile;
  const raster::Datapath *Lanes;
  raster::WorkLog *Log = nullptr;
};

} // namespace vorion::pixel
