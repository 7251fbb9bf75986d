/// The trace that a core records for the clock while it executes
/// (docs/adr/0007-the-clock.md), and the functions that append to it. Compiled
/// into every vector level.
#pragma once

#include "core/State.h"

#include <cstdint>

namespace vorion::isasim {

/// Instructions that ran one after the other under one mask. A vx_bar among
/// them has two words, barrier and how many arrive, a vx_wspawn one, the warps
/// that it started as bits.
struct RunRecord {
  uint32_t First; ///< number of the first, from the program's beginning
  /// How many; 0: the instruction First alone, which had parked. It has an
  /// event record instead of an access record.
  uint16_t Count;
  uint16_t Mask;
};

/// Where an access went.
enum class Space : uint8_t { Memory, Local };

/// The first word of an access record. Behind it come the addresses of
/// \c Lines cache lines.
struct AccessWord {
  uint32_t Lines : 5; ///< distinct ones, 0 for local memory
  uint32_t Where : 1; ///< a Space
  uint32_t Whole : 1; ///< a store that covers all bytes of its lines
  /// Memory: lanes of an atomic at the same word. Local: the most distinct
  /// words that any bank has to give.
  uint32_t Conflicts : 5;
  uint32_t Unused : 20;
};
static_assert(sizeof(AccessWord) == 4);

/// The first word of an event record, by kind.
enum class Event : uint32_t {
  Atomic,       ///< an access record follows
  Barrier,      ///< of the device; two words: barrier, how many arrive
  LocalBarrier, ///< of the core; the same
  Spawn,        ///< a warp starts at First, by another one's vx_wspawn
  RasterStart,  ///< the agent's next command
  RasterWait,   ///< until the agent's commands are done
  RasterOther,  ///< any other access to a raster CSR
  RasterTake,   ///< until the agent has a batch of gradients, or has ended one
};

/// A core's trace being written. Owned by TraceBuffer (TraceWriter.h).
struct CoreTrace {
  RunRecord *RunAt = nullptr, *RunEnd = nullptr;
  uint32_t *WordAt = nullptr, *WordEnd = nullptr;
  uint32_t LocalBanks = 16;
  bool InterleavedStacks = true;
};

/// Appends the instructions of S->Trace, which is not null, from \p Start up
/// to, not including, \p End.
void traceRun(WarpState *S, const Insn *Start, const Insn *End);
/// Appends where the active lanes' accesses of \p Bytes each go; \p Addresses
/// by lane. \p IsStore and \p IsAtomic say what the instruction is.
void traceAccess(WarpState *S, const uint32_t *Addresses, unsigned Bytes,
                 bool IsStore, bool IsAtomic);

} // namespace vorion::isasim
