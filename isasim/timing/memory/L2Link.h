/// The way from the chip to its L2 where that has a clock of its own or lies
/// on another chip, as on the FPGA beside a prototype.
#pragma once

#include "timing/common/Picoseconds.h"
#include "timing/common/Turn.h"
#include "timing/dram/TimeQueue.h"
#include "timing/memory/Cache.h"

#include <array>
#include <cstdint>

namespace vorion::isasim {

/// Two directions that carry messages one after the other. Here cycles of the
/// chip become cycles of the L2, and come back.
class L2Link {
public:
  explicit L2Link(const TimingConfig &Params);

  /// Whether there is anything between the chip and the L2. Otherwise their
  /// cycles are the same, and nothing else of this is asked for.
  static bool exists(const TimingConfig &Params);
  /// The clock of all that lies behind the link.
  static uint32_t l2Mhz(const TimingConfig &Params) {
    return Params.Link.L2Mhz ? Params.Link.L2Mhz : Params.ClockMhz;
  }

  /// \name Cycles of the L2 in cycles of the chip
  /// @{
  /// The first that does not begin before \p L2Cycle.
  uint64_t toChip(uint64_t L2Cycle) const {
    return L2Cycle == Turn::Never ? L2Cycle : ByMhz.up(L2Cycle * ChipMhz);
  }
  /// The last that does not begin after \p Cycle, and the first that does not
  /// begin before it.
  uint64_t lastInL2(uint64_t Cycle) const {
    return Cycle == Turn::Never ? Cycle : ByChipMhz.down(Cycle * Mhz);
  }
  uint64_t firstInL2(uint64_t Cycle) const { return ByChipMhz.up(Cycle * Mhz); }
  /// @}

  struct Sent {
    uint64_t Gone;  ///< cycle of the chip: the sender has got rid of it
    uint64_t There; ///< cycle of the L2
  };
  /// A request leaves at the chip's cycle \p Now, behind those before it.
  Sent send(uint64_t Now, CacheOp Op);

  /// An answer, a line, waits at the L2 from the L2's cycle \p At on. Answers
  /// leave in the order of that time, so that nobody knows yet when it comes.
  void give(const Ticket &Of, uint64_t At) { Answers.push(Of, At, Given++); }
  /// The L2's cycle in which the next answer leaves if nothing else comes;
  /// Turn::Never if none waits.
  uint64_t nextAnswer() const {
    return Answers.empty() ? Turn::Never : Answers.front().At;
  }
  /// Sends the answer of nextAnswer() and appends it; its time is the chip's
  /// cycle in which it is there.
  void takeAnswer(std::vector<Answer> &Taken);

  /// Notifies \p Observers from now on; null for none.
  void watch(const TimeWatch *Observers) { Watch = Observers; }
  /// A run begins at the chip's cycle \p Now.
  void begin(uint64_t Now);
  /// Of a run until the chip's cycle \p End. What was sent and leaves later is
  /// in the bytes, and in the busy cycles of the next run.
  LinkTime time(uint64_t End) const;

private:
  /// One way. Times are in ps.
  struct Direction {
    Direction(uint64_t LatencyIn, uint64_t Mbps, uint32_t HeaderBytes);
    uint64_t Latency;
    /// A message is a header, with a line if it carries data.
    struct Message {
      uint32_t Bytes;
      uint64_t Ps;
    };
    std::array<Message, 2> Messages;
    uint64_t BusySince = 0; ///< without a gap until FreeAt
    uint64_t FreeAt = 0;
    uint64_t Bytes = 0;    ///< of the run
    uint64_t Busy = 0;     ///< since the machine was made, until FreeAt
    uint64_t BusyThen = 0; ///< likewise in cycles, until the run's begin
    /// When a message that is there at \p Now has left.
    uint64_t leave(uint64_t Now, bool HasData);
    /// Since the machine was made, until \p Now.
    uint64_t busyUntil(uint64_t Now) const;
  };
  uint64_t leave(bool IsToL2, uint64_t Now, bool HasData);
  struct Waiting {
    Ticket To;
    uint64_t At;
    uint64_t Number; ///< orders those of one time
  };
  struct IsBefore {
    bool operator()(const Waiting &A, const Waiting &B) const {
      return A.At != B.At ? A.At < B.At : A.Number < B.Number;
    }
  };

  /// Cycles of the chip and of the L2 in ps, and those that begin then.
  uint64_t psOfChip(uint64_t Cycle) const {
    return ByChipMhz.down(Cycle * PsTimesMhz);
  }
  uint64_t psOfL2(uint64_t Cycle) const {
    return ByMhz.down(Cycle * PsTimesMhz);
  }

  const uint64_t ChipMhz, Mhz;
  const Divisor ByChipMhz, ByMhz;
  Direction To, From;
  TimeQueue<Waiting, IsBefore> Answers;
  uint64_t Given = 0;
  const TimeWatch *Watch = nullptr;
};

} // namespace vorion::isasim
