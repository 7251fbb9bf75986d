#include "machine/RasterUnits.h"

#include "core/Isa.h"
#include "machine/ByteStream.h"

#include <algorithm>
#include <array>

namespace vorion::isasim {

namespace {

/// Writes or reads an agent's state.
template <typename Stream, typename State> void exchange(Stream &S, State &A) {
  S.value(A.Bank);
  S.list(A.Staging);
  S.list(A.PushBuffer);
  S.flag(A.PushOverflowed);
  S.list(A.PixelIndex);
  S.list(A.Drained);
  S.value(A.Shown);
  S.value(A.Index);
  S.value(A.FirstFailure);
  S.value(A.Totals);
}

} // namespace

RasterUnits::RasterUnits(const Config &C, Memory &Storage,
                         std::function<bool()> IsOver)
    : Shape(C), View(Storage, std::move(IsOver)) {
  reset();
}

void RasterUnits::reset() {
  PixelUnits.clear();
  Units.clear();
  Agents.clear();
  for (unsigned Core = 0; Core != Shape.cores(); ++Core)
    Agents.push_back(std::make_unique<raster::RasterAgent>(raster::AgentConfig{
        Shape.LanesPerWarp, Shape.Raster.QueueDepth, Core}));
  for (unsigned Socket = 0; Socket != Shape.sockets(); ++Socket) {
    std::vector<raster::RasterAgent *> Own;
    for (unsigned N = 0; N != Shape.CoresPerSocket; ++N)
      Own.push_back(Agents[Socket * Shape.CoresPerSocket + N].get());
    Units.push_back(std::make_unique<raster::Rasterizer>(View, Own));
  }
  for (unsigned Cluster = 0; Cluster != Shape.Clusters; ++Cluster)
    PixelUnits.push_back(std::make_unique<pixel::PixelUnit>(View));
  setLog(Log);
}

std::optional<std::vector<std::byte>> RasterUnits::state() const {
  ByteWriter W;
  for (const auto &A : Agents) {
    const raster::AgentState *State = A->state();
    if (!State)
      return std::nullopt;
    exchange(W, *State);
  }
  for (const auto &U : Units)
    W.value(uint64_t{U->turn()});
  return W.bytes();
}

bool RasterUnits::setState(std::span<const std::byte> State) {
  reset();
  ByteReader R(State);
  bool Fits = true;
  for (const auto &A : Agents) {
    raster::AgentState Read;
    exchange(R, Read);
    Fits = Fits && A->setState(std::move(Read));
  }
  for (const auto &U : Units) {
    uint64_t Turn = 0;
    R.value(Turn);
    Fits = Fits && U->setTurn(Turn);
  }
  if (!Fits || !R.atEnd())
    reset();
  return Fits && R.atEnd();
}

void RasterUnits::setLog(raster::WorkLog *Receiver) {
  Log = Receiver;
  for (const auto &U : Units)
    U->setLog(Log);
  for (const auto &U : PixelUnits)
    U->setLog(Log);
}

bool RasterUnits::access(unsigned Core, WarpState *S, const CsrAccess &A) {
  raster::RasterAgent &Agent = *Agents[Core];
  const auto C = static_cast<raster::Csr>(A.Number);
  if ((A.Writes && C == raster::Csr::Start && !Agent.canStart()) ||
      (A.Reads && C == raster::Csr::Wait && Agent.isBusy()) ||
      (A.Reads && C == raster::Csr::GradNext && !Agent.canTakeBatch()))
    return false;
  std::array<uint32_t, MaxLanes> Old{}, New{};
  if (A.Reads)
    Agent.readLanes(C, S->Mask, std::span(Old).first(Shape.LanesPerWarp));
  if (A.Writes) {
    for (unsigned L = 0; L != Shape.LanesPerWarp; ++L)
      New[L] = A.combine(Old[L], A.operand(S, L));
    Agent.write(C, std::span(New).first(Shape.LanesPerWarp), S->Mask);
  }
  uint32_t *Rd = S->lanes(S->Next->Rd);
  for (unsigned L = 0; L != Shape.LanesPerWarp; ++L)
    if (S->Mask >> L & 1)
      Rd[L] = Old[L];
  return true;
}

bool RasterUnits::canRun() const {
  return std::any_of(Units.begin(), Units.end(),
                     [](const auto &U) { return U->canStep(); });
}

void RasterUnits::runUnit(unsigned N) {
  while (Units[N]->step() && Units[N]->hasRoomInLog()) {
  }
}

void RasterUnits::finishUnit(unsigned N) {
  while (Units[N]->step()) {
  }
}

void RasterUnits::handOver() {
  for (unsigned Socket = 0; Socket != Shape.sockets(); ++Socket) {
    const auto Handed = Units[Socket]->takeHandOvers();
    PixelUnits[Socket / Shape.SocketsPerCluster]->accept(Handed);
  }
}

bool RasterUnits::canRunPixelUnits() const {
  return std::any_of(PixelUnits.begin(), PixelUnits.end(),
                     [](const auto &U) { return U->canStep(); });
}

void RasterUnits::runPixelUnit(unsigned N) {
  while (PixelUnits[N]->step() && PixelUnits[N]->hasRoomInLog()) {
  }
}

std::optional<uint32_t> RasterUnits::hostRead(unsigned Core, unsigned Number) {
  if (Core >= Agents.size() || !raster::findCsr(Number))
    return std::nullopt;
  // A backward command may have halted until its batches are taken.
  const auto C = static_cast<raster::Csr>(Number);
  if (C == raster::Csr::Wait && Agents[Core]->isBusy())
    return std::nullopt;
  const uint32_t Value = Agents[Core]->read(C, 0);
  if (C == raster::Csr::GradNext)
    finishUnit(Shape.socketOf(Core));
  return Value;
}

bool RasterUnits::hostWrite(unsigned Core, unsigned Number, uint32_t Value) {
  const CsrInfo *Info = raster::findCsr(Number);
  if (Core >= Agents.size() || !Info || Info->Rule == WriteRule::None)
    return false;
  if (Number == static_cast<unsigned>(raster::Csr::Start) &&
      !Agents[Core]->canStart())
    return false;
  std::array<uint32_t, MaxLanes> Lanes{};
  Lanes[0] = Value;
  Agents[Core]->write(static_cast<raster::Csr>(Number),
                      std::span(Lanes).first(Shape.LanesPerWarp), 1);
  finishUnit(Shape.socketOf(Core));
  handOver();
  const auto &Pixels = PixelUnits[Shape.clusterOf(Core)];
  while (Pixels->step()) {
  }
  return true;
}

RasterCounters RasterUnits::counters() const {
  RasterCounters Sum;
  for (const auto &A : Agents)
    Sum += A->counters();
  return Sum;
}

} // namespace vorion::isasim
