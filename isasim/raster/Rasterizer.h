/// The rasterizer of a socket (paper, "Gaussian rasterizer
/// architecture"; docs/rasterizer.md).
#pragma once

#include "raster/BackwardRun.h"
#include "raster/RasterAgent.h"
#include "raster/RasterMemory.h"
#include "raster/SurfaceRun.h"
#include "raster/TileRun.h"
#include "raster/WorkLog.h"

#include <memory>
#include <optional>
#include <vector>

namespace vorion::raster {

/// Serves the Raster Agents of its socket round-robin, one tile command at a
/// time. A command that hands batches over halts it while its agent has no room
/// for one.
/// Function only: a command's result depends on nothing but the command and
/// memory when it is executed.
///
/// Threads: one at a time; rasterizers of different sockets share nothing but
/// \c RasterMemory.
class Rasterizer {
public:
  /// Keeps references: \p Memory and \p Agents (in core order) must outlive it.
  Rasterizer(RasterMemory &Memory, std::vector<RasterAgent *> Agents);
  ~Rasterizer();

  /// Goes on with the command, or begins the next one: to its next batch, or by
  /// a stretch of the list. False if canStep() is.
  bool step();
  /// Whether there is a command, and no agent has to take a batch first.
  bool canStep() const;
  /// Whether the log has room for what the next step() tells it.
  bool hasRoomInLog() const;

  /// \p Receiver is told of every command; nullptr for nobody.
  void setLog(WorkLog *Receiver) { Log = Receiver; }

  /// The agent, by its place, whose turn it is: all that is kept while there is
  /// no command.
  std::size_t turn() const { return Next; }
  /// False if there is no such agent.
  bool setTurn(std::size_t Turn) {
    Next = Turn < Agents.size() ? Turn : Next;
    return Next == Turn;
  }

  /// Commands since the last call that the pixel unit has to go on with, in
  /// order.
  std::vector<HandOver> takeHandOvers();

  /// Executes commands until \p Agent accepts a start, or an agent has to take
  /// a batch first.
  void makeRoom(const RasterAgent &Agent);

  /// Executes commands until \p Agent has none that the pixel unit has not
  /// taken, or an agent has to take a batch first. Other agents' commands are
  /// executed when it is their turn.
  void finish(const RasterAgent &Agent);

private:
  /// A command that blends, and its agent's place.
  struct Blended {
    template <typename... Rest>
    Blended(std::size_t Turn, Rest &&...Of)
        : Turn(Turn), Run(std::forward<Rest>(Of)...) {}
    std::size_t Turn;
    TileRun Run;
  };
  /// A command that may hand batches over, and the batch that waits for room in
  /// its agent.
  struct Halted {
    std::size_t Turn;
    std::unique_ptr<BatchRun> Run;
    std::optional<Batch> Next;
    bool IsComputed = false; ///< all has been, and the log knows
    /// Only then.
    uint32_t Status = VR_OK;
    Counters Counts;
  };
  std::unique_ptr<BatchRun> makeBatchRun(const RasterAgent &Agent);
  void compute();
  void stepHanding();
  void stepBlending();

  RasterMemory &Memory;
  std::vector<RasterAgent *> Agents;
  std::size_t Next = 0; ///< agent whose turn it is
  std::vector<HandOver> HandOvers;
  std::unique_ptr<TileBuffer> Tile;
  const Datapath *Lanes;
  std::unique_ptr<BackwardBuffer> BackwardTile; ///< made when first needed
  const BackwardDatapath *BackwardLanes;
  std::unique_ptr<SurfaceBuffer> SurfaceTile; ///< likewise
  std::optional<Halted> Handing;
  std::optional<Blended> Blending;
  WorkLog *Log = nullptr;
};

} // namespace vorion::raster
