#include "mem/VxBinReader.h"

#include "core/IsaTables.h"

#include <cstring>
#include <fmt/format.h>

namespace vorion::isasim {

Expected<std::shared_ptr<const Image>>
parseVxBin(std::span<const std::byte> File, std::string Name) {
  uint64_t Range[2];
  if (File.size() < sizeof(Range))
    return Error{Name, fmt::format("truncated: {} bytes, expected at least the "
                                   "two addresses of a .vxbin file",
                                   File.size())};
  std::memcpy(Range, File.data(), sizeof(Range));
  const auto [First, End] = Range;
  const std::span<const std::byte> Bytes = File.subspan(sizeof(Range));
  constexpr uint64_t Lo = VX_IMAGE_BASE, Hi = Lo + VX_IMAGE_SIZE;
  if (First < Lo || End > Hi || First >= End)
    return Error{Name, fmt::format("addresses 0x{:x} to 0x{:x}, expected a "
                                   "range within 0x{:x} and 0x{:x}",
                                   First, End, Lo, Hi)};
  if (First % 4 != 0)
    return Error{Name, fmt::format("first address 0x{:x}, expected a multiple "
                                   "of 4",
                                   First)};
  if (Bytes.size() > End - First)
    return Error{Name, fmt::format("{} bytes for 0x{:x} to 0x{:x}, expected at "
                                   "most {}",
                                   Bytes.size(), First, End, End - First)};
  Image::Segment S;
  S.Address = static_cast<uint32_t>(First);
  S.MemBytes = static_cast<uint32_t>(End - First);
  S.Bytes.assign(Bytes.begin(), Bytes.end());
  S.Writable = S.Executable = true;
  return Image::raw(std::move(S), std::move(Name));
}

} // namespace vorion::isasim
