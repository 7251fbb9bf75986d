/// The Raster Agent: a core's door to its socket's rasterizer (paper, "Overall
/// Architecture"; docs/rasterizer.md).
#pragma once

#include "raster/Command.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace vorion::raster {

/// The table entry of CSR \p Number, or nullptr if it is not a rasterizer CSR.
const CsrInfo *findCsr(unsigned Number);

/// Sizes of a Raster Agent. The paper gives none of them.
struct AgentConfig {
  unsigned Lanes = 16;
  unsigned QueueDepth = 4; ///< commands, the running one included
  unsigned Core = 0;       ///< whose agent it is
  unsigned BatchDepth = 2; ///< batches that wait for the core
};

/// What an agent that has no command under way keeps from one run to the next.
struct AgentState {
  BankWords Bank;
  std::vector<Gaussian> Staging; ///< one descriptor a lane
  std::vector<Gaussian> PushBuffer;
  bool PushOverflowed = false;
  std::vector<uint32_t> PixelIndex; ///< one a lane
  std::vector<Pixel> Drained;
  Batch Shown;        ///< by vr_grad_* and vr_item
  uint32_t Index = 0; ///< of vr_word and vr_item
  uint32_t FirstFailure = VR_OK;
  Counters Totals;
};

/// One core's bank of configuration CSRs, push buffer, command queue, sticky
/// status, drained tile and counters.
///
/// Threads: belongs to its core, except that a Rasterizer takes and completes
/// commands, and a PixelUnit the rest of some; the machine never lets both run
/// at once (docs/decisions.md, 10).
class RasterAgent : AgentState {
public:
  explicit RasterAgent(const AgentConfig &Config = {});

  /// nullptr while commands, or batches that nobody has taken, are under way.
  const AgentState *state() const;
  /// Goes on with \p State, which an agent of as many lanes had; false if it is
  /// none of those. Needs state().
  bool setState(AgentState State);

  /// Whether a write of vr_start would be accepted now. The core that writes it
  /// while this is false stalls until the rasterizer has taken a command.
  bool canStart() const { return Queue.size() < Config.QueueDepth; }

  /// Whether commands are queued or go on in the pixel unit. A read of vr_wait
  /// stalls until it is false.
  bool isBusy() const { return hasCommand() || Tails != 0; }

  /// Whether a read of vr_grad_next can be answered: a batch, or the end of a
  /// command that hands over, is there, or none is queued. Otherwise it stalls.
  bool canTakeBatch() const;

  /// What lane \p Lane reads from \p C. Reading vr_wait needs !isBusy() and
  /// clears the status, reading vr_grad_next needs canTakeBatch() and goes on
  /// to the next batch: a uniform CSR (CsrInfo) is read once for all lanes.
  uint32_t read(Csr C, unsigned Lane);

  /// Reads \p C for the lanes of \p Mask into \p LaneValues (indexed by lane);
  /// a uniform CSR once, whatever the number of lanes.
  void readLanes(Csr C, uint32_t Mask, std::span<uint32_t> LaneValues);

  /// Writes \p C by the lanes of \p Mask (at least one), \p LaneValues indexed
  /// by lane, according to the CSR's write rule. Writing vr_start needs
  /// canStart(). Read-only CSRs must have trapped before.
  void write(Csr C, std::span<const uint32_t> LaneValues, uint32_t Mask);

  const Counters &counters() const { return Totals; }
  unsigned core() const { return Config.Core; }

  /// \name The rasterizer's side
  /// @{

  /// Whether the rasterizer has something to do.
  bool hasCommand() const { return !Queue.empty(); }

  /// The oldest command; needs hasCommand().
  const Command &front() const { return Queue.front(); }

  /// Removes the oldest command, counts \p Work, and keeps \p Status if it is
  /// the first that is not VR_OK.
  void complete(uint32_t Status, const Counters &Work);

  /// Removes the oldest command and counts \p Work; it goes on in the pixel
  /// unit, and the agent is busy until that calls completeTail().
  void handOver(const Counters &Work);

  /// The pixel unit's part of a command has ended.
  void completeTail(uint32_t Status, const Counters &Work);

  /// Whether there is room for a batch; a rasterizer that has one
  /// halts until there is.
  bool hasRoom() const { return WaitingBatches < Config.BatchDepth; }
  /// Takes a batch, which needs hasRoom(), or one of Count 0, the end of a
  /// command that hands over.
  void offer(const Batch &Offered);

  /// Where a drained tile goes, row by row.
  std::vector<Pixel> &drainedTile() { return Drained; }
  /// @}

private:
  uint32_t readCounter(Csr C) const;
  uint32_t takeBatch();
  uint32_t itemWord(uint32_t Number, unsigned Lane) const;
  void writeScalar(Csr C, uint32_t Value);
  void push(uint32_t Mask);
  void start();
  void finish(uint32_t Status, const Counters &Work);

  AgentConfig Config;
  std::deque<Command> Queue;
  std::deque<Batch> Batches;   ///< and ends of commands
  unsigned WaitingBatches = 0; ///< of these, batches
  unsigned Tails = 0;          ///< commands that the pixel unit has
};

} // namespace vorion::raster
