#include "Sorter.h"

#include "Plan.h"

#include <algorithm>

namespace vorion::splat {

namespace {
constexpr std::uint32_t Lanes = 16;
/// Digits of one pass: what a group's counters in local memory allow
/// (kernels/sort.cl, BINS).
constexpr unsigned MostDigitBits = 8;
/// Below this, a work-item's own cost (a counter a digit) outweighs its share.
constexpr std::uint32_t LeastSortChunk = 256;
constexpr std::uint32_t LeastScanChunk = 64;

std::uint32_t divideUp(std::uint32_t A, std::uint32_t B) {
  return A / B + (A % B != 0 ? 1 : 0);
}
} // namespace

Sorter::Sorter(Launcher &Launch)
    : L(Launch),
      // Two groups a core even out what the groups' contents make uneven.
      MostItems(2 * Lanes * std::max(1U, Launch.device().computeUnits())) {
  const std::uint64_t Words = std::uint64_t{MostItems} << MostDigitBits;
  Sums = L.allocate("prefix sums", 4 * std::uint64_t{MostItems});
  Histogram = L.allocate("sort's histograms", 4 * Words);
  Offsets = L.allocate("sort's offsets", 4 * (Words + 1));
}

Sorter::Share Sorter::share(std::uint32_t Count,
                            std::uint32_t LeastChunk) const {
  const std::uint32_t Chunk = std::max(LeastChunk, divideUp(Count, MostItems));
  return {divideUp(divideUp(Count, Chunk), Lanes) * Lanes, Chunk};
}

void Sorter::scan(const cl::Buffer &In, const cl::Buffer &Out,
                  std::uint32_t Count) {
  const Share S = share(Count, LeastScanChunk);
  L.run(ScanProgram, "scan_sums", S.Items, Lanes, In, Sums, Count, S.Chunk);
  L.run(ScanProgram, "scan_partials", 1, 1, Sums, S.Items);
  L.run(ScanProgram, "scan_apply", S.Items, Lanes, In, Sums, Out, Count,
        S.Chunk);
}

Sorter::Pairs Sorter::sort(const Pairs &Input, const Pairs &A, const Pairs &B,
                           std::uint32_t Count, KeyBits Bits) {
  const unsigned Width = Bits.End - Bits.First;
  if (Count == 0 || Width == 0)
    return Input;
  const unsigned Passes = divideUp(Width, MostDigitBits);
  const unsigned DigitBits = divideUp(Width, Passes);
  const std::uint32_t Digits = 1U << DigitBits;
  const Share S = share(Count, LeastSortChunk);
  Pairs From = Input;
  for (unsigned Pass = 0; Pass < Passes; ++Pass) {
    const Pairs &To = From.Keys() == A.Keys() ? B : A;
    const std::uint32_t Shift = Bits.First + Pass * DigitBits;
    L.run(SortProgram, "sort_count", S.Items, Lanes, From.Keys, Histogram,
          Count, S.Chunk, Shift, Digits);
    scan(Histogram, Offsets, Digits * S.Items);
    L.run(SortProgram, "sort_scatter", S.Items, Lanes, From.Keys, From.Values,
          Offsets, To.Keys, To.Values, Count, S.Chunk, Shift, Digits);
    From = To;
  }
  return From;
}

} // namespace vorion::splat
