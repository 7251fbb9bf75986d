/// The Gaussian rasterizer of a socket (paper, "Gaussian rasterizer
/// architecture"; docs/rasterizer.md).
#pragma once

#include "raster/BackwardRun.h"
#include "raster/RasterAgent.h"
#include "raster/RasterMemory.h"
#include "raster/TileRun.h"
#include "raster/WorkLog.h"

#include <memory>
#include <optional>
#include <vector>

namespace vorion::raster {

/// Serves the Raster Agents of its socket round-robin, one tile command at a
/// time. A backward command halts it while its agent has no room for a batch.
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

  /// Goes on with the command, or begins the next one: to the next batch of a
  /// backward one, of others by a stretch of the list. False if canStep() is.
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
  /// A backward command, and the batch that waits for room in its agent.
  struct Halted {
    template <typename... Rest>
    Halted(std::size_t Turn, Rest &&...Of)
        : Turn(Turn), Run(std::forward<Rest>(Of)...) {}
    std::size_t Turn;
    BackwardRun Run;
    std::optional<GradientBatch> Next; ///< none: the command's end waits
    /// Once all has been computed.
    uint32_t Status = VR_OK;
    Counters Counts;
  };
  void startBackward(std::size_t Turn);
  void nextBatch();
  void stepBackward();
  void stepBlending();

  RasterMemory &Memory;
  std::vector<RasterAgent *> Agents;
  std::size_t Next = 0; ///< agent whose turn it is
  std::vector<HandOver> HandOvers;
  std::unique_ptr<TileBuffer> Tile;
  const Datapath *Lanes;
  std::unique_ptr<BackwardBuffer> BackwardTile; ///< made when first needed
  const BackwardDatapath *BackwardLanes;
  std::optional<Halted> Backward;
  std::optional<Blended> Blending;
  WorkLog *Log = nullptr;
};

} // namespace vorion::raster
