#include "timing/memory/Cache.h"

#include "timing/memory/MemoryWatch.h"

#include <algorithm>

namespace vorion::isasim {

void SharedCache::tellBusy(uint32_t Bank, CycleSpan When) const {
  BankPlace Where = Place;
  Where.Bank = Bank;
  Watch->bankBusy(Where, When);
}

Cache::Cache(const CacheShape &ShapeIn, MemoryBelow &BelowIn)
    : Shape(ShapeIn), Below(BelowIn), Tags(Shape), OfBanks(Shape.Banks),
      Banks(Shape.Banks), MshrFreeAt(size_t{Shape.Banks} * Shape.Mshrs),
      Mshrs(MshrFreeAt.size()) {}

uint32_t Cache::firstMshr(uint32_t Bank) const {
  const auto First = MshrFreeAt.begin() + size_t{Bank} * Shape.Mshrs;
  return static_cast<uint32_t>(std::min_element(First, First + Shape.Mshrs) -
                               MshrFreeAt.begin());
}

/// When the bytes of a line that is there have come. That is before all that
/// its bank does from now on, unless an MSHR still holds it.
inline uint64_t Cache::readyAt(uint32_t Bank, uint32_t Number,
                               uint32_t Note) const {
  const uint32_t Miss = mshrOf(Bank, Note);
  return Note && Mshrs[Miss].Number == Number ? MshrFreeAt[Miss] : 0;
}

std::optional<uint64_t> Cache::access(const CacheRequest &R) {
  Bank &B = Banks[OfBanks(R.Address / TimingLineBytes)];
  std::optional<uint64_t> Answer;
  if (!B.Waiting.empty() || !take(R, Answer))
    B.Waiting.push_back(R);
  return Answer;
}

/// Does serve() and tells of it.
bool Cache::take(const CacheRequest &R, std::optional<uint64_t> &Answer) {
  const uint32_t OfBank = OfBanks(R.Address / TimingLineBytes);
  const Bank &B = Banks[OfBank];
  const uint64_t Begin = std::max(R.Now, B.FreeAt);
  if (!serve(R, Answer))
    return false;
  if (Watch)
    tellBusy(OfBank, {Begin, B.FreeAt});
  return true;
}

/// Returns whether the request's bank could take it; \p Answer is as of
/// access().
bool Cache::serve(const CacheRequest &R, std::optional<uint64_t> &Answer) {
  const uint32_t Number = R.Address / TimingLineBytes;
  const uint32_t OfBank = OfBanks(Number);
  const uint32_t Set = Tags.setOf(Number);
  const size_t Found = Tags.find(Number, Set);
  const bool IsRead = R.Op == CacheOp::Read;
  const bool IsWrite = R.Op == CacheOp::Write || R.Op == CacheOp::WriteWhole;
  const bool Passes = Shape.WriteThrough && IsWrite;
  const bool Fetches =
      Found == CacheTags::None && R.Op != CacheOp::WriteWhole && !Passes;
  const uint32_t Miss = Fetches ? firstMshr(OfBank) : 0;
  if (Fetches && MshrFreeAt[Miss] == Open)
    return false;

  Bank &B = Banks[OfBank];
  const uint64_t At = std::max(R.Now, B.FreeAt);
  Counted.BankCycles += At - R.Now;
  B.FreeAt = At + 1 + R.Extra;
  ++(IsRead ? Counted.Reads : IsWrite ? Counted.Writes : Counted.Atomics);
  if (Shape.WriteThrough && !IsRead) {
    ++Counted.Writebacks;
    Below.writeBack(At + Shape.HitCycles / 2, R.Address);
  }
  const CacheTags::Use Use{.Writes = !IsRead,
                           .Keep = R.Keep,
                           .Dirties = !IsRead && !Shape.WriteThrough};
  if (Passes && Found == CacheTags::None) {
    Answer = At + Shape.HitCycles / 2 + R.Back;
    return true;
  }
  if (Found != CacheTags::None) {
    const uint32_t Note = Tags.note(Found);
    const uint64_t ReadyAt = readyAt(OfBank, Number, Note);
    Tags.use(Set, Found, Use);
    ++(ReadyAt > At ? Counted.Merged : Counted.Hits);
    const uint32_t Plus = Shape.HitCycles + R.Extra + R.Back;
    if (IsWrite)
      // A write is taken when the bank has it; who wrote does not wait.
      Answer = At + Shape.HitCycles / 2 + R.Back;
    else if (ReadyAt != Open)
      Answer = std::max(At, ReadyAt) + Plus;
    else
      Mshrs[mshrOf(OfBank, Note)].Waiting.emplace_back(R.From, At, Plus);
    return true;
  }

  const size_t Way = Tags.victim(Set, Counted.Kept);
  if (Tags.isDirty(Way)) {
    ++Counted.Writebacks;
    Below.writeBack(At, Tags.number(Way) * TimingLineBytes);
  }
  Tags.replace(Set, Way, Number, Use,
               Fetches ? Miss - mshrOf(OfBank, 1) + 1 : 0);
  if (!Fetches) {
    Answer = At + Shape.HitCycles / 2 + R.Back;
    return true;
  }
  const uint64_t Begin = std::max(At, MshrFreeAt[Miss]);
  Counted.MshrCycles += Begin - At;
  // A miss that waits for an MSHR holds up its bank.
  B.FreeAt = Begin + 1 + R.Extra;
  Mshrs[Miss].Number = Number;
  // The tags have been looked up before the request goes down.
  const uint64_t ReadyAt =
      Below.fetch(Begin + Shape.HitCycles / 2, R.Address, R.Keep, Miss)
          .value_or(Open);
  MshrFreeAt[Miss] = ReadyAt;
  const uint32_t Plus =
      Shape.HitCycles - Shape.HitCycles / 2 + R.Extra + R.Back;
  if (IsWrite)
    Answer = Begin + Shape.HitCycles / 2 + R.Back;
  else if (ReadyAt != Open)
    Answer = ReadyAt + Plus;
  else
    Mshrs[Miss].Waiting.emplace_back(R.From, 0, Plus);
  return true;
}

void Cache::fill(uint32_t Miss, uint64_t Then, std::vector<Answer> &Answers) {
  Mshr &M = Mshrs[Miss];
  MshrFreeAt[Miss] = Then;
  for (const Merged &W : M.Waiting)
    Answers.push_back({W.From, std::max(W.NotBefore, Then) + W.Plus});
  M.Waiting.clear();

  std::deque<CacheRequest> &Waiting = Banks[Miss / Shape.Mshrs].Waiting;
  while (!Waiting.empty()) {
    const CacheRequest R = Waiting.front();
    std::optional<uint64_t> Known;
    if (!take(R, Known))
      return;
    Waiting.pop_front();
    if (Known && R.From.Unit != Ticket::Nobody)
      Answers.push_back({R.From, *Known});
  }
}

uint64_t Cache::flush(uint64_t Now) {
  std::vector<uint64_t> Sent(Shape.Banks, Now);
  for (size_t N = 0; N != Tags.places(); ++N)
    if (Tags.isDirty(N)) {
      ++Counted.Writebacks;
      Below.writeBack(Sent[Tags.number(N) % Shape.Banks]++,
                      Tags.number(N) * TimingLineBytes);
    }
  Tags.clear();
  return *std::max_element(Sent.begin(), Sent.end());
}

} // namespace vorion::isasim
