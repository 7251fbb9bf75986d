#include "render/Sorter.h"

#include "kernels/scan.cl.h"
#include "kernels/sort.cl.h"
#include "render/Plan.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

namespace vorion::splat {

namespace {
/// Of one pass: as many as half an L2 slice holds open lines for, and at most
/// BINS of kernels/sort.cl.
constexpr unsigned MostDigitBits = 10;
/// Words of a cache line, which neighbouring stretches do not share.
constexpr uint32_t LineWords = 16;
/// Below this, a group's own cost outweighs its share.
constexpr uint32_t LeastChunk = 256;
constexpr uint32_t LeastScanChunk = 64;
/// Each group has a histogram of its own. Where warps of a core make more
/// groups than these, summing up the histograms costs more than the warps gain
/// (docs/ideas.md, "Warps").
constexpr unsigned MostGroupsOfWarps = 64;

uint32_t divideUp(uint32_t A, uint32_t B) {
  return A / B + (A % B != 0 ? 1 : 0);
}

constexpr unsigned WordBits = 32;
} // namespace

/// The digits that keys of \p Bits are sorted by, a pass each: equally wide,
/// but that early ones are as wide as it takes to leave \p Room bits behind as
/// few passes as can be.
std::vector<Sorter::Digit> Sorter::digits(unsigned Bits, unsigned Room) {
  const unsigned Passes = std::max(1U, divideUp(Bits, MostDigitBits));
  const unsigned Excess = Bits - std::min(Bits, Room);
  const unsigned Early = divideUp(Excess, MostDigitBits);
  std::vector<Digit> All;
  unsigned Shift = 0;
  for (unsigned Pass = 0; Pass < Passes; ++Pass) {
    const unsigned Equal = std::max(1U, divideUp(Bits - Shift, Passes - Pass));
    const unsigned Width =
        Pass < Early ? std::max(Equal, divideUp(Excess, Early)) : Equal;
    All.push_back({Shift, Width});
    Shift += Width;
  }
  return All;
}

Sorter::Sorter(Launcher &Launch)
    : Launch(Launch),
      Groups(std::max(
          {1U, Launch.device().computeUnits(),
           std::min(Launch.device().groupsAtOnce(), MostGroupsOfWarps)})) {
  constexpr uint64_t Digits = 1U << MostDigitBits;
  Histogram = Launch.allocate("sort's histograms", 4 * Digits * Groups);
  Totals = Launch.allocate("sort's totals", 4 * Digits);
  Sums = Launch.allocate("prefix sums", 4 * uint64_t{scanItems()});
}

uint32_t Sorter::scanItems() const { return 2 * LineWords * Groups; }

void Sorter::scan(const cl::Buffer &In, const cl::Buffer &Out, uint32_t Count) {
  const uint32_t Chunk = std::max(LeastScanChunk, divideUp(Count, scanItems()));
  const uint32_t Items =
      divideUp(divideUp(Count, Chunk), LineWords) * LineWords;
  Launch.run(Items, LineWords,
             kernels::scan::scan_sums{
                 .in = In, .sums = Sums, .count = Count, .chunk = Chunk});
  Launch.run(1, 1, kernels::scan::scan_partials{.sums = Sums, .count = Items});
  Launch.run(
      Items, LineWords,
      kernels::scan::scan_apply{
          .in = In, .sums = Sums, .out = Out, .count = Count, .chunk = Chunk});
}

Sorter::Share Sorter::share(uint32_t Count) const {
  const uint32_t Lines =
      divideUp(std::max(LeastChunk, divideUp(Count, Groups)), LineWords);
  return {std::max(1U, divideUp(Count, Lines * LineWords)),
          Launch.device().lanes(), Lines * LineWords};
}

bool Sorter::inOnePass(KeyBits Bits) {
  return Bits.First != Bits.End && Bits.End - Bits.First <= MostDigitBits;
}

Sorter::Pairs Sorter::sort(const Pairs &Input, const Pairs &A, const Pairs &B,
                           uint32_t Count, KeyBits Bits, Keys Wanted) {
  if (Count == 0 || Bits.First == Bits.End)
    return Input;
  Pairs From = Input;
  for (Digit D : digits(Bits.End - Bits.First, WordBits)) {
    const Pairs &To = From.Keys() == A.Keys() ? B : A;
    D.Shift += Bits.First;
    if (Wanted == Keys::Lost && D.Shift + D.Bits >= Bits.End)
      scatterToWords(From, To.Values, Count, D, WordBits);
    else
      scatter(From, To, Count, D);
    From = To;
  }
  return From;
}

void Sorter::rangesOfKeys(const cl::Buffer &Ranges, uint32_t Number) {
  const uint32_t Lanes = Launch.device().lanes();
  Launch.run(Lanes, Lanes,
             kernels::sort::sort_ranges{
                 .totals = Totals, .ranges = Ranges, .digits = Number});
}

cl::Buffer Sorter::sortKept(const cl::Buffer &From, const KeptKeys &What) {
  const auto Words = [&](const char *Of) {
    return Launch.allocate(Of, 4 * uint64_t{What.Kept});
  };
  if (What.Kept == 0)
    return Words("sorted numbers");
  const uint32_t Base = What.Least >> What.FirstBit;
  const auto KeyBits = static_cast<unsigned>(
      std::bit_width((What.Most >> What.FirstBit) - Base));
  const auto ValueBits = static_cast<unsigned>(std::bit_width(What.Count - 1));
  const std::vector<Digit> Digits = digits(KeyBits, WordBits - ValueBits);
  const auto LeavesWords = [&](const Digit &D) {
    return D.Shift + D.Bits + WordBits >= KeyBits + ValueBits;
  };
  Pairs A{{}, Words("sorted numbers")}, B{{}, Words("sorted numbers")};
  const Share S = share(What.Count);
  const Digit First{What.FirstBit, Digits.front().Bits};
  Launch.run(S.items(), S.Lanes,
             kernels::sort::sort_count_kept{.keys = From,
                                            .histogram = Histogram,
                                            .count = What.Count,
                                            .chunk = S.Chunk,
                                            .shift = First.Shift,
                                            .digit_bits = First.Bits,
                                            .base = Base});
  sumUp(S.Groups, First);
  bool InWords = LeavesWords(Digits.front());
  if (InWords) {
    Launch.run(
        S.items(), S.Lanes,
        kernels::sort::sort_scatter_kept_to_words{.keys = From,
                                                  .histogram = Histogram,
                                                  .totals = Totals,
                                                  .words_out = A.Values,
                                                  .count = What.Count,
                                                  .chunk = S.Chunk,
                                                  .shift = First.Shift,
                                                  .digit_bits = First.Bits,
                                                  .base = Base,
                                                  .value_bits = ValueBits});
  } else {
    A.Keys = Words("sorted keys");
    Launch.run(S.items(), S.Lanes,
               kernels::sort::sort_scatter_kept{.keys = From,
                                                .histogram = Histogram,
                                                .totals = Totals,
                                                .keys_out = A.Keys,
                                                .values_out = A.Values,
                                                .count = What.Count,
                                                .chunk = S.Chunk,
                                                .shift = First.Shift,
                                                .digit_bits = First.Bits,
                                                .base = Base});
  }
  for (const Digit &D : std::span(Digits).subspan(1)) {
    if (InWords) {
      scatterWords(A.Values, B.Values, What.Kept, {ValueBits, D.Bits});
    } else if (InWords = LeavesWords(D); InWords) {
      scatterToWords(A, B.Values, What.Kept, D, ValueBits);
    } else {
      if (!B.Keys())
        B.Keys = Words("sorted keys");
      scatter(A, B, What.Kept, D);
    }
    std::swap(A, B);
  }
  return A.Values;
}

void Sorter::count(const cl::Buffer &Keys, uint32_t Count, Digit D) {
  const Share S = share(Count);
  Launch.run(S.items(), S.Lanes,
             kernels::sort::sort_count{.keys = Keys,
                                       .histogram = Histogram,
                                       .count = Count,
                                       .chunk = S.Chunk,
                                       .shift = D.Shift,
                                       .digit_bits = D.Bits});
  sumUp(S.Groups, D);
}

void Sorter::sumUp(uint32_t Stretches, Digit D) {
  Launch.run(D.count(), std::min(D.count(), LineWords),
             kernels::sort::sort_offsets{.histogram = Histogram,
                                         .totals = Totals,
                                         .groups = Stretches,
                                         .digits = D.count()});
}

void Sorter::scatter(const Pairs &From, const Pairs &To, uint32_t Count,
                     Digit D) {
  count(From.Keys, Count, D);
  const Share S = share(Count);
  Launch.run(S.items(), S.Lanes,
             kernels::sort::sort_scatter{.keys = From.Keys,
                                         .values = From.Values,
                                         .histogram = Histogram,
                                         .totals = Totals,
                                         .keys_out = To.Keys,
                                         .values_out = To.Values,
                                         .count = Count,
                                         .chunk = S.Chunk,
                                         .shift = D.Shift,
                                         .digit_bits = D.Bits});
}

/// Of words whose digit lies at once above the value.
void Sorter::scatterWords(const cl::Buffer &From, const cl::Buffer &To,
                          uint32_t Count, Digit D) {
  count(From, Count, D);
  const Share S = share(Count);
  Launch.run(S.items(), S.Lanes,
             kernels::sort::sort_scatter_words{.words = From,
                                               .histogram = Histogram,
                                               .totals = Totals,
                                               .words_out = To,
                                               .count = Count,
                                               .chunk = S.Chunk,
                                               .digit_bits = D.Bits,
                                               .value_bits = D.Shift});
}

void Sorter::scatterToWords(const Pairs &From, const cl::Buffer &To,
                            uint32_t Count, Digit D, unsigned ValueBits) {
  count(From.Keys, Count, D);
  const Share S = share(Count);
  Launch.run(S.items(), S.Lanes,
             kernels::sort::sort_scatter_to_words{.keys = From.Keys,
                                                  .values = From.Values,
                                                  .histogram = Histogram,
                                                  .totals = Totals,
                                                  .words_out = To,
                                                  .count = Count,
                                                  .chunk = S.Chunk,
                                                  .shift = D.Shift,
                                                  .digit_bits = D.Bits,
                                                  .value_bits = ValueBits});
}

} // namespace vorion::splat
