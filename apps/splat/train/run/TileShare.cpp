#include "train/run/TileShare.h"

#include "render/Pipeline.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace vorion::splat {

namespace {

/// The loss of so many pixels and its gradient take as long on the host as so
/// many entries of lists, blended forward and back: 95 ms and 290 ms of
/// desk_colmap at half its size, whose lists have 85 entries on average.
constexpr uint64_t TilePixels = 256, EntriesPerTile = 30;

} // namespace

std::vector<uint32_t> balancedRows(const std::vector<uint64_t> &Work,
                                   unsigned Processes) {
  const uint64_t All = std::accumulate(Work.begin(), Work.end(), uint64_t{0});
  std::vector<uint32_t> First{0};
  uint64_t Before = 0; // work of the rows before
  uint32_t Row = 0;
  for (unsigned Process = 1; Process < Processes; ++Process) {
    // A row belongs where its middle is.
    while (Row < Work.size() &&
           (2 * Before + Work[Row]) * Processes <= 2 * All * Process)
      Before += Work[Row++];
    First.push_back(Row);
  }
  First.push_back(static_cast<uint32_t>(Work.size()));
  return First;
}

void TileShare::keepOwn(const Frame &F, uint32_t TileHeight) {
  if (!Processes.allSucceeded(Launch))
    return;
  const uint32_t Across = F.View.tiles[0], Down = F.View.tiles[1];
  std::vector<std::array<uint32_t, 2>> Ranges(F.tiles());
  Launch.read("tile ranges", Ranges.data(), F.Ranges, 8 * Ranges.size());
  // Lists follow each other in the order of tiles.
  std::vector<uint64_t> Pairs{0}, Work;
  for (uint32_t Row = 0; Row < Down; ++Row) {
    uint64_t Entries = 0;
    for (uint32_t Tile = Row * Across; Tile < (Row + 1) * Across; ++Tile)
      Entries += Ranges[Tile][1] - Ranges[Tile][0];
    Pairs.push_back(Pairs.back() + Entries);
    const uint64_t Pixels = uint64_t{F.View.size[0]} * TileHeight;
    Work.push_back(Entries + Pixels * EntriesPerTile / TilePixels);
  }
  const std::vector<uint32_t> First = balancedRows(Work, Processes.size());
  FirstRows.clear();
  FirstPairs.clear();
  for (const uint32_t Row : First) {
    FirstRows.push_back(std::min(Row * TileHeight, F.View.size[1]));
    FirstPairs.push_back(Pairs[Row]);
  }
  const uint32_t Begin = First[Processes.rank()] * Across,
                 End = First[Processes.rank() + 1] * Across;
  for (uint32_t Tile = 0; Tile < Ranges.size(); ++Tile)
    if (Tile < Begin || Tile >= End)
      Ranges[Tile] = {};
  Launch.write("tile ranges", F.Ranges, Ranges.data(), 8 * Ranges.size());
}

void TileShare::completePixels(const Frame &F) {
  if (!Processes.allSucceeded(Launch))
    return;
  const std::size_t RowWords = std::size_t{4} * F.View.size[0];
  Copied.resize(RowWords * F.View.size[1]);
  const PixelRows Own = ownRows();
  Launch.read("pixels", Copied.data() + RowWords * Own.First, F.Pixels,
              4 * RowWords * (Own.End - Own.First), 4 * RowWords * Own.First);
  for (unsigned From = 0; From < Processes.size(); ++From) {
    const PixelRows Theirs = rowsOf(From);
    Processes.share(From, Copied.data() + RowWords * Theirs.First,
                    4 * RowWords * (Theirs.End - Theirs.First));
  }
  Launch.write("pixels", F.Pixels, Copied.data(), 4 * Copied.size());
}

void TileShare::completePairs(const Frame &F, const cl::Buffer &Sums,
                              uint32_t Words) {
  if (!Processes.allSucceeded(Launch))
    return;
  const uint64_t Pairs = FirstPairs.back();
  Places.resize(Pairs);
  Launch.read("places of sorted pairs", Places.data(), F.ByTile.Values,
              4 * Pairs);
  // In the order of lists, where a process's pairs are side by side.
  Copied.resize(Words * Pairs);
  Launch.readInPlace("pairs' sums", Sums, Copied.size(),
                     [&](std::span<const float> From) {
                       for (uint64_t I = FirstPairs[Processes.rank()];
                            I < FirstPairs[Processes.rank() + 1]; ++I)
                         std::copy_n(&From[uint64_t{Words} * Places[I]], Words,
                                     &Copied[Words * I]);
                     });
  for (unsigned From = 0; From < Processes.size(); ++From)
    Processes.share(From, Copied.data() + Words * FirstPairs[From],
                    4 * Words * (FirstPairs[From + 1] - FirstPairs[From]));
  Launch.writeInPlace("pairs' sums", Sums, Copied.size(),
                      [&](std::span<float> To) {
                        for (uint64_t I = 0; I < Pairs; ++I)
                          std::copy_n(&Copied[Words * I], Words,
                                      &To[uint64_t{Words} * Places[I]]);
                      });
}

void TileShare::completeStrips(std::span<float> Values, uint32_t Planes,
                               uint32_t Strips, uint32_t Height) {
  if (!Processes.allSucceeded(Launch))
    return;
  const std::size_t Words = Values.size() / Planes / Strips; // of a strip
  const auto StripsBefore = [&](uint32_t Row) {
    return (Row + Height - 1) / Height;
  };
  for (unsigned From = 0; From < Processes.size(); ++From) {
    const PixelRows Theirs = rowsOf(From);
    const uint32_t First = StripsBefore(Theirs.First),
                   End = StripsBefore(Theirs.End);
    for (std::size_t Plane = 0; Plane < Planes; ++Plane)
      Processes.share(From, Values.data() + (Plane * Strips + First) * Words,
                      4 * Words * (End - First));
  }
}

} // namespace vorion::splat
