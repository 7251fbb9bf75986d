#include "raster/BackwardRun.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace vorion::raster {

namespace {

BackwardOptions backwardOptions(const Command &C) {
  BackwardOptions O;
  O.Unit = static_cast<Reciprocal>(BackwardReciprocal.get(C.Backward));
  O.ClampStops = BackwardClampStops.get(C.Backward) != 0;
  O.InRows = BackwardInRows.get(C.Backward) != 0;
  O.SkipSaturated = OptionsSkipSaturated.get(C.Options) != 0;
  O.MinAlpha = leastAlpha(C);
  return O;
}

} // namespace

BackwardRun::BackwardRun(const Command &Configured, RasterMemory &Global,
                         BackwardBuffer &Buffer, const BackwardDatapath &Lanes,
                         bool KeepWork)
    : C(Configured), Memory(Global), Tile(Buffer), Unit(Lanes),
      Options(backwardOptions(C)), Status(checkCommand(C, Memory)),
      List(C, Memory), Keeps(KeepWork) {
  Work.Commands = 1;
  if (Status == VR_OK)
    load();
}

/// Fills the pixel buffer. The list is gone through from the last entry that
/// any pixel blended.
void BackwardRun::load() {
  const unsigned Width = TileShapeWidth.get(C.TileShape);
  const unsigned Height = TileShapeHeight.get(C.TileShape);
  Tile.reset(TileOriginX.get(C.TileOrigin), TileOriginY.get(C.TileOrigin),
             Width, Height);
  for (unsigned Y = 0; Y != Height; ++Y) {
    const std::byte *Rendered = outputRow(C, Memory, Y);
    const std::byte *Upstream = upstreamRow(C, Memory, Y);
    const std::byte *Last = lastRow(C, Memory, Y);
    for (unsigned X = 0; X != Width; ++X) {
      Pixel Was, Gradient; // the gradient by T stands in T's place
      std::uint32_t Entries = 0;
      std::memcpy(&Was, Rendered + X * sizeof(Pixel), sizeof(Pixel));
      std::memcpy(&Gradient, Upstream + X * sizeof(Pixel), sizeof(Pixel));
      std::memcpy(&Entries, Last + X * sizeof(Entries), sizeof(Entries));
      const unsigned At = Y * BackwardBuffer::Stride + X;
      Tile.R[At] = Gradient.R;
      Tile.G[At] = Gradient.G;
      Tile.B[At] = Gradient.B;
      Tile.T[At] = Was.T;
      Tile.Behind[At] = Gradient.T;
      Tile.Last[At] = std::min(Entries, C.Count);
      Tile.RowLast[Y] = std::max(Tile.RowLast[Y], Tile.Last[At]);
    }
    Left = std::max(Left, Tile.RowLast[Y]);
  }
}

std::uint32_t BackwardRun::through(std::uint32_t Entry, GradientSums &Sums) {
  Fetched Input;
  const std::uint32_t Found = List.fetch(Entry, Input);
  Work.Gaussians += Found != VR_UNMAPPED;
  if (Found)
    return Found;
  Options.Entry = Entry;
  const BoxWork Done =
      Unit.Back[OptionsExp.get(C.Options)](Input.Record, Options, Tile, Sums);
  Work.Intersecting += Input.Intersects;
  Work.Clipped += Done.Clipped;
  Work.Fragments += Done.Fragments;
  Work.Blends += Done.Blends;
  if (Keeps)
    Kept.push_back({Input.Address, Done.X, Done.Y, Done.Width, Done.Height,
                    static_cast<std::uint16_t>(Done.Fragments),
                    Input.Intersects});
  return VR_OK;
}

std::optional<GradientBatch> BackwardRun::next() {
  if (Status != VR_OK || Left == 0)
    return std::nullopt;
  GradientBatch Batch;
  Batch.Number = (Left - 1) / VR_GRAD_LANES;
  const std::uint32_t First = Batch.Number * VR_GRAD_LANES;
  Batch.Count = Left - First;
  for (; Left != First; --Left) {
    Status = through(Left - 1, Batch.Gaussians[Left - 1 - First]);
    if (Status != VR_OK)
      return std::nullopt;
  }
  return Batch;
}

CommandWork BackwardRun::takeWork() {
  CommandWork W;
  W.List = C.List;
  W.Output = C.Output;
  W.OutputPitch = C.OutputPitch;
  W.Width = static_cast<std::uint16_t>(TileShapeWidth.get(C.TileShape));
  W.Height = static_cast<std::uint16_t>(TileShapeHeight.get(C.TileShape));
  W.Units = laneUnits(C);
  W.Failed = Status != VR_OK;
  W.Gaussians = std::move(Kept);
  W.Backward = true;
  W.Reciprocal = static_cast<std::uint8_t>(BackwardReciprocal.get(C.Backward));
  W.Last = C.Last;
  W.Upstream = C.Upstream;
  return W;
}

} // namespace vorion::raster
