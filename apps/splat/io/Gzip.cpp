#include "io/Gzip.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <utility>
#include <zlib.h>

namespace vorion::splat {

bool isGzip(Bytes File) { return hasMark(FileKind::Gzip, File); }

std::string gzipOf(const std::string &Content) {
  z_stream Stream{};
  [[maybe_unused]] int Status =
      deflateInit2(&Stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + 16,
                   8, Z_DEFAULT_STRATEGY);
  std::string Out(deflateBound(&Stream, Content.size()), '\0');
  std::string In = Content; // zlib's interface is not const
  Stream.next_in = reinterpret_cast<Bytef *>(In.data());
  Stream.avail_in = static_cast<uInt>(In.size());
  Stream.next_out = reinterpret_cast<Bytef *>(Out.data());
  Stream.avail_out = static_cast<uInt>(Out.size());
  Status = deflate(&Stream, Z_FINISH);
  assert(Status == Z_STREAM_END);
  Out.resize(Stream.total_out);
  deflateEnd(&Stream);
  return Out;
}

void GzipReader::End::operator()(z_stream_s *S) const {
  inflateEnd(S);
  delete S;
}

GzipReader::GzipReader(std::string Where, std::size_t FileSize,
                       std::unique_ptr<z_stream_s, End> Stream)
    : Where(std::move(Where)), FileSize(FileSize), Stream(std::move(Stream)) {}

Expected<GzipReader> GzipReader::open(const std::string &Where, Bytes File) {
  if (File.size() > std::numeric_limits<uInt>::max())
    return Error{Where, "gzip stream of 4 GiB or more, expected less"};
  auto Fresh = std::make_unique<z_stream>();
  constexpr int GzipOnly = 16;
  if (inflateInit2(Fresh.get(), MAX_WBITS + GzipOnly) != Z_OK)
    return Error{Where, "cannot start zlib, expected memory for it",
                 ExitCode::LimitReached};
  std::unique_ptr<z_stream_s, End> Stream(Fresh.release());
  Stream->next_in = const_cast<Bytef *>( // zlib's, which only reads
      reinterpret_cast<const Bytef *>(File.data()));
  Stream->avail_in = static_cast<uInt>(File.size());
  return GzipReader(Where, File.size(), std::move(Stream));
}

Error GzipReader::damaged() const {
  return {Where,
          fmt::format("damaged gzip stream ({}), expected a complete stream",
                      Stream->msg ? Stream->msg : "truncated")};
}

Expected<std::vector<std::byte>> GzipReader::read(std::size_t Size) {
  // Twice as much each time: what is asked for need not be there.
  constexpr std::size_t Least = std::size_t(1) << 16;
  const std::size_t Most = std::min(Size, unpackLimit(FileSize));
  std::vector<std::byte> Out;
  std::size_t Have = 0;
  while (Have < Most && !Ended) {
    if (Have == Out.size())
      Out.resize(std::min(Most, std::max(2 * Have, Least)));
    Stream->next_out = reinterpret_cast<Bytef *>(Out.data() + Have);
    Stream->avail_out = static_cast<uInt>(std::min<std::size_t>(
        Out.size() - Have, std::numeric_limits<uInt>::max()));
    const uInt Room = Stream->avail_out;
    const int Status = inflate(Stream.get(), Z_NO_FLUSH);
    Have += Room - Stream->avail_out;
    Ended = Status == Z_STREAM_END;
    if (!Ended &&
        (Status != Z_OK || (Stream->avail_in == 0 && Stream->avail_out != 0)))
      return damaged();
  }
  Out.resize(Have);
  return Out;
}

Expected<Success> GzipReader::finish() {
  const auto More = read(1);
  if (!More)
    return More.error();
  if (!More->empty())
    return Error{
        Where, "the gzip stream is too long, expected the size in its header"};
  if (Stream->avail_in != 0)
    return Error{
        Where,
        fmt::format("{} after the gzip stream, expected the end of the file",
                    counted(Stream->avail_in, "byte"))};
  return Success{};
}

} // namespace vorion::splat
