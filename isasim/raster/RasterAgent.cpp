#include "raster/RasterAgent.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <utility>

namespace vorion::raster {

/// The per-lane descriptor CSRs are the words of a record, in its order.
static constexpr unsigned GaussianWords = sizeof(Gaussian) / 4;
static_assert(static_cast<unsigned>(Csr::GTag) -
                  static_cast<unsigned>(Csr::GMeanX) + 1 ==
              GaussianWords);

static bool isGaussianWord(Csr C) { return C >= Csr::GMeanX && C <= Csr::GTag; }

static unsigned gaussianWord(Csr C) {
  return static_cast<unsigned>(C) - static_cast<unsigned>(Csr::GMeanX);
}

/// The CSRs of a handed-over Gaussian are the first words of GradientSums.
static_assert(static_cast<unsigned>(Csr::GradSyy) -
                  static_cast<unsigned>(Csr::GradTag) + 1 <=
              sizeof(GradientSums) / 4);

static bool isGradientWord(Csr C) {
  return C >= Csr::GradTag && C <= Csr::GradSyy;
}

static unsigned lastLane(uint32_t Mask) {
  return 31U - static_cast<unsigned>(std::countl_zero(Mask));
}

const CsrInfo *findCsr(unsigned Number) {
  const CsrInfo *Found = isasim::findCsrInfo(Number);
  return Found && Found->Raster ? Found : nullptr;
}

RasterAgent::RasterAgent(const AgentConfig &Sizes) : Config(Sizes) {
  assert(Config.Lanes >= 1 && Config.Lanes <= 32 && Config.QueueDepth >= 1);
  Staging.resize(Config.Lanes);
  PixelIndex.resize(Config.Lanes);
}

const AgentState *RasterAgent::state() const {
  return isBusy() || !Batches.empty() ? nullptr : this;
}

bool RasterAgent::setState(AgentState State) {
  assert(state());
  if (State.Staging.size() != Config.Lanes ||
      State.PixelIndex.size() != Config.Lanes ||
      State.PushBuffer.size() > VR_MAX_PUSHED ||
      State.Shown.Count > VR_GRAD_LANES)
    return false;
  static_cast<AgentState &>(*this) = std::move(State);
  return true;
}

uint32_t RasterAgent::readCounter(Csr C) const {
  for (const CounterWords &W : CounterTable) {
    if (C == W.Low)
      return static_cast<uint32_t>(Totals.*W.Value);
    if (C == W.High)
      return static_cast<uint32_t>(Totals.*W.Value >> 32);
  }
  assert(false && "not a counter");
  return 0;
}

uint32_t RasterAgent::read(Csr C, unsigned Lane) {
  assert(Lane < Config.Lanes);
  if (const auto Word = bankWord(C))
    return Bank.*Word;
  if (isGaussianWord(C)) {
    uint32_t Word = 0;
    std::memcpy(&Word,
                reinterpret_cast<const char *>(&Staging[Lane]) +
                    4 * gaussianWord(C),
                4);
    return Word;
  }
  if (isGradientWord(C))
    return itemWord(
        static_cast<unsigned>(C) - static_cast<unsigned>(Csr::GradTag), Lane);
  const auto OfPixel = [&](float Pixel::*Part) -> uint32_t {
    // Outside the tile, and before there is one, a pixel reads as 0.
    const uint32_t Index = PixelIndex[Lane];
    return Index < Drained.size()
               ? std::bit_cast<uint32_t>(Drained[Index].*Part)
               : 0;
  };
  switch (C) {
  case Csr::Status:
    return StatusBusy.put(isBusy()) | StatusTail.put(Tails != 0) |
           StatusCode.put(FirstFailure);
  case Csr::Wait: {
    assert(!isBusy() && "a read of vr_wait stalls while commands are queued");
    const uint32_t Code = FirstFailure;
    FirstFailure = VR_OK;
    return Code;
  }
  case Csr::GradNext:
    return takeBatch();
  case Csr::Start:
  case Csr::Push:
    return 0;
  case Csr::Index:
    return Index;
  case Csr::Word: {
    const auto Word = indexedWord(Index);
    return Word ? Bank.*Word : 0;
  }
  case Csr::Item:
    return itemWord(Index, Lane);
  case Csr::PixelIndex:
    return PixelIndex[Lane];
  case Csr::PixelR:
    return OfPixel(&Pixel::R);
  case Csr::PixelG:
    return OfPixel(&Pixel::G);
  case Csr::PixelB:
    return OfPixel(&Pixel::B);
  case Csr::PixelT:
    return OfPixel(&Pixel::T);
  default:
    return readCounter(C);
  }
}

bool RasterAgent::canTakeBatch() const {
  return !Batches.empty() ||
         std::none_of(Queue.begin(), Queue.end(),
                      [](const Command &C) { return C.handsOver(); });
}

uint32_t RasterAgent::takeBatch() {
  Shown = {};
  if (!Batches.empty()) {
    Shown = Batches.front();
    Batches.pop_front();
    WaitingBatches -= Shown.Count != 0;
  }
  return GradNextCount.put(Shown.Count) | GradNextBatch.put(Shown.Number);
}

uint32_t RasterAgent::itemWord(uint32_t Number, unsigned Lane) const {
  return Lane < Shown.Count && Number < ItemWords ? Shown.Items[Lane][Number]
                                                  : 0;
}

void RasterAgent::offer(const Batch &Offered) {
  assert(Offered.Count == 0 || hasRoom());
  WaitingBatches += Offered.Count != 0;
  Batches.push_back(Offered);
}

void RasterAgent::readLanes(Csr C, uint32_t Mask,
                            std::span<uint32_t> LaneValues) {
  if (Mask == 0)
    return;
  const CsrInfo *Info = findCsr(static_cast<unsigned>(C));
  const uint32_t ForAll = Info->Uniform ? read(C, lastLane(Mask)) : 0;
  for (uint32_t Rest = Mask; Rest != 0; Rest &= Rest - 1) {
    const auto Lane = static_cast<unsigned>(std::countr_zero(Rest));
    LaneValues[Lane] = Info->Uniform ? ForAll : read(C, Lane);
  }
}

void RasterAgent::write(Csr C, std::span<const uint32_t> LaneValues,
                        uint32_t Mask) {
  assert(Mask != 0 && lastLane(Mask) < Config.Lanes);
  const CsrInfo *Info = findCsr(static_cast<unsigned>(C));
  switch (Info->Rule) {
  case WriteRule::None:
    assert(false && "a write of a read-only CSR traps");
    return;
  case WriteRule::Push:
    return push(Mask);
  case WriteRule::Scalar:
    return writeScalar(C, LaneValues[lastLane(Mask)]);
  case WriteRule::Lane:
    for (uint32_t Rest = Mask; Rest != 0; Rest &= Rest - 1) {
      const auto Lane = static_cast<unsigned>(std::countr_zero(Rest));
      if (isGaussianWord(C))
        std::memcpy(reinterpret_cast<char *>(&Staging[Lane]) +
                        4 * gaussianWord(C),
                    &LaneValues[Lane], 4);
      else
        PixelIndex[Lane] = LaneValues[Lane];
    }
    return;
  }
}

void RasterAgent::writeScalar(Csr C, uint32_t Value) {
  if (C == Csr::Start)
    return start();
  if (C == Csr::Index) {
    Index = Value;
    return;
  }
  if (const auto Word = C == Csr::Word ? indexedWord(Index) : bankWord(C))
    Bank.*Word = Value;
}

void RasterAgent::push(uint32_t Mask) {
  for (; Mask != 0; Mask &= Mask - 1) {
    if (PushBuffer.size() == VR_MAX_PUSHED) {
      PushOverflowed = true;
      return;
    }
    PushBuffer.push_back(
        Staging[static_cast<unsigned>(std::countr_zero(Mask))]);
  }
}

void RasterAgent::start() {
  assert(canStart() && "a write of vr_start stalls while the queue is full");
  Queue.push_back({Bank, {}, false});
  // Without the mode, what was pushed waits for a command that takes it.
  if (ModePushed.get(Bank.Mode)) {
    Queue.back().Pushed = std::exchange(PushBuffer, {});
    Queue.back().PushOverflowed = std::exchange(PushOverflowed, false);
  }
}

void RasterAgent::finish(uint32_t Status, const Counters &Work) {
  Totals += Work;
  if (FirstFailure == VR_OK)
    FirstFailure = Status;
}

void RasterAgent::complete(uint32_t Status, const Counters &Work) {
  assert(hasCommand());
  Queue.pop_front();
  finish(Status, Work);
}

void RasterAgent::handOver(const Counters &Work) {
  complete(VR_OK, Work);
  ++Tails;
}

void RasterAgent::completeTail(uint32_t Status, const Counters &Work) {
  assert(Tails != 0);
  --Tails;
  finish(Status, Work);
}

} // namespace vorion::raster
