/// The controller of one DRAM channel: requests go in, replies come out when
/// they are decided. It goes from one command to the next, never tick by tick,
/// and what it does depends on requests and their times alone.
#pragma once

#include "timing/dram/FrFcfs.h"
#include "timing/dram/TimeQueue.h"
#include "timing/dram/TimingTable.h"
#include "timing/policy/Policy.h"

#include <array>
#include <cassert>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace vorion::isasim::dram {

/// Later than everything.
inline constexpr uint64_t Never = std::numeric_limits<uint64_t>::max();

/// Where a line lies in its channel.
struct Place {
  uint32_t Bank = 0; ///< (rank * bank groups + group) * banks a group + bank
  uint32_t Row = 0;
};

struct Request {
  uint64_t At = 0; ///< tick at which the controller gets it
  uint64_t Id = 0; ///< whatever the sender knows it by; orders equal times
  uint64_t Line = 0;
  Place Where;
  bool IsWrite = false;
};

struct Reply {
  uint64_t Id = 0;
  uint64_t Decided = 0; ///< tick in which it was
  /// Tick after a read's last byte has arrived, or a write's has been written.
  uint64_t Done = 0;
  bool IsWrite = false;
};

/// A command as it was issued, for whoever checks or records them.
struct Issued {
  uint64_t At;
  Command What;
  Place Where; ///< of a rank's command: its first bank
};

struct ControllerOptions {
  uint32_t LineBytes = 64;
  /// Room for bursts that have not been taken up, of reads and of writes.
  uint32_t ReadQueue = 64, WriteQueue = 64;
  /// Writes are drained from more than this part of their queue on, in per
  /// cent, until there is less than the other.
  uint32_t DrainAbove = 80, DrainBelow = 20;
  /// Bursts written while reads wait before reads have their turn.
  uint32_t MostDrained = 256;
  /// Accesses to a row since it was opened after which it loses its precedence
  /// over older requests: those beyond the first.
  uint32_t RowHitCap = 16;
  /// Ticks after which an open row that nobody waits for is closed; Never
  /// leaves it open, 0 closes it at once.
  uint64_t CloseRowAfter = Never;
  enum class RefreshBy : uint8_t { Rank, Bank, Nothing };
  RefreshBy Refresh = RefreshBy::Rank;
};

struct ControllerCounts {
  uint64_t Reads = 0, Writes = 0; ///< bursts
  /// Requests whose row was open, whose bank was closed, whose bank had another
  /// row open, when they were first taken up.
  uint64_t RowHits = 0, RowMisses = 0, RowConflicts = 0;
  uint64_t Forwarded = 0; ///< reads answered by a waiting write
  uint64_t Activations = 0, Refreshes = 0;
  uint64_t Drains = 0;   ///< times that writes were begun to be drained
  uint64_t BusTicks = 0; ///< for which the data bus was taken
};

/// What is wrong with \p Options for a device of \p Table, as one line that
/// names the option, or success.
Expected<Success> check(const TimingTable &Table,
                        const ControllerOptions &Options);

/// Requests whose row was opened for them go before all others, then refreshes,
/// then reads or, while writes are drained, writes, in the order of a
/// scheduler. docs/dram.md has the rules one by one.
class Controller {
public:
  /// \p Chosen must have passed check(); \p DeviceTable must outlive this.
  /// Without \p Plugged requests are in the order of FrFcfs.
  explicit Controller(const TimingTable &DeviceTable,
                      const ControllerOptions &Chosen = {},
                      std::unique_ptr<DramScheduler> Plugged = nullptr);

  /// Takes a request. Its time is not before the last tick that advance() has
  /// come to. Requests of one time may be submitted in any order. One whose
  /// queue is full waits in front of it, behind earlier ones of its kind.
  void submit(const Request &R) {
    assert(R.Where.Bank < Banks.size() && "a bank that the device has not");
    assert(R.At >= AdvancedTo && "a request of the past");
    Queues[R.IsWrite].Waiting.push(R.At, R.Id, R.Line, R.Where, R.IsWrite);
    ++Unanswered;
  }

  /// Lines for which the queue of reads or writes has room beyond what waits.
  uint32_t room(bool IsWrite) const;

  /// The next tick at which something may be decided, if nothing more is
  /// submitted; Never if there is no request.
  uint64_t nextEvent() const;

  /// Goes on to the end of tick \p Until and appends what was decided, in the
  /// order of decisions. A reply's time may lie beyond.
  void advance(uint64_t Until, std::vector<Reply> &Replies);

  const ControllerCounts &counts() const { return Counted; }
  void clearCounts() { Counted = {}; }
  /// From now on commands are appended to \p Log; null for none.
  void record(std::vector<Issued> *Log) { Recorded = Log; }

private:
  static constexpr uint32_t None = UINT32_MAX;

  /// A request that is known to the scheduler.
  struct Entry {
    uint64_t Order, Id, Line;
    uint32_t Bank, Row;
    uint32_t Next, Previous; ///< in its bank's queue
    uint16_t Queued;         ///< bursts that have not been taken up
    uint16_t Left;           ///< bursts that have not been issued
    bool IsWrite, IsSeen;
  };
  /// Requests to the open row of a bank, or to none or another.
  enum Kind : uint8_t { Hit, Miss, Kinds };
  struct Oldest {
    uint32_t Entry = None;
    uint64_t Order = 0;
  };
  /// A bank's reads or writes, oldest first.
  struct BankQueue {
    uint32_t First = None, Last = None;
    std::array<Oldest, Kinds> OldestOf; ///< by Kind
  };
  /// By time and id.
  struct IsBefore {
    bool operator()(const Request &A, const Request &B) const {
      return A.At != B.At ? A.At < B.At : A.Id < B.Id;
    }
  };
  struct Queue {
    std::array<uint64_t, Kinds> BanksWith{}; ///< bit sets, by Kind
    uint32_t Bursts = 0;                     ///< not taken up
    uint32_t Capacity = 0;
    std::vector<BankQueue> Banks;
    TimeQueue<Request, IsBefore> Waiting; ///< not yet taken in
  };
  /// The first tick at which each command can begin.
  using Ticks = std::array<uint64_t, Commands>;
  struct Bank {
    Ticks Next{}; ///< as this bank's past allows
    uint64_t LastUse = 0;
    uint32_t Row = 0;
    uint32_t Uses = 0; ///< since the row was opened
    uint32_t Group = 0, Rank = 0;
    uint32_t Common = 0; ///< where its group's ticks lie
    bool IsOpen = false;
  };
  struct Rank {
    std::vector<uint64_t> Activations;
    uint32_t OldestActivation = 0;
    uint32_t RefreshesDue = 0, BankToRefresh = 0;
    uint64_t NextRefresh = Never;
  };
  /// Who goes first of those that could begin at one tick.
  enum class Precedence : uint8_t {
    Promoted,
    Refresh,
    Queue,
    Capped,
    Closing,
    SecondActivate ///< while it can wait; else it is the first of all
  };
  /// What is decided next.
  struct Choice {
    uint64_t Begin = Never; ///< first tick of the command
    uint64_t Order = Never;
    Precedence Class = Precedence::Promoted;
    Command What = Command::Count;
    uint32_t Bank = 0;             ///< of a rank's command: its first
    uint32_t Entry = None;         ///< on whose behalf, if any
    uint32_t PlacePromoted = None; ///< where, if it is promoted
  };
  /// A command, and how long after the last tick of another it can begin.
  struct Step {
    uint32_t To; ///< of the bank: the command; else a place in Common
    uint32_t Ticks;
  };
  static bool isColumn(Command C) {
    return C == Command::Read || C == Command::Write;
  }
  static bool isOfRank(Command C) {
    return C == Command::PrechargeAll || C == Command::Refresh;
  }
  bool hasRoom(const Queue &Q) const {
    return Q.Bursts + BurstsOfLine <= Q.Capacity;
  }
  uint64_t nextTakenIn() const;
  bool isIssued(Command C) const;
  uint32_t groups() const { return Table.Ranks * Table.BankGroups; }
  uint32_t placeOfRank(uint32_t R, Command C) const {
    return static_cast<uint32_t>((groups() + R) * Commands + size_t(C));
  }
  void addSteps(const Constraint &C);
  bool settle(std::vector<Reply> &Replies);
  bool takeIn(std::vector<Reply> &Replies);
  bool enter(const Request &R, std::vector<Reply> &Replies);
  bool isBeingWritten(const Request &R) const;
  bool noteRefreshes();
  void chooseQueue();

  static Command columnOf(const Entry &E) {
    return E.IsWrite ? Command::Write : Command::Read;
  }
  Command activeColumn() const {
    return IsDraining ? Command::Write : Command::Read;
  }
  void decide();
  void considerPromoted();
  void considerRefreshes();
  void considerQueue();
  template <typename Scheduler> void considerQueueBy(const Scheduler &S);
  void setOldest(Queue &Q, uint32_t Bank, Kind Which, uint32_t Entry);
  void considerCapped(const Queue &Q);
  void considerClosing();
  void considerSecondActivate();
  void consider(uint64_t Ready, uint64_t Order, Precedence Class, Command What,
                uint32_t Bank, uint32_t Entry, uint32_t PlacePromoted);
  uint64_t ready(Command C, const Bank &B) const;
  Command nextOf(const Entry &E) const;

  void issue(std::vector<Reply> &Replies);
  void restrict(Command C, Bank &B, uint64_t At);
  void promote(uint32_t Which);
  void access(uint64_t At, std::vector<Reply> &Replies);
  void open(uint32_t Which, uint32_t Row, uint64_t At);
  void close(uint32_t Which);
  void findFirsts(Queue &Q, uint32_t Which);
  void leaveQueue(uint32_t Which);

  const TimingTable &Table;
  const ControllerOptions Options;
  Policy<DramScheduler, FrFcfs> Schedule;
  const bool CapsRows; ///< whether it does
  const uint32_t BurstsOfLine;
  uint32_t Above, Below; ///< drain marks, in bursts
  uint64_t RefreshInterval = Never;
  /// What a command forbids its bank.
  std::array<std::vector<Step>, Commands> StepsInBank;
  /// What one to a bank group forbids groups and ranks, by command and group.
  std::vector<std::vector<Step>> StepsElsewhere;
  uint32_t Window = 0, WindowTicks = 0;

  uint64_t AdvancedTo = 0;           ///< how far advance() came
  uint64_t Now = 0;                  ///< no command is begun before
  std::array<uint64_t, 2> BusFree{}; ///< of the command buses: the first tick
  /// By command: its bus, its ticks but the last, the first tick that bus and
  /// Now allow.
  std::array<uint8_t, Commands> BusOf{};
  std::array<uint32_t, Commands> LaterTicks{};
  Ticks BusReady{};
  std::vector<Bank> Banks;
  /// The first tick at which group, rank and channel allow each command, by
  /// group; then those to whole ranks, by rank.
  std::vector<uint64_t> Common;
  std::vector<Rank> Ranks;
  uint64_t Open = 0;    ///< bit set of banks
  uint64_t Opened = 0;  ///< those whose row waits for its first burst
  uint64_t Blocked = 0; ///< those that wait for a refresh
  uint64_t Capped = 0;  ///< those whose row has lost its precedence
  uint64_t NextRefresh = Never;
  uint32_t RefreshesDue = 0;
  /// An activation whose second half is still to come, from tick \c From on and
  /// not after \c Until.
  struct HalfActivate {
    uint64_t From, Until;
    uint32_t Bank;
  };
  std::optional<HalfActivate> Half;
  std::array<Queue, 2> Queues; ///< reads, writes
  bool IsDraining = false;
  uint32_t ReadsOut = 0; ///< bursts taken in and not issued
  uint32_t Drained = 0;  ///< bursts, while reads waited
  uint32_t Owed = 0;     ///< bursts read before the next drain
  std::vector<Entry> Entries;
  std::vector<uint32_t> Free;
  /// A burst each, whose row was opened for it; of different banks.
  std::vector<uint32_t> Promoted;
  uint64_t NextOrder = 0;
  uint64_t Unanswered = 0;
  Choice Next;
  bool IsDecided = false;
  ControllerCounts Counted;
  std::vector<Issued> *Recorded = nullptr;
};

} // namespace vorion::isasim::dram
