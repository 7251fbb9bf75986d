/// What rasterizer and pixel unit have in common in how they execute a command:
/// its list, its rows of pixels.
#pragma once

#include "raster/RasterAgent.h"
#include "raster/WorkLog.h"

#include <cfenv>
#include <cstring>
#include <span>
#include <type_traits>

namespace vorion::raster {

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

/// The oldest command of \p Agent, checked and not begun.
CommandWork beginCommand(const RasterAgent &Agent, RasterMemory &Memory);

/// The datapath of \p Lanes that \p J, which was not refused, asks for; its
/// front end has such records.
template <typename Record>
BlendFunction<Record> blendFunction(const Job &J, const Datapath &Lanes) {
  const auto &Of = [&]() -> const BlendTable<Record> & {
    if constexpr (std::is_same_v<Record, Gaussian>)
      return Lanes.Conics;
    else
      return Lanes.Rays;
  }();
  return Of.Of[expRow(J.Units.Exp)][J.Units.Blend];
}

/// Host address of row \p Row of the output of \p J, or nullptr if it is not
/// all global memory.
std::byte *outputRow(const Job &J, RasterMemory &Memory, unsigned Row);

/// Likewise the row of last contributors of a command that keeps or reads them,
/// and the row of gradients of a backward one.
std::byte *lastRow(const Job &J, RasterMemory &Memory, unsigned Row);
std::byte *upstreamRow(const Job &J, RasterMemory &Memory, unsigned Row);

/// Likewise the rows of the ends and the beginnings of its pixels' ranges.
std::byte *limitRow(const Job &J, RasterMemory &Memory, unsigned Row);
std::byte *fromRow(const Job &J, RasterMemory &Memory, unsigned Row);

/// Entries of a list between two looks at whether the run is over or the log is
/// full: of the largest tiles milliseconds.
inline constexpr uint32_t LongestStretch = 4096;

/// One entry of a list, and the record that it names.
template <typename Kind> struct FetchedRecord {
  Kind Record;
  uint32_t Address; ///< of the record
  bool Intersects;
};

/// VR_NAN if one of \p Floats is a NaN, else VR_OK.
uint32_t checkFloats(std::span<const float> Floats);

/// Likewise of the floats of a record; each kind has such a function.
uint32_t checkRecord(const Gaussian &G);
uint32_t checkRecord(const RayGaussian &G);

/// The list of a command that was not refused.
class ListReader {
public:
  /// \p RecordBytes: of a record that an entry names.
  ListReader(const Job &J, RasterMemory &Memory, uint32_t RecordBytes);

protected:
  /// The record of entry \p I, below vr_count, or nullptr if it is not there.
  const std::byte *find(uint32_t I, uint32_t &Address, bool &Intersects) const;

private:
  uint32_t entry(uint32_t I) const;
  uint64_t address(uint32_t Entry) const;
  const std::byte *record(uint32_t Entry) const;

  uint32_t Records; ///< address of the first
  uint32_t RecordBytes;
  uint32_t Count;
  RasterMemory &Memory;
  const std::byte *Entries;
};

template <typename Kind> class RecordList : ListReader {
public:
  RecordList(const Job &J, RasterMemory &Memory)
      : ListReader(J, Memory, sizeof(Kind)) {}

  /// Reads entry \p I, below vr_count, with its record: VR_OK, VR_UNMAPPED or
  /// VR_NAN.
  uint32_t fetch(uint32_t I, FetchedRecord<Kind> &Out) const {
    const std::byte *Found = find(I, Out.Address, Out.Intersects);
    if (!Found)
      return VR_UNMAPPED;
    std::memcpy(&Out.Record, Found, sizeof(Out.Record));
    return checkRecord(Out.Record);
  }
};

using Fetched = FetchedRecord<Gaussian>;
using GaussianList = RecordList<Gaussian>;

} // namespace vorion::raster
