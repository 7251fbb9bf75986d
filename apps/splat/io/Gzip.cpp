#include "Gzip.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <zlib.h>

namespace vorion::splat {

bool isGzip(Bytes File) {
  return File.size() >= 2 && byteAt(File, 0) == 0x1F && byteAt(File, 1) == 0x8B;
}

Expected<std::vector<std::byte>> unpackGzip(const std::string &Where,
                                            Bytes File) {
  if (File.size() > std::numeric_limits<uInt>::max())
    return Error{Where, "gzip stream of 4 GiB or more, expected less"};
  z_stream Stream{};
  constexpr int GzipOnly = 16;
  if (inflateInit2(&Stream, MAX_WBITS + GzipOnly) != Z_OK)
    return Error{Where, "cannot start zlib, expected memory for it",
                 ExitCode::LimitReached};
  const std::unique_ptr<z_stream, int (*)(z_stream *)> End(&Stream, inflateEnd);
  Stream.next_in = const_cast<Bytef *>( // zlib's, which only reads
      reinterpret_cast<const Bytef *>(File.data()));
  Stream.avail_in = static_cast<uInt>(File.size());

  // The stream's last word is its content's size, if it is to be believed.
  constexpr std::size_t Least = std::size_t(1) << 16;
  const std::size_t Claimed =
      File.size() >= 4 ? load<std::uint32_t>(File, File.size() - 4) : 0;
  std::vector<std::byte> Out(
      std::clamp(Claimed + 1, Least, unpackLimit(File.size())));
  std::size_t Size = 0;
  while (true) {
    if (Size == Out.size())
      Out.resize(2 * Size); // what Deflate gives is bounded by what it takes
    Stream.next_out = reinterpret_cast<Bytef *>(Out.data() + Size);
    Stream.avail_out = static_cast<uInt>(std::min<std::size_t>(
        Out.size() - Size, std::numeric_limits<uInt>::max()));
    const uInt Room = Stream.avail_out;
    const int Status = inflate(&Stream, Z_NO_FLUSH);
    Size += Room - Stream.avail_out;
    if (Status == Z_STREAM_END)
      break;
    if (Status != Z_OK || (Stream.avail_in == 0 && Stream.avail_out != 0))
      return Error{Where,
                   fmt::format("damaged gzip stream ({}), expected a "
                               "whole one",
                               Stream.msg ? Stream.msg : "it ends early")};
  }
  if (Stream.avail_in != 0)
    return Error{Where, fmt::format("{} bytes after the gzip stream, expected "
                                    "the file's end",
                                    Stream.avail_in)};
  Out.resize(Size);
  return Out;
}

} // namespace vorion::splat
