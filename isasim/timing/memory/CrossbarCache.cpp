#include "timing/memory/CrossbarCache.h"

#include <algorithm>

namespace vorion::isasim {

CrossbarCache::CrossbarCache(const CacheShape &ShapeIn, uint32_t QueueIn,
                             uint32_t PortCount, uint32_t PortQueues,
                             MemoryBelow &BelowIn)
    : Shape(ShapeIn), Queue(QueueIn), Below(BelowIn), Tags(Shape),
      Ports(PortCount, {std::vector<std::deque<CacheRequest>>(PortQueues + 1),
                        PortQueues,
                        {}}),
      Banks(Shape.Banks), LastSender(Shape.Banks - 1) {
  for (Bank &B : Banks)
    B.Mshrs.resize(Shape.Mshrs);
}

std::optional<uint64_t> CrossbarCache::access(const CacheRequest &R) {
  Port &P = Ports[R.Port];
  const auto Last = static_cast<uint32_t>(P.Queues.size()) - 1;
  std::deque<CacheRequest> &Q =
      P.Queues[R.Dequeued.Unit == Ticket::Nobody
                   ? Last
                   : R.Address / TimingLineBytes % Last];
  Q.push_back(R);
  // A core whose place in the order was guessed may be late.
  Q.back().Now = std::max(R.Now, Now + BufferCycles);
  return std::nullopt;
}

void CrossbarCache::fill(uint32_t Miss, uint64_t Then,
                         std::vector<Answer> & /*Answers*/) {
  comesFromBelow(Miss, Then);
}

uint64_t CrossbarCache::nextEvent() const {
  if (!IsIdle)
    return Now;
  // What waits since the last cycle waits for something else to happen.
  uint64_t Next = Turn::Never;
  if (!FromBelow.empty())
    Next = std::max(FromBelow.front().At, Now);
  const auto Consider = [&](const std::deque<CacheRequest> &Waiting,
                            uint64_t Before) {
    if (!Waiting.empty() && Waiting.front().Now - Before >= Now)
      Next = std::min(Next, Waiting.front().Now - Before);
  };
  for (const Port &P : Ports) {
    Consider(P.Buffer, 0);
    for (const auto &Q : P.Queues)
      Consider(Q, BufferCycles);
  }
  for (const Bank &B : Banks)
    if (B.BusyUntil >= Now)
      Next = std::min(Next, B.BusyUntil);
  return Next;
}

void CrossbarCache::step(std::vector<Answer> &Answers) {
  Now = nextEvent();
  IsIdle = true;
  // All look at how the cycle before has left the queues.
  for (uint32_t N = 0; N != Banks.size(); ++N) {
    Bank &B = Banks[N];
    B.Stalls = B.Answers.size() == MostAnswers && B.Stages[1] &&
               isAnswered(*B.Stages[1]);
    B.Chosen.reset();
    if (!B.Stalls)
      B.Chosen = choose(N, Answers);
    IsIdle &= !B.Stages[0] && !B.Stages[1] && B.Answers.empty() &&
              B.Below.empty() && !B.Replays && !B.Chosen;
  }
  IsIdle &= !fillBuffers(Answers);
  answerPorts(Answers);
  sendDown();
  for (uint32_t N = 0; N != Banks.size(); ++N) {
    Bank &B = Banks[N];
    if (B.Stalls)
      continue;
    if (B.Stages[1])
      finish(N, *B.Stages[1]);
    if (B.Stages[0])
      lookUp(N, *B.Stages[0]);
    B.Stages[1] = B.Stages[0];
    B.Stages[0] = B.Chosen;
    // The request that a line was fetched for is the first to find it.
    if (B.Chosen && B.Chosen->What == Kind::Fill)
      B.Replays = B.Chosen->Mshr;
  }
  ++Now;
}

/// One queue of a port in turn sends a request. Returns whether any did.
bool CrossbarCache::fillBuffers(std::vector<Answer> &Answers) {
  bool Some = false;
  for (Port &P : Ports) {
    // Room is seen a cycle later.
    if (P.Buffer.size() + (P.GaveAt == Now) >= MostBuffered)
      continue;
    const auto Count = static_cast<uint32_t>(P.Queues.size());
    for (uint32_t K = 1; K <= Count; ++K) {
      const uint32_t N = (P.LastSender + K) % Count;
      std::deque<CacheRequest> &Q = P.Queues[N];
      if (Q.empty() || Q.front().Now > Now + BufferCycles)
        continue;
      P.LastSender = N;
      if (Q.front().Dequeued.Unit != Ticket::Nobody)
        Answers.push_back({Q.front().Dequeued, Now});
      P.Buffer.push_back(Q.front());
      P.Buffer.back().Now = Now + BufferCycles;
      Q.pop_front();
      Some = true;
      break;
    }
  }
  return Some;
}

/// A port takes the answer of one bank.
void CrossbarCache::answerPorts(std::vector<Answer> &Answers) {
  for (Bank &B : Banks) {
    if (B.Answers.empty() || Ports[B.Answers.front().Port].GotAt == Now)
      continue;
    const CacheRequest &R = B.Answers.front();
    Ports[R.Port].GotAt = Now;
    if (R.From.Unit != Ticket::Nobody)
      Answers.push_back(
          {R.From, Now + Shape.HitCycles - BankCycles + R.Extra + R.Back});
    B.Answers.pop_front();
  }
}

/// One bank in turn sends a request, which is below in the next cycle. If none
/// has one, the turn begins with the first bank again.
void CrossbarCache::sendDown() {
  for (uint32_t K = 1; K <= Banks.size(); ++K) {
    const uint32_t N = (LastSender + K) % static_cast<uint32_t>(Banks.size());
    Bank &B = Banks[N];
    if (B.Below.empty())
      continue;
    LastSender = N;
    const RequestBelow R = B.Below.front();
    B.Below.pop_front();
    const uint32_t Address = R.Number * TimingLineBytes;
    if (R.IsWrite) {
      ++Counted.Writebacks;
      Below.writeBack(Now + 1, Address);
    } else if (const auto At = Below.fetch(Now + 1, Address, R.Keep, R.Miss)) {
      comesFromBelow(R.Miss, *At);
    }
    return;
  }
  LastSender = static_cast<uint32_t>(Banks.size()) - 1;
}

/// What bank \p Of takes in this cycle.
std::optional<CrossbarCache::Operation>
CrossbarCache::choose(uint32_t Of, std::vector<Answer> &Answers) {
  Bank &B = Banks[Of];
  if (B.BusyUntil > Now)
    return std::nullopt;
  std::optional<Operation> Chosen;
  if (B.Replays) {
    // A fill writes the tags that it would read.
    if (B.Stages[0] && B.Stages[0]->What == Kind::Fill)
      return std::nullopt;
    Mshr &M = B.Mshrs[*B.Replays];
    Chosen = Operation{.What = Kind::Replay, .R = M.R};
    M.IsUsed = false;
    --B.InUse;
    const auto Next = std::ranges::find_if(
        B.Mshrs, [](const Mshr &Each) { return Each.IsUsed && Each.IsReady; });
    B.Replays.reset();
    if (Next != B.Mshrs.end())
      B.Replays = static_cast<uint32_t>(Next - B.Mshrs.begin());
  } else if (!FromBelow.empty() && FromBelow.front().At <= Now &&
             FromBelow.front().Miss / Shape.Mshrs == Of) {
    const uint32_t Mshr = FromBelow.front().Miss % Shape.Mshrs;
    FromBelow.pop();
    Chosen = Operation{.What = Kind::Fill, .R = B.Mshrs[Mshr].R, .Mshr = Mshr};
  } else {
    Chosen = takeFromPort(Of, Answers);
  }
  if (Chosen && Watch)
    tellBusy(Of, {Now, Now + 1});
  return Chosen;
}

std::optional<CrossbarCache::Operation>
CrossbarCache::takeFromPort(uint32_t Of, std::vector<Answer> &Answers) {
  Bank &B = Banks[Of];
  const auto From = std::ranges::find_if(Ports, [&](const Port &P) {
    return !P.Buffer.empty() && P.Buffer.front().Now <= Now &&
           P.GaveAt != Now && bankOf(P.Buffer.front().Address) == Of;
  });
  if (From == Ports.end() || B.Below.size() >= Queue)
    return std::nullopt;
  if (B.InUse == Shape.Mshrs) {
    ++Counted.MshrCycles;
    return std::nullopt;
  }
  const CacheRequest R = From->Buffer.front();
  // A write changes the data that a read would get.
  if (!isWrite(R) && B.Stages[0] && B.Stages[0]->What == Kind::Request &&
      isWrite(B.Stages[0]->R))
    return std::nullopt;
  From->Buffer.pop_front();
  From->GaveAt = Now;
  Counted.BankCycles += Now - R.Now;
  ++(R.Op == CacheOp::Read ? Counted.Reads
     : isWrite(R)          ? Counted.Writes
                           : Counted.Atomics);
  B.InUse += fetches(R);
  B.BusyUntil = R.Extra ? Now + 1 + R.Extra : B.BusyUntil;
  if (isWrite(R) && R.From.Unit != Ticket::Nobody)
    Answers.push_back({R.From, Now + R.Back});
  return Operation{.What = Kind::Request, .R = R};
}

CacheTags::Use CrossbarCache::useOf(const CacheRequest &R) const {
  const bool Writes = R.Op != CacheOp::Read;
  return {.Writes = Writes,
          .Keep = R.Keep,
          .Dirties = Writes && !Shape.WriteThrough};
}

/// The line of \p O takes the place of another, if it is not there.
void CrossbarCache::allocate(Operation &O, const CacheTags::Use &Use) {
  const uint32_t Number = O.R.Address / TimingLineBytes;
  const uint32_t Set = Tags.setOf(Number);
  if (const size_t Found = Tags.find(Number, Set); Found != CacheTags::None) {
    Tags.use(Set, Found, Use);
    return;
  }
  const size_t Way = Tags.victim(Set, Counted.Kept);
  if (Tags.isDirty(Way))
    O.Evicts = Tags.number(Way);
  Tags.replace(Set, Way, Number, Use);
}

/// The first stage of bank \p Of.
void CrossbarCache::lookUp(uint32_t Of, Operation &O) {
  Bank &B = Banks[Of];
  const uint32_t Number = O.R.Address / TimingLineBytes;
  const auto IsSameLine = [Number](const Mshr &M) {
    return M.IsUsed && M.R.Address / TimingLineBytes == Number;
  };
  if (O.What == Kind::Fill) {
    allocate(O, {.Writes = false, .Keep = O.R.Keep, .Dirties = false});
    for (Mshr &M : B.Mshrs)
      M.IsReady |= IsSameLine(M);
    return;
  }
  const uint32_t Set = Tags.setOf(Number);
  const size_t Found = Tags.find(Number, Set);
  O.Hits = Found != CacheTags::None;
  if (O.Hits) {
    Tags.use(Set, Found, useOf(O.R));
    Counted.Hits += O.What == Kind::Request;
  }
  if (O.What == Kind::Replay || (O.Hits && fetches(O.R)))
    return;
  if (isWrite(O.R) && Shape.WriteThrough) {
    O.SendsDown = true;
    return;
  }
  if (!fetches(O.R)) {
    allocate(O, useOf(O.R));
    return;
  }
  const bool IsMerged = std::ranges::any_of(B.Mshrs, IsSameLine);
  Counted.Merged += IsMerged;
  O.SendsDown = !IsMerged;
  const auto Free =
      std::ranges::find_if(B.Mshrs, [](const Mshr &M) { return !M.IsUsed; });
  *Free = {O.R, true, false};
  O.Mshr = static_cast<uint32_t>(Free - B.Mshrs.begin());
}

/// The second stage of bank \p Of.
void CrossbarCache::finish(uint32_t Of, const Operation &O) {
  Bank &B = Banks[Of];
  const uint32_t Number = O.R.Address / TimingLineBytes;
  if (O.Evicts)
    B.Below.push_back({*O.Evicts, true, 0, false});
  if (O.What == Kind::Fill)
    return;
  if (isAnswered(O))
    B.Answers.push_back(O.R);
  if (O.What == Kind::Request && O.Hits)
    B.InUse -= fetches(O.R);
  if (O.SendsDown)
    B.Below.push_back(
        {Number, !fetches(O.R), Of * Shape.Mshrs + O.Mshr, O.R.Keep});
  else if (isAnswered(O) && O.R.Op == CacheOp::Atomic && Shape.WriteThrough)
    B.Below.push_back({Number, true, 0, false});
}

uint64_t CrossbarCache::flush(uint64_t From) {
  uint64_t Sent = From;
  for (size_t N = 0; N != Tags.places(); ++N)
    if (Tags.isDirty(N)) {
      ++Counted.Writebacks;
      Below.writeBack(Sent++, Tags.number(N) * TimingLineBytes);
    }
  Tags.clear();
  return Sent;
}

} // namespace vorion::isasim
