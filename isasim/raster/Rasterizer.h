/// The forward Gaussian rasterizer of a socket (paper, "Gaussian rasterizer
/// architecture"; docs/rasterizer.md).
#pragma once

#include "raster/RasterAgent.h"
#include "raster/RasterMemory.h"
#include "raster/WorkLog.h"

#include <memory>
#include <vector>

namespace vorion::raster {

struct Datapath;
struct TileBuffer;

/// Serves the Raster Agents of its socket round-robin, one tile command at a
/// time. Function only: a command's result depends on nothing but the command
/// and memory when it is executed.
///
/// Threads: one at a time; rasterizers of different sockets share nothing but
/// \c RasterMemory.
class Rasterizer {
public:
  /// Keeps references: \p Memory and \p Agents (in core order) must outlive it.
  Rasterizer(RasterMemory &Memory, std::vector<RasterAgent *> Agents);
  ~Rasterizer();

  /// Executes the next command; false if no agent has one.
  bool step();

  /// \p Receiver is told of every command's work; nullptr for nobody.
  void setLog(WorkLog *Receiver) { Log = Receiver; }

  /// Commands since the last call that the pixel unit has to go on with, in
  /// order.
  std::vector<HandOver> takeHandOvers();

  /// Executes commands until \p Agent accepts a start.
  void makeRoom(const RasterAgent &Agent);

  /// Executes commands until \p Agent has none that the pixel unit has not
  /// taken. Other agents' commands are
  /// executed when it is their turn.
  void finish(const RasterAgent &Agent);

private:
  RasterMemory &Memory;
  std::vector<RasterAgent *> Agents;
  std::size_t Next = 0; ///< agent whose turn it is
  std::vector<HandOver> HandOvers;
  std::unique_ptr<TileBuffer> Tile;
  const Datapath *Lanes;
  WorkLog *Log = nullptr;
};

} // namespace vorion::raster
