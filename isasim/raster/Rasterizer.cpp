#include "raster/Rasterizer.h"

#include "raster/Datapath.h"

#include <bit>
#include <cfenv>
#include <cmath>
#include <cstring>
#include <limits>

namespace vorion::raster {

namespace {

/// fp32 with default rounding whatever the core was doing on this host thread,
/// and none of our exceptions in its fcsr.
class DefaultFloatEnvironment {
public:
  DefaultFloatEnvironment() {
    std::fegetenv(&Saved);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatEnvironment() { std::fesetenv(&Saved); }
  DefaultFloatEnvironment(const DefaultFloatEnvironment &) = delete;
  DefaultFloatEnvironment &operator=(const DefaultFloatEnvironment &) = delete;

private:
  std::fenv_t Saved;
};

constexpr unsigned PixelBytes = sizeof(Pixel);

std::byte *rangeAt(RasterMemory &Memory, std::uint64_t Addr,
                   std::uint64_t Bytes) {
  return Addr <= std::numeric_limits<std::uint32_t>::max()
             ? Memory.range(static_cast<std::uint32_t>(Addr), Bytes)
             : nullptr;
}

bool hasNan(const Gaussian &G) {
  const float Floats[] = {G.Mean[0],  G.Mean[1],   G.Conic[0], G.Conic[1],
                          G.Conic[2], G.Opacity,   G.Color[0], G.Color[1],
                          G.Color[2], G.Extent[0], G.Extent[1]};
  bool Found = false;
  for (const float F : Floats)
    Found |= std::isnan(F);
  return Found;
}

/// One command in the works: decoded, checked, executed.
class Execution {
public:
  Execution(const Command &Configured, RasterMemory &Global, TileBuffer &Buffer,
            const Datapath &Unit)
      : C(Configured), Memory(Global), Tile(Buffer), Lanes(Unit),
        Width(TileShapeWidth.get(C.TileShape)),
        Height(TileShapeHeight.get(C.TileShape)),
        Drains(ModeDrain.get(C.Mode) != 0), Takes(ModePushed.get(C.Mode) != 0) {
  }

  /// Returns a status code; \p Drained gets the pixels of a draining command.
  std::uint32_t run(std::vector<Pixel> &Drained);

  const Counters &work() const { return Work; }

  /// Keeps the details of the work too.
  void keepWork() { Keeps = true; }
  CommandWork takeWork(std::uint32_t Status);

private:
  std::uint32_t check() const;
  std::uint32_t blendList();
  const std::byte *record(const std::byte *List, std::uint32_t Entry) const;
  /// \p Address: of the record, 0 if it was pushed.
  std::uint32_t blendOne(const Gaussian &G, std::uint32_t Address,
                         const BlendOptions &Options);
  BlendOptions blendOptions() const;
  std::uint64_t rowAddress(unsigned Row) const {
    return C.Output + std::uint64_t{Row} * C.OutputPitch;
  }
  void copyRow(unsigned Row, std::byte *To) const;

  const Command &C;
  RasterMemory &Memory;
  TileBuffer &Tile;
  const Datapath &Lanes;
  unsigned Width;
  unsigned Height;
  bool Drains;
  bool Takes; ///< pushed descriptors instead of a list
  Counters Work;
  bool Keeps = false;
  std::vector<GaussianWork> Kept;
};

/// The order of these checks is the order of docs/rasterizer.md#status-codes.
std::uint32_t Execution::check() const {
  const std::uint32_t KnownMode = ModePushed.put(1) | ModeDrain.put(1);
  const std::uint32_t KnownOptions = OptionsExp.put(OptionsExp.mask()) |
                                     OptionsStopAtEqual.put(1) |
                                     OptionsSkipSaturated.put(1);
  const std::uint32_t Parts = ZtileCount.get(C.Ztile);
  if ((C.Mode & ~KnownMode) != 0 || (C.Options & ~KnownOptions) != 0 ||
      OptionsExp.get(C.Options) >= ExpUnitCount ||
      ZtileIndex.get(C.Ztile) >= (Parts == 0 ? 1 : Parts))
    return VR_BAD_MODE;
  if (Width < 1 || Width > VR_MAX_TILE || Height < 1 || Height > VR_MAX_TILE)
    return VR_BAD_SHAPE;
  const auto Cutoff = std::bit_cast<float>(C.Cutoff);
  if (!(Cutoff >= 0.0F && Cutoff < 1.0F))
    return VR_BAD_CUTOFF;
  if (Takes ? C.PushedTooMany : C.Count > VR_MAX_COUNT)
    return VR_BAD_COUNT;
  if ((!Takes && (C.Gaussians % 16 != 0 || C.List % 4 != 0)) ||
      (!Drains && (C.Output % 16 != 0 || C.OutputPitch % 16 != 0)))
    return VR_MISALIGNED;
  if (!Takes && C.Count != 0 && !Memory.range(C.List, 4ULL * C.Count))
    return VR_UNMAPPED;
  for (unsigned Row = 0; !Drains && Row != Height; ++Row)
    if (!rangeAt(Memory, rowAddress(Row), Width * PixelBytes))
      return VR_UNMAPPED;
  return VR_OK;
}

BlendOptions Execution::blendOptions() const {
  const auto Cutoff = std::bit_cast<float>(C.Cutoff);
  // T' <= cutoff is T' < the next float: one comparison serves both rules.
  return {OptionsStopAtEqual.get(C.Options)
              ? std::nextafter(Cutoff, std::numeric_limits<float>::infinity())
              : Cutoff,
          OptionsSkipSaturated.get(C.Options) != 0};
}

std::uint32_t Execution::blendOne(const Gaussian &G, std::uint32_t Address,
                                  const BlendOptions &Options) {
  ++Work.Gaussians;
  if (hasNan(G))
    return VR_NAN;
  const BlendWork Done =
      Lanes.Blend[OptionsExp.get(C.Options)](G, Options, Tile);
  Work.Clipped += Done.Clipped;
  Work.Fragments += Done.Fragments;
  Work.Blends += Done.Blends;
  if (Keeps)
    Kept.push_back({Address, Done.X, Done.Y, Done.Width, Done.Height,
                    static_cast<std::uint16_t>(Done.Fragments),
                    (G.Tag >> 31) != 0});
  return VR_OK;
}

/// The record that \p Entry of the list names, or nullptr if it is not there.
const std::byte *Execution::record(const std::byte *List,
                                   std::uint32_t Entry) const {
  std::uint32_t Number = 0;
  std::memcpy(&Number, List + 4ULL * Entry, 4);
  return rangeAt(Memory, C.Gaussians + std::uint64_t{Number} * sizeof(Gaussian),
                 sizeof(Gaussian));
}

std::uint32_t Execution::blendList() {
  const BlendOptions Options = blendOptions();
  if (Takes) {
    for (const Gaussian &G : C.Pushed) {
      if (Tile.Live == 0)
        break;
      if (const std::uint32_t Status = blendOne(G, 0, Options))
        return Status;
    }
    return VR_OK;
  }
  if (C.Count == 0)
    return VR_OK;
  const std::byte *List = Memory.range(C.List, 4ULL * C.Count);
  // The host's caches do not see a list's records coming: a third of the time
  // of small Gaussians, measured in bench/raster.
  constexpr std::uint32_t Ahead = 8;
  for (std::uint32_t I = 0; I != C.Count && Tile.Live != 0; ++I) {
    if (I + Ahead < C.Count)
      if (const std::byte *Soon = record(List, I + Ahead))
        __builtin_prefetch(Soon);
    const std::byte *Record = record(List, I);
    if (!Record)
      return VR_UNMAPPED;
    Gaussian G;
    std::memcpy(&G, Record, sizeof(G));
    std::uint32_t Number = 0;
    std::memcpy(&Number, List + 4ULL * I, 4);
    if (const std::uint32_t Status =
            blendOne(G, C.Gaussians + Number * sizeof(Gaussian), Options))
      return Status;
  }
  return VR_OK;
}

void Execution::copyRow(unsigned Row, std::byte *To) const {
  for (unsigned Column = 0; Column != Width; ++Column) {
    const unsigned At = Row * TileBuffer::Stride + Column;
    // T's sign says "saturated", no more.
    const Pixel P{Tile.R[At], Tile.G[At], Tile.B[At], std::fabs(Tile.T[At])};
    std::memcpy(To + Column * PixelBytes, &P, PixelBytes);
  }
}

CommandWork Execution::takeWork(std::uint32_t Status) {
  return {Takes ? 0 : C.List,
          C.Output,
          C.OutputPitch,
          static_cast<std::uint16_t>(Width),
          static_cast<std::uint16_t>(Height),
          static_cast<std::uint8_t>(OptionsExp.get(C.Options)),
          Drains,
          Status != VR_OK,
          std::move(Kept)};
}

std::uint32_t Execution::run(std::vector<Pixel> &Drained) {
  Work.Commands = 1;
  if (const std::uint32_t Status = check())
    return Status;
  Tile.reset(TileOriginX.get(C.TileOrigin), TileOriginY.get(C.TileOrigin),
             Width, Height);
  if (const std::uint32_t Status = blendList())
    return Status;
  if (Drains)
    Drained.resize(std::size_t{Width} * Height);
  for (unsigned Row = 0; Row != Height; ++Row)
    copyRow(Row, Drains ? reinterpret_cast<std::byte *>(&Drained[Row * Width])
                        : rangeAt(Memory, rowAddress(Row), Width * PixelBytes));
  return VR_OK;
}

} // namespace

Rasterizer::Rasterizer(RasterMemory &Global, std::vector<RasterAgent *> Served)
    : Memory(Global), Agents(std::move(Served)),
      Tile(std::make_unique<TileBuffer>()), Lanes(datapaths().back()) {}

Rasterizer::~Rasterizer() = default;

bool Rasterizer::step() {
  for (std::size_t Tried = 0; Tried != Agents.size(); ++Tried) {
    const std::size_t Turn = Next;
    RasterAgent &Agent = *Agents[Turn];
    Next = (Next + 1) % Agents.size();
    if (!Agent.isBusy())
      continue;
    const DefaultFloatEnvironment Environment;
    Execution Running(Agent.front(), Memory, *Tile, *Lanes);
    if (Log)
      Running.keepWork();
    const std::uint32_t Status = Running.run(Agent.drainedTile());
    if (Log)
      Log->command(static_cast<unsigned>(Turn), Running.takeWork(Status));
    Agent.complete(Status, Running.work());
    return true;
  }
  return false;
}

void Rasterizer::makeRoom(const RasterAgent &Agent) {
  while (!Agent.canStart())
    step();
}

void Rasterizer::finish(const RasterAgent &Agent) {
  while (Agent.isBusy())
    step();
}

} // namespace vorion::raster
