#include "render/Sorter.h"

#include "render/Plan.h"

#include <algorithm>
#include <bit>

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

uint32_t divideUp(uint32_t A, uint32_t B) {
  return A / B + (A % B != 0 ? 1 : 0);
}

/// Passes of equal width.
struct Passes {
  explicit Passes(unsigned Bits)
      : Number(std::max(1U, divideUp(Bits, MostDigitBits))),
        DigitBits(std::max(1U, divideUp(Bits, Number))),
        Digits(1U << DigitBits) {}
  unsigned Number, DigitBits;
  uint32_t Digits;
};
} // namespace

Sorter::Sorter(Launcher &Launch)
    : Launch(Launch), Groups(std::max(1U, Launch.device().computeUnits())) {
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
  Launch.run(ScanProgram, "scan_sums", Items, LineWords, In, Sums, Count,
             Chunk);
  Launch.run(ScanProgram, "scan_partials", 1, 1, Sums, Items);
  Launch.run(ScanProgram, "scan_apply", Items, LineWords, In, Sums, Out, Count,
             Chunk);
}

Sorter::Share Sorter::share(uint32_t Count) const {
  const uint32_t Lines =
      divideUp(std::max(LeastChunk, divideUp(Count, Groups)), LineWords);
  return {std::max(1U, divideUp(Count, Lines * LineWords)),
          Launch.device().lanes(), Lines * LineWords};
}

Sorter::Pairs Sorter::sort(const Pairs &Input, const Pairs &A, const Pairs &B,
                           uint32_t Count, KeyBits Bits) {
  if (Count == 0 || Bits.First == Bits.End)
    return Input;
  const Passes P(Bits.End - Bits.First);
  Pairs From = Input;
  for (unsigned Pass = 0; Pass < P.Number; ++Pass) {
    const Pairs &To = From.Keys() == A.Keys() ? B : A;
    pass(From, To, Count, Bits.First + Pass * P.DigitBits, P.Digits);
    From = To;
  }
  return From;
}

cl::Buffer Sorter::sortKept(const cl::Buffer &Keys, const KeptKeys &What,
                            const Pairs &A, const Pairs &B) {
  if (What.Kept == 0)
    return A.Values;
  const uint32_t Base = What.Least >> What.FirstBit;
  const Passes P(static_cast<unsigned>(
      std::bit_width((What.Most >> What.FirstBit) - Base)));
  const Share S = share(What.Count);
  Launch.run(SortProgram, "sort_count_kept", S.items(), S.Lanes, Keys,
             Histogram, What.Count, S.Chunk, What.FirstBit, P.Digits, Base);
  Launch.run(SortProgram, "sort_offsets", P.Digits,
             std::min(P.Digits, LineWords), Histogram, Totals, S.Groups,
             P.Digits);
  Launch.run(SortProgram, "sort_scatter_kept", S.items(), S.Lanes, Keys,
             Histogram, Totals, A.Keys, A.Values, What.Count, S.Chunk,
             What.FirstBit, P.Digits, Base);
  Pairs From = A;
  for (unsigned Pass = 1; Pass < P.Number; ++Pass) {
    const Pairs &To = From.Keys() == A.Keys() ? B : A;
    pass(From, To, What.Kept, Pass * P.DigitBits, P.Digits);
    From = To;
  }
  return From.Values;
}

void Sorter::pass(const Pairs &From, const Pairs &To, uint32_t Count,
                  unsigned Shift, uint32_t Digits) {
  const Share S = share(Count);
  Launch.run(SortProgram, "sort_count", S.items(), S.Lanes, From.Keys,
             Histogram, Count, S.Chunk, Shift, Digits);
  Launch.run(SortProgram, "sort_offsets", Digits, std::min(Digits, LineWords),
             Histogram, Totals, S.Groups, Digits);
  Launch.run(SortProgram, "sort_scatter", S.items(), S.Lanes, From.Keys,
             From.Values, Histogram, Totals, To.Keys, To.Values, Count, S.Chunk,
             Shift, Digits);
}

} // namespace vorion::splat
