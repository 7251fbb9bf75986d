#include "raster/BackwardRun.h"

#include <algorithm>
#include <cstring>

namespace vorion::raster {

/// Of the front end with such records.
template <typename Record>
static BackFunction<Record> backFunction(const Job &J,
                                         const BackwardDatapath &Lanes) {
  if constexpr (std::is_same_v<Record, Gaussian>)
    return Lanes.Conics[expRow(J.Units.Exp)];
  else
    return (J.Backward.Falloff.IsLowPass ? Lanes.Surfels
                                         : Lanes.Rays)[expRow(J.Units.Exp)];
}

BackwardRun::BackwardRun(const RasterAgent &Agent, RasterMemory &Global,
                         BackwardBuffer &Buffer, const BackwardDatapath &Lanes,
                         const WorkLog *Log)
    : BatchRun(beginCommand(Agent, Global)), Memory(Global), Tile(Buffer),
      Unit(Lanes), Options(Task.Backward),
      KeepsFetches(Log && Log->wantsFetches()) {
  if (!Work.hasFailed())
    load();
  Work.Entries = Left;
}

/// Fills the pixel buffer. The list is gone through from the last entry that
/// any pixel blended.
void BackwardRun::load() {
  Tile.reset(Task.X, Task.Y, Task.Width, Task.Height);
  for (unsigned Y = 0; Y != Task.Height; ++Y) {
    const std::byte *Rendered = outputRow(Task, Memory, Y);
    const std::byte *Upstream = upstreamRow(Task, Memory, Y);
    const std::byte *Last = lastRow(Task, Memory, Y);
    for (unsigned X = 0; X != Task.Width; ++X) {
      Pixel Was, Gradient; // the gradient by T stands in T's place
      uint32_t Entries = 0;
      std::memcpy(&Was, Rendered + X * sizeof(Pixel), sizeof(Pixel));
      std::memcpy(&Gradient, Upstream + X * sizeof(Pixel), sizeof(Pixel));
      std::memcpy(&Entries, Last + X * sizeof(Entries), sizeof(Entries));
      const unsigned At = Y * BackwardBuffer::Stride + X;
      Tile.R[At] = Gradient.R;
      Tile.G[At] = Gradient.G;
      Tile.B[At] = Gradient.B;
      Tile.T[At] = Was.T;
      Tile.Behind[At] = Gradient.T;
      Tile.Last[At] = std::min(Entries, Task.Count);
      Tile.RowLast[Y] = std::max(Tile.RowLast[Y], Tile.Last[At]);
    }
    Left = std::max(Left, Tile.RowLast[Y]);
  }
}

template <typename Record>
uint32_t BackwardRun::through(uint32_t Entry, GradientSums &Sums) {
  FetchedRecord<Record> Input;
  const uint32_t Found = RecordList<Record>(Task, Memory).fetch(Entry, Input);
  Work.Counts.Gaussians += Found != VR_UNMAPPED;
  if (Found)
    return Found;
  Options.Entry = Entry;
  const BackFunction<Record> Back = backFunction<Record>(Task, Unit);
  const BoxWork Done = Back(Input.Record, Options, Tile, Sums);
  Work.Counts.Intersecting += Input.Intersects;
  Work.Counts.Clipped += Done.Clipped;
  Work.Counts.Fragments += Done.Fragments;
  Work.Counts.Blends += Done.Blends;
  if (KeepsFetches)
    Work.Gaussians.push_back(
        {Input.Address, Done.X, Done.Y, Done.Width, Done.Height,
         static_cast<uint16_t>(Done.Fragments), Input.Intersects});
  return VR_OK;
}

std::optional<Batch> BackwardRun::next() {
  Batch Made;
  Made.Number = (Left - 1) / VR_GRAD_LANES;
  const uint32_t First = Made.Number * VR_GRAD_LANES;
  Made.Count = Left - First;
  for (; Left != First; --Left) {
    GradientSums Sums;
    Work.Status = Task.Units.isConic() ? through<Gaussian>(Left - 1, Sums)
                                       : through<RayGaussian>(Left - 1, Sums);
    if (Work.hasFailed())
      return std::nullopt;
    Made.Items[Left - 1 - First] = itemOf(Sums);
  }
  return Made;
}

} // namespace vorion::raster
