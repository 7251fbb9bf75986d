#include "Hash.h"

#include "vorion/support/File.h"

#include <cstdint>
#include <fmt/format.h>

namespace vorion::splat {

std::string fnv1a64(std::string_view Bytes) {
  std::uint64_t Hash = 0xcbf29ce484222325;
  for (const char C : Bytes)
    Hash = (Hash ^ static_cast<unsigned char>(C)) * 0x100000001b3;
  return fmt::format("{:016x}", Hash);
}

Expected<std::string> hashFile(const std::string &File) {
  const auto Bytes = readFile(File);
  if (!Bytes)
    return Bytes.error();
  return fnv1a64(
      {reinterpret_cast<const char *>(Bytes->data()), Bytes->size()});
}

} // namespace vorion::splat
