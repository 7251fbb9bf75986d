#include "timing/memory/Cache.h"

#include "timing/memory/MemoryWatch.h"

#include <algorithm>

namespace vorion::isasim {

Cache::Cache(const CacheShape &ShapeIn, MemoryBelow &BelowIn)
    : Shape(ShapeIn),
      Sets(std::max(1U, Shape.Bytes / TimingLineBytes / Shape.Ways)),
      Below(BelowIn), Tags(size_t{Sets} * Shape.Ways), Lines(Tags.size()),
      LastUse(Tags.size()), Banks(Shape.Banks),
      MshrFreeAt(size_t{Shape.Banks} * Shape.Mshrs), Mshrs(MshrFreeAt.size()) {}

// The loops over ways have no branch that depends on what they find, because
// the host's branch predictor would mispredict it.
size_t Cache::find(uint32_t Number, size_t Set) const {
  // At most one way has the line, so that a sum over all finds it, which needs
  // no way's answer before the next one's.
  const uint32_t *Tag = Tags.data() + Set;
  uint32_t Behind = 0;
  for (uint32_t W = 0; W != Shape.Ways; ++W)
    Behind += Tag[W] == Number + 1 ? W + 1 : 0;
  return Behind ? Set + Behind - 1 : None;
}

/// The least recently used line; with the hint, the least recently used one
/// without it, and the one that is spared loses its hint, so that lines which
/// no tile came for do not stay for ever.
size_t Cache::victim(size_t Set) {
  // With the hint in the mask, lines that are kept come behind all others.
  const auto OldestBy = [&](uint64_t Mask) {
    size_t Oldest = Set;
    uint64_t Used = Open;
    for (size_t W = Set; W != Set + Shape.Ways; ++W) {
      const uint64_t Order = LastUse[W] & Mask;
      Oldest = Order < Used ? W : Oldest;
      Used = std::min(Used, Order);
    }
    return Oldest;
  };
  const size_t Oldest = OldestBy(OrderMask);
  if (!Shape.Hint || !(LastUse[Oldest] & Kept))
    return Oldest;
  const size_t OldestPlain = OldestBy(OrderMask | Kept);
  if (LastUse[OldestPlain] & Kept)
    return Oldest;
  LastUse[Oldest] &= ~Kept;
  ++Counted.Kept;
  return OldestPlain;
}

uint32_t Cache::firstMshr(uint32_t Bank) const {
  const auto First = MshrFreeAt.begin() + size_t{Bank} * Shape.Mshrs;
  return static_cast<uint32_t>(std::min_element(First, First + Shape.Mshrs) -
                               MshrFreeAt.begin());
}

std::optional<uint64_t> Cache::access(const CacheRequest &R) {
  Bank &B = Banks[R.Address / TimingLineBytes % Shape.Banks];
  std::optional<uint64_t> Answer;
  if (!B.Waiting.empty() || !take(R, Answer))
    B.Waiting.push_back(R);
  return Answer;
}

/// Does serve() and tells of it.
bool Cache::take(const CacheRequest &R, std::optional<uint64_t> &Answer) {
  const uint32_t OfBank = R.Address / TimingLineBytes % Shape.Banks;
  const Bank &B = Banks[OfBank];
  const uint64_t Begin = std::max(R.Now, B.FreeAt);
  if (!serve(R, Answer))
    return false;
  if (Watch) {
    BankPlace Where = Place;
    Where.Bank = OfBank;
    Watch->bankBusy(Where, {Begin, B.FreeAt});
  }
  return true;
}

/// Returns whether the request's bank could take it; \p Answer is as of
/// access().
bool Cache::serve(const CacheRequest &R, std::optional<uint64_t> &Answer) {
  const uint32_t Number = R.Address / TimingLineBytes;
  const uint32_t OfBank = Number % Shape.Banks;
  const size_t Set = size_t{Number % Sets} * Shape.Ways;
  // The tags of a set, its uses and its lines lie in different places, of which
  // the host's cache has seldom all.
  __builtin_prefetch(LastUse.data() + Set, 1);
  __builtin_prefetch(Lines.data() + Set, 1);
  const size_t Found = find(Number, Set);
  const bool Fetches = Found == None && R.Op != CacheOp::WriteWhole;
  const uint32_t Miss = Fetches ? firstMshr(OfBank) : 0;
  if (Fetches && MshrFreeAt[Miss] == Open)
    return false;

  Bank &B = Banks[OfBank];
  const uint64_t At = std::max(R.Now, B.FreeAt);
  Counted.BankCycles += At - R.Now;
  B.FreeAt = At + 1 + R.Extra;
  const bool IsRead = R.Op == CacheOp::Read;
  const bool IsWrite = R.Op == CacheOp::Write || R.Op == CacheOp::WriteWhole;
  ++(IsRead ? Counted.Reads : IsWrite ? Counted.Writes : Counted.Atomics);
  const uint64_t Marks = (IsRead ? 0 : Dirty) | (R.Keep ? Kept : 0);
  if (Found != None) {
    Line &L = Lines[Found];
    LastUse[Found] = ++Uses | (LastUse[Found] & ~OrderMask) | Marks;
    ++(L.ReadyAt > At ? Counted.Merged : Counted.Hits);
    const uint32_t Plus = Shape.HitCycles + R.Extra + R.Back;
    if (IsWrite)
      // A write is taken when the bank has it; who wrote does not wait.
      Answer = At + Shape.HitCycles / 2 + R.Back;
    else if (L.ReadyAt != Open)
      Answer = std::max(At, L.ReadyAt) + Plus;
    else
      Mshrs[L.Miss].Waiting.push_back({R.From, At, Plus});
    return true;
  }

  const size_t Way = victim(Set);
  Line &V = Lines[Way];
  if (LastUse[Way] & Dirty) {
    ++Counted.Writebacks;
    Below.writeBack(At, (Tags[Way] - 1) * TimingLineBytes);
  }
  Tags[Way] = Number + 1;
  V = {At, Miss};
  LastUse[Way] = ++Uses | Marks;
  const uint64_t Begin = Fetches ? std::max(At, MshrFreeAt[Miss]) : At;
  if (Fetches) {
    Counted.MshrCycles += Begin - At;
    // A miss that waits for an MSHR holds up its bank.
    B.FreeAt = Begin + 1 + R.Extra;
    Mshr &M = Mshrs[Miss];
    M.Line = Way;
    // The tags have been looked up before the request goes down.
    V.ReadyAt =
        Below.fetch(Begin + Shape.HitCycles / 2, R.Address, R.Keep, Miss)
            .value_or(Open);
    MshrFreeAt[Miss] = V.ReadyAt;
  }
  const uint32_t Plus =
      Shape.HitCycles - Shape.HitCycles / 2 + R.Extra + R.Back;
  if (IsWrite)
    Answer = Begin + Shape.HitCycles / 2 + R.Back;
  else if (V.ReadyAt != Open)
    Answer = V.ReadyAt + Plus;
  else
    Mshrs[Miss].Waiting.push_back({R.From, 0, Plus});
  return true;
}

void Cache::fill(uint32_t Miss, uint64_t Then, std::vector<Answer> &Answers) {
  Mshr &M = Mshrs[Miss];
  MshrFreeAt[Miss] = Then;
  // It may have been replaced already.
  if (Line &L = Lines[M.Line]; L.ReadyAt == Open && L.Miss == Miss)
    L.ReadyAt = Then;
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
  for (size_t N = 0; N != Lines.size(); ++N)
    if (LastUse[N] & Dirty) {
      ++Counted.Writebacks;
      Below.writeBack(Sent[(Tags[N] - 1) % Shape.Banks]++,
                      (Tags[N] - 1) * TimingLineBytes);
    }
  std::ranges::fill(Lines, Line());
  std::ranges::fill(LastUse, 0);
  std::ranges::fill(Tags, 0);
  return *std::max_element(Sent.begin(), Sent.end());
}

} // namespace vorion::isasim
