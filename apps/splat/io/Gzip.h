/// Gzip streams in memory.
#pragma once

#include "io/Bytes.h"
#include "vorion/support/Expected.h"

#include <memory>
#include <string>
#include <vector>

struct z_stream_s; // NOLINT(readability-identifier-naming): zlib's name

namespace vorion::splat {

bool isGzip(Bytes File);

/// \p Content, of less than 4 GiB, as one gzip stream. Deterministic on all
/// hosts with the same zlib.
std::string gzipOf(const std::string &Content);

/// Unpacks a gzip file incrementally, so that a header can determine the
/// expected size.
class GzipReader {
public:
  /// Views \p File, which must outlive it.
  static Expected<GzipReader> open(const std::string &Where, Bytes File);

  /// The next \p Size bytes, or fewer at the end of the stream. Memory is
  /// limited to the maximum that Deflate can pack into the file.
  Expected<std::vector<std::byte>> read(std::size_t Size);
  /// Checks that the stream and the file end here, and the checksum.
  Expected<Success> finish();

private:
  struct End {
    void operator()(z_stream_s *S) const;
  };
  GzipReader(std::string Where, std::size_t FileSize,
             std::unique_ptr<z_stream_s, End> Stream);

  Error damaged() const;

  std::string Where;
  std::size_t FileSize;
  std::unique_ptr<z_stream_s, End> Stream;
  bool Ended = false;
};

} // namespace vorion::splat
