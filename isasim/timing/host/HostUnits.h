/// How long commands of the host take: the command processor, which fetches
/// them from the host's memory, and the DMA engines, which copy lines between
/// the host's link and the device's memory
/// (docs/adr/0011-command-processor.md).
#pragma once

#include "timing/common/CycleLedger.h"
#include "timing/common/TimeObserver.h"
#include "timing/common/Turn.h"
#include "timing/dram/TimeQueue.h"
#include "timing/memory/MemorySystem.h"
#include "vorion/isasim/HostCommand.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace vorion::isasim {

/// Times are cycles of the chip. Its owner calls step() in the order of time,
/// together with cores and rasterizers.
class HostUnits {
public:
  explicit HostUnits(const TimingConfig &Params);

  /// Whether a machine has them; otherwise nothing else may be called.
  static bool exist(const TimingConfig &Params) {
    return Params.Host.DmaEngines != 0;
  }

  /// The host sends a command, behind those before it; returns its number.
  uint64_t sendCopy(const HostCopy &Copy, CommandOrder Order);
  /// The cores can run it from launchAt() on. It holds its place in the queue
  /// until launchEnded().
  uint64_t sendLaunch(CommandOrder Order);
  /// The number of the last command; 0 if there was none.
  uint64_t last() const { return Ends.size(); }
  /// Nothing as long as a command before it has to be timed first.
  std::optional<uint64_t> launchAt(uint64_t Number) const {
    return at(Number).ReadyAt;
  }
  void launchEnded(uint64_t Number, uint64_t At) { ended(Number, At); }
  /// When a command has ended; nothing if that is not known yet.
  std::optional<uint64_t> endOf(uint64_t Number) const;
  /// Whether every command has ended.
  bool isIdle() const { return Open.empty(); }

  /// The time that they have come to.
  uint64_t present() const { return Present; }

  /// When it next does something.
  Turn turn() const {
    return Turn(Events.empty() ? Turn::Never : Events.front().At);
  }
  void step(MemorySystem &Memory);
  /// An answer of memory, of a ticket of these units.
  void answer(const Answer &A);

  /// Notifies \p Observers from now on; null for none.
  void watch(const TimeWatch *Observers);
  void begin(uint64_t Now);
  void end(uint64_t End);
  /// All copies end at \p Now, as if they had been done.
  void reset(uint64_t Now);

  const CommandTime &processor() const { return OfProcessor; }
  std::vector<DmaTime> engines() const;
  /// Over the host's link, both ways: lines, and 64 bytes of each command.
  uint64_t linkBytes() const { return LinkBytes; }

private:
  struct Command {
    bool IsLaunch = false;
    HostCopy Copy;
    CommandOrder Order;
    std::optional<uint64_t> DecodedAt = std::nullopt, ReadyAt = std::nullopt;
    bool IsOpen = true;
  };
  /// A line on its way, in a place among an engine's lines in flight.
  struct Line {
    uint64_t FirstDone = 0; ///< its first half: from the host or from memory
    uint64_t Number = 0;    ///< in the copy
    bool IsWrite = false;   ///< it is in its second half, of memory
  };
  struct Engine {
    uint64_t Command = 0;         ///< 0 if it has none
    uint64_t Next = 0, Lines = 0; ///< the next line to begin, and how many
    std::vector<Line> Places;
    std::vector<uint32_t> Free; ///< places
    bool IsBlocked = false;     ///< it needs a place to go on
    uint64_t SpentUntil = 0;
    CycleLedger<DmaCycle> Ledger;
    DmaTime Time;
  };
  enum class What : uint8_t {
    Ready,    ///< a copy can begin
    Begin,    ///< an engine begins a line
    AtDevice, ///< a line has come over the host's link
    Answered, ///< memory has answered a line
    Gone,     ///< a line has left over the host's link
  };
  struct Event {
    uint64_t At;
    uint64_t Serial; ///< orders those of one time
    What Kind;
    uint64_t Number; ///< of the command, or the engine
    uint32_t Place;
  };
  struct IsBefore {
    bool operator()(const Event &A, const Event &B) const {
      return A.At != B.At ? A.At < B.At : A.Serial < B.Serial;
    }
  };

  /// A direction of the host's link, which carries a line at a time.
  struct Direction {
    uint64_t FreeAt = 0; ///< ps
    uint64_t carry(uint64_t Ps, uint64_t Took) {
      FreeAt = std::max(Ps, FreeAt) + Took;
      return FreeAt;
    }
  };

  void freePlaces(Engine &E);
  uint64_t carry(Direction &D, uint64_t Now);
  uint64_t send(Command C);
  Command &at(uint64_t Number) { return Open[Number - First]; }
  const Command &at(uint64_t Number) const { return Open[Number - First]; }
  template <typename Function>
  std::optional<uint64_t> lastEnd(const std::vector<uint64_t> &Numbers,
                                  Function Later) const;
  void forgetFirst();
  void goOn();
  bool decode(uint64_t Number);
  void ended(uint64_t Number, uint64_t At);
  void push(uint64_t At, What Kind, uint64_t Number, uint32_t Place = 0);
  void startCopies(uint64_t Now);
  void beginLine(Engine &E, uint64_t Now, MemorySystem &Memory);
  void access(Engine &E, uint32_t Place, uint64_t Now, CacheOp Op,
              uint32_t Address, MemorySystem &Memory);
  void write(Engine &E, uint32_t Place, uint64_t Now, MemorySystem &Memory);
  void answered(Engine &E, uint32_t Place, uint64_t Now, MemorySystem &Memory);
  void lineDone(Engine &E, uint32_t Place, uint64_t Now);
  DmaCycle rest(const Engine &E) const;
  void spend(Engine &E, DmaCycle Reason, uint64_t Until);
  uint64_t numberOf(const Engine &E) const {
    return static_cast<uint64_t>(&E - Engines.data());
  }

  const HostTiming Timing;
  const uint64_t ChipMhz;
  /// Cycles: of a message on the host's link, to decode a command, and of a
  /// line on an engine's datapath.
  const uint64_t OneWay, DecodeCycles, LineCycles;
  const uint64_t LinePs; ///< of a line on the host's link
  Direction ToDevice, FromDevice;

  uint64_t Present = 0;     ///< nothing is done before
  std::deque<Command> Open; ///< from number First on
  uint64_t First = 1;
  /// By number - 1: when a command ended, Turn::Never if it has not; and when
  /// it and all before it had.
  std::vector<uint64_t> Ends, AllEnds;
  std::vector<bool> IsRead;        ///< by number - 1: a copy to the host
  uint64_t SentAt = 0;             ///< of the last command that is decoded
  uint64_t DecodedUntil = 0;       ///< the same
  uint64_t Decoded = 0;            ///< its number
  std::vector<uint64_t> Undecided; ///< decoded; what they wait for is open
  std::deque<uint64_t> Waiting;    ///< copies that wait for an engine
  std::vector<Engine> Engines;
  TimeQueue<Event, IsBefore> Events;
  uint64_t Serial = 0;
  /// \name A ticket's tag: the number of reset() calls before it, and a place
  /// @{
  static constexpr unsigned PlaceBits = 12;
  uint32_t Epoch = 0;
  /// @}
  CycleLedger<CommandCycle> Ledger;
  CommandTime OfProcessor;
  uint64_t LinkBytes = 0;
};

} // namespace vorion::isasim
