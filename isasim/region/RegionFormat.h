/// How the bytes of a region's file lie: Magic, how many bytes follow behind
/// this number, and records, each behind its head (docs/regions.md).
#pragma once

#include "region/MemoryChanges.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace vorion::isasim {

/// Its last character but one is the version.
inline constexpr std::string_view RegionMagic = "vorion-region 1\n";

/// A file has one machine, which comes first, and an image before the launches
/// that need it.
enum RecordKind : uint64_t { OfMachine, OfImage, OfLaunch };

struct RecordHead {
  uint64_t Kind = 0;
  uint64_t Bytes = 0; ///< that follow
  uint64_t Sum = 0;   ///< sumOf() them
};

inline uint64_t sumOf(std::span<const std::byte> Record) {
  Digest D;
  D.add(Record);
  return D.value();
}

} // namespace vorion::isasim
