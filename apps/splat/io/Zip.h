/// Zip archives in memory.
#pragma once

#include "io/Bytes.h"
#include "vorion/support/Expected.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

struct zip;

namespace vorion::splat {

bool isZip(Bytes File);

/// Does not copy the bytes of the archive, which must outlive it.
class ZipArchive {
public:
  /// \p What names the kind of file in messages, as "an .npz archive".
  static Expected<ZipArchive> open(const std::string &Where,
                                   const std::string &What, Bytes File);

  uint64_t entries() const;
  /// The name of an entry; empty if it has none.
  std::string name(uint64_t Entry) const;
  /// The index of the entry \p Name.
  Expected<uint64_t> find(const std::string &Name) const;
  /// Compressed size of an entry in bytes, from the directory.
  uint64_t packedSize(uint64_t Entry) const;
  /// The content of an entry of at most \p Most bytes, with a check of the
  /// checksum. The size in the directory is not trusted, and the total of all
  /// entries is limited to \c unpackLimit of the archive's size, because
  /// several entries may refer to the same bytes.
  Expected<std::vector<std::byte>> read(uint64_t Entry, std::size_t Most);
  /// The first \p Most bytes of it, or all if it is shorter.
  Expected<std::vector<std::byte>> readStart(uint64_t Entry, std::size_t Most);

private:
  struct Discard {
    void operator()(zip *Z) const;
  };
  /// Reads until \p Most bytes or the end; true if that was the end.
  Expected<bool> unpack(uint64_t Entry, std::size_t Most,
                        std::vector<std::byte> &To);
  std::string placeOf(uint64_t Entry) const;
  Error tooMuch(uint64_t Entry) const;
  ZipArchive(std::string Where, std::size_t Size, zip *Z)
      : Where(std::move(Where)), Size(Size), Left(unpackLimit(Size)),
        Handle(Z) {}

  std::string Where;
  std::size_t Size;
  std::size_t Left; ///< bytes that may still be unpacked
  std::unique_ptr<zip, Discard> Handle;
};

/// An archive of \p Entries, names and contents. Deterministic.
Expected<std::string>
makeZip(const std::string &Where,
        const std::map<std::string, std::string> &Entries);

} // namespace vorion::splat
