/// Regions' files that were changed, with what guards them made right again.
#pragma once

#include "region/RegionFormat.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace vorion::isasim::testing {

/// \p File as one that was written whole: its beginning, its size and every
/// record's sum are right. A record that is longer than what is there ends with
/// it; what is less than a record's head is left out.
inline std::vector<std::byte> sealedRegion(std::vector<std::byte> File) {
  uint64_t Bytes = 0; // of all records
  const size_t Begin = RegionMagic.size() + sizeof(Bytes);
  File.resize(std::max(File.size(), Begin));
  size_t At = Begin;
  for (RecordHead Head; File.size() - At >= sizeof(Head);
       At += sizeof(Head) + Head.Bytes) {
    std::memcpy(&Head, File.data() + At, sizeof(Head));
    const auto Rest = std::span(File).subspan(At + sizeof(Head));
    Head.Bytes = std::min<uint64_t>(Head.Bytes, Rest.size());
    Head.Sum = sumOf(Rest.first(Head.Bytes));
    std::memcpy(File.data() + At, &Head, sizeof(Head));
  }
  File.resize(At);
  Bytes = At - Begin;
  std::memcpy(File.data(), RegionMagic.data(), RegionMagic.size());
  std::memcpy(File.data() + RegionMagic.size(), &Bytes, sizeof(Bytes));
  return File;
}

} // namespace vorion::isasim::testing
