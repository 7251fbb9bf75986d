/// A cache that several cores share through a crossbar, cycle by cycle. Its
/// rules are those of the L2 of Vortex's RTL of May 2023 (docs/validation.md).
#pragma once

#include "timing/dram/TimeQueue.h"
#include "timing/memory/Cache.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace vorion::isasim {

/// Who asks has a port with queues, which send to the crossbar in turn, a
/// request a cycle, while a buffer in front of it has room. Each cycle
/// - a bank takes, before all else, a request whose line has come, else a line
///   that comes from below, else the request at the front of the lowest port
///   that wants this bank;
/// - a port gets the answer of one bank, the lowest;
/// - one bank in turn sends a request down.
/// A bank takes nothing from ports while it has all its MSHRs in use or
/// Shape::Queue requests for what lies below, and stands still while it has
/// two answers that their port has not taken. Lines come from below in the
/// order of time, one a cycle: one that its bank does not take yet blocks those
/// behind it.
class CrossbarCache final : public SharedCache {
public:
  /// \p Queue: requests of a bank for what lies below, from which on it takes
  /// no more. \p PortQueues: of a port, by line address; there is one more for
  /// requests without a ticket CacheRequest::Dequeued.
  CrossbarCache(const CacheShape &Shape, uint32_t Queue, uint32_t Ports,
                uint32_t PortQueues, MemoryBelow &Below);

  /// A bank can take the request from R.Now on. It leaves its queue before.
  /// A write is answered when a bank has taken it.
  std::optional<uint64_t> access(const CacheRequest &R) override;
  void fill(uint32_t Miss, uint64_t Then,
            std::vector<Answer> &Answers) override;
  uint64_t nextEvent() const override;
  void step(std::vector<Answer> &Answers) override;
  uint64_t flush(uint64_t Now) override;

  /// From a bank's taking a request to its answer's leaving, in cycles: two
  /// stages and the queue of answers. What CacheShape::HitCycles has beyond
  /// that is the way there and back.
  static constexpr uint32_t BankCycles = 3;

private:
  enum class Kind : uint8_t {
    Request, ///< from a port
    Fill,    ///< a line from below
    Replay,  ///< a request whose line has come
  };
  struct Operation {
    Kind What;
    CacheRequest R;    ///< of a fill the address alone
    uint32_t Mshr = 0; ///< of a fill, or of a miss
    bool Hits = false;
    bool SendsDown = false; ///< a read, or a write of this line
    std::optional<uint32_t> Evicts = std::nullopt; ///< a changed line
  };
  struct RequestBelow {
    uint32_t Number;
    bool IsWrite;
    uint32_t Miss;
    bool Keep;
  };
  struct Mshr {
    CacheRequest R;
    bool IsUsed = false;
    bool IsReady = false; ///< its line has come
  };
  struct Bank {
    std::array<std::optional<Operation>, 2> Stages;
    std::deque<CacheRequest> Answers;
    std::deque<RequestBelow> Below;
    std::vector<Mshr> Mshrs;
    std::optional<uint32_t> Replays; ///< an MSHR
    /// Requests that have taken a place among the MSHRs. One that hits gives
    /// it back.
    uint32_t InUse = 0;
    uint64_t BusyUntil = 0; ///< with an atomic
    // In the present cycle.
    bool Stalls = false;
    std::optional<Operation> Chosen;
  };
  struct Arrival {
    uint64_t At, Number;
    uint32_t Miss;
  };
  struct IsBefore {
    bool operator()(const Arrival &A, const Arrival &B) const {
      return A.At != B.At ? A.At < B.At : A.Number < B.Number;
    }
  };
  static constexpr size_t MostAnswers = 2;
  /// Cycles from a port's queue to the crossbar: two buffers of two requests.
  static constexpr uint64_t BufferCycles = 2;
  static constexpr size_t MostBuffered = 4;

  static bool isWrite(const CacheRequest &R) {
    return R.Op == CacheOp::Write || R.Op == CacheOp::WriteWhole;
  }
  /// Whether a miss of it fetches the line.
  bool fetches(const CacheRequest &R) const {
    return !isWrite(R) || (R.Op == CacheOp::Write && !Shape.WriteThrough);
  }
  /// Whether the second stage has an answer for who asked.
  static bool isAnswered(const Operation &O) {
    return !isWrite(O.R) && O.What != Kind::Fill &&
           (O.Hits || O.What == Kind::Replay);
  }
  uint32_t bankOf(uint32_t Address) const {
    return Address / TimingLineBytes % Shape.Banks;
  }
  void comesFromBelow(uint32_t Miss, uint64_t Then) {
    FromBelow.push(std::max(Then, Now), Arrivals++, Miss);
  }
  bool fillBuffers(std::vector<Answer> &Answers);
  void answerPorts(std::vector<Answer> &Answers);
  void sendDown();
  std::optional<Operation> choose(uint32_t Of, std::vector<Answer> &Answers);
  std::optional<Operation> takeFromPort(uint32_t Of,
                                        std::vector<Answer> &Answers);
  void finish(uint32_t Of, const Operation &O);
  void lookUp(uint32_t Of, Operation &O);
  void allocate(Operation &O, const CacheTags::Use &Use);
  CacheTags::Use useOf(const CacheRequest &R) const;

  const CacheShape Shape;
  const uint32_t Queue;
  MemoryBelow &Below;
  CacheTags Tags;
  struct Port {
    std::vector<std::deque<CacheRequest>> Queues;
    uint32_t LastSender; ///< the queue that sent last
    std::deque<CacheRequest> Buffer;
    /// Cycles in which it gave a request, and got an answer, the last time.
    uint64_t GaveAt = Turn::Never, GotAt = Turn::Never;
  };
  std::vector<Port> Ports;
  std::vector<Bank> Banks;
  uint32_t LastSender = 0; ///< the bank that sent down last
  TimeQueue<Arrival, IsBefore> FromBelow;
  uint64_t Arrivals = 0;
  uint64_t Now = 0;   ///< the cycle that is done next at the earliest
  bool IsIdle = true; ///< nothing happened in the last cycle
};

} // namespace vorion::isasim
