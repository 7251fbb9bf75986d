#include "timing/core/InstructionCache.h"

#include <algorithm>
#include <utility>

namespace vorion::isasim {

InstructionCache::InstructionCache(const SocketTiming &Params,
                                   MemoryPort ToMemory)
    : Port(ToMemory), WaysOfSet(Params.IcacheWays),
      Sets(Params.IcacheKib * 1024 / TimingLineBytes / WaysOfSet),
      Ways(size_t{Sets} * WaysOfSet) {}

void InstructionCache::begin(uint32_t Low, uint32_t Lines) {
  CodeLow = Low & ~(TimingLineBytes - 1);
  CodeLines = Lines;
  std::ranges::fill(Ways, Way());
  // A run does not end before its fetches have been answered.
  Asked.clear();
  Misses = 0;
}

void InstructionCache::fill(uint32_t Line, const Arrival &Then) {
  Way *Set = setOf(Line);
  *std::min_element(Set, Set + WaysOfSet, [](const Way &A, const Way &B) {
    return A.Used < B.Used;
  }) = {Line + 1, ++Uses, Then};
}

std::optional<Arrival> InstructionCache::fetch(MemorySystem &Memory,
                                               uint32_t Line, uint64_t Now,
                                               Waiter Who) {
  Way *Set = setOf(Line);
  for (Way *W = Set; W != Set + WaysOfSet; ++W)
    if (W->Number == Line + 1) {
      W->Used = ++Uses;
      return W->Ready.At > Now ? W->Ready : Arrival{Now};
    }
  for (Arrived &A : Asked)
    if (A.Line == Line && !A.Who.empty()) {
      A.Who.push_back(Who);
      return std::nullopt;
    }
  ++Misses;
  // As many as there are warps, at most.
  auto Free = std::ranges::find_if(
      Asked, [](const Arrived &A) { return A.Who.empty(); });
  if (Free == Asked.end())
    Free = Asked.insert(Free, Arrived());
  const auto Tag = static_cast<uint32_t>(Free - Asked.begin());
  const auto Then =
      Memory.access(Port, {.Now = Now,
                           .Address = CodeLow + Line * TimingLineBytes,
                           .From = {Port.Unit, Tag}});
  if (Then)
    fill(Line, *Then);
  else
    *Free = {Line, {Who}};
  return Then;
}

InstructionCache::Arrived InstructionCache::answer(const Answer &A) {
  Arrived &Of = Asked[A.To.Tag];
  fill(Of.Line, A.arrival());
  return {Of.Line, std::exchange(Of.Who, {})};
}

bool InstructionCache::keeps(uint32_t Line) const {
  const uint32_t OfSet = (CodeLines - 1 - Line % Sets) / Sets + 1;
  return OfSet <= WaysOfSet;
}

} // namespace vorion::isasim
