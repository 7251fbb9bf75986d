#include "io/Zstd.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <zstd.h>

namespace vorion::splat {

Expected<std::vector<std::byte>> unpackZstd(const std::string &Where,
                                            Bytes Frame, std::size_t Size) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> Stream(
      ZSTD_createDStream(), ZSTD_freeDStream);
  if (!Stream)
    return Error{Where, "cannot start zstd, expected memory for it",
                 ExitCode::LimitReached};
  // Twice as much each time: what is claimed need not be there. One byte more
  // than is asked for shows that there is too much.
  constexpr std::size_t Least = std::size_t(1) << 16;
  const std::size_t Most = std::min(Size, unpackLimit(Frame.size())) + 1;
  std::vector<std::byte> Out(std::min(Most, Least));
  ZSTD_inBuffer In{Frame.data(), Frame.size(), 0};
  ZSTD_outBuffer To{Out.data(), Out.size(), 0};
  while (true) {
    const std::size_t Read = In.pos, Had = To.pos;
    const std::size_t Left = ZSTD_decompressStream(Stream.get(), &To, &In);
    if (ZSTD_isError(Left) != 0)
      return Error{
          Where,
          fmt::format("damaged zstd frame ({}), expected a complete frame",
                      ZSTD_getErrorName(Left))};
    if (Left == 0)
      break;
    if (To.pos == To.size && Out.size() < Most) {
      Out.resize(std::min(Most, 2 * Out.size()));
      To.dst = Out.data();
      To.size = Out.size();
    } else if (In.pos == Read && To.pos == Had) {
      return Error{Where, fmt::format("the zstd frame {} after {} bytes, "
                                      "expected {}",
                                      To.pos == Most ? "goes on" : "ends early",
                                      To.pos, Size)};
    }
  }
  if (To.pos != Size || In.pos != Frame.size())
    return Error{Where, fmt::format("a zstd frame of {} bytes in {}, expected "
                                    "{} in {}",
                                    To.pos, In.pos, Size, Frame.size())};
  Out.resize(Size);
  return Out;
}

std::string zstdOf(const std::string &Content) {
  std::string Out(ZSTD_compressBound(Content.size()), '\0');
  const std::size_t Size = ZSTD_compress(Out.data(), Out.size(), Content.data(),
                                         Content.size(), ZSTD_CLEVEL_DEFAULT);
  assert(ZSTD_isError(Size) == 0);
  Out.resize(Size);
  return Out;
}

} // namespace vorion::splat
