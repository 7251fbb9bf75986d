#include "timing/raster/RasterLanes.h"

#include "raster/BlockTests.h"

#include <algorithm>
#include <numeric>

namespace vorion::isasim {

using raster::GaussianWork;

namespace {
/// Of the pixels of a block, where dispatch leaves blocks out.
constexpr unsigned BlockSide = raster::BlockTests::Side,
                   BlockPixels = BlockSide * BlockSide;

RasterTiming inPairs(RasterTiming P) {
  P.Lanes = std::max(1U, P.Lanes / 2);
  return P;
}
} // namespace

RasterLanes::RasterLanes(const RasterTiming &Params)
    : Timing(Params), Table(Timing), PairTable(inPairs(Timing)) {}

RasterLanes::Passage RasterLanes::passageOf(const GaussianWork &G,
                                            bool IsBackward) {
  const unsigned Lanes = IsBackward ? Timing.Lanes / 2 : Timing.Lanes;
  Passage P{(IsBackward ? PairTable : Table).cycles(G.Width, G.Height),
            G.Slots};
  // Where saturated pixels get no slot (an option), only the others are packed.
  if (G.Slots < unsigned{G.Width} * G.Height)
    P.Cycles = std::min(P.Cycles, std::max(1U, (G.Slots + Lanes - 1) / Lanes));
  if (Timing.SkipBlocks != 0 && !IsBackward) {
    P.BlockRows = (G.Y + G.Height - 1) / BlockSide - G.Y / BlockSide + 1;
    const unsigned ByBlocks = cyclesByBlocks(G, P.BlockRows);
    if (ByBlocks < P.Cycles) {
      P.Cycles = ByBlocks;
      P.Slots = std::min<unsigned>(P.Slots, G.ChosenPixels);
    }
  }
  return P;
}

/// Rows of blocks are tested one a cycle, and a block that is left takes a
/// cycle: its pixels have a bank each.
unsigned RasterLanes::cyclesByBlocks(const GaussianWork &G,
                                     unsigned Rows) const {
  const unsigned AtOnce = std::min(Timing.Lanes, Timing.Banks);
  return std::max(Rows, G.Blocks * ((BlockPixels + AtOnce - 1) / AtOnce));
}

/// The earliest start at which every pixel that is still being updated has its
/// new value when it is read again. Within a box pixels go out at a steady pace
/// in row order, so that the corners of what two boxes share decide.
uint64_t RasterLanes::safeAt(const GaussianWork &G, unsigned Cycles,
                             uint64_t Earliest) const {
  uint64_t Safe = Earliest;
  const auto When = [](const GaussianWork &B, unsigned Pace, unsigned X,
                       unsigned Y) {
    return static_cast<int64_t>(((Y - B.Y) * B.Width + (X - B.X)) * Pace /
                                (unsigned{B.Width} * B.Height));
  };
  for (const Dispatched &D : Inside) {
    if (D.Cycles == 0 || D.Start + D.Cycles + Timing.UpdateCycles <= Earliest)
      continue;
    const GaussianWork &B = D.What;
    const unsigned X0 = std::max(B.X, G.X), Y0 = std::max(B.Y, G.Y);
    const unsigned X1 = std::min(B.X + B.Width, G.X + G.Width);
    const unsigned Y1 = std::min(B.Y + B.Height, G.Y + G.Height);
    if (X0 >= X1 || Y0 >= Y1)
      continue;
    for (const unsigned X : {X0, X1 - 1})
      for (const unsigned Y : {Y0, Y1 - 1}) {
        const int64_t Start = static_cast<int64_t>(D.Start) +
                              When(B, D.Cycles, X, Y) + Timing.UpdateCycles -
                              When(G, Cycles, X, Y);
        Safe =
            std::max(Safe, static_cast<uint64_t>(std::max<int64_t>(Start, 0)));
      }
  }
  return Safe;
}

void RasterLanes::enter(const GaussianWork &G, uint64_t Start,
                        unsigned Cycles) {
  Inside[Next] = {G, Start, Cycles};
  Next = (Next + 1) % Recent;
}

LaneWork &LaneWork::operator+=(const LaneWork &Other) {
  for (size_t N = 0; N != Evaluated.size(); ++N)
    Evaluated[N] += Other.Evaluated[N];
  for (size_t N = 0; N != Blended.size(); ++N)
    Blended[N] += Other.Blended[N];
  Gradients += Other.Gradients;
  RayGradients += Other.RayGradients;
  LowPassed += Other.LowPassed;
  SurfelGradients += Other.SurfelGradients;
  for (size_t N = 0; N != Covered.size(); ++N)
    Covered[N] += Other.Covered[N];
  Passed += Other.Passed;
  Moved += Other.Moved;
  RangeWords += Other.RangeWords;
  BlockRows += Other.BlockRows;
  return *this;
}

uint64_t LaneWork::allBlended() const {
  return std::accumulate(Blended.begin(), Blended.end(), uint64_t{0});
}

uint64_t LaneWork::allCovered() const {
  return std::accumulate(Covered.begin(), Covered.end(), uint64_t{0});
}

} // namespace vorion::isasim
