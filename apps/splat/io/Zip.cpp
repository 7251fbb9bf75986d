#include "io/Zip.h"

#include "vorion/support/FileKind.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>
#include <zip.h>

namespace vorion::splat {
namespace {

struct FreeSource {
  void operator()(zip_source_t *S) const { zip_source_free(S); }
};
using Source = std::unique_ptr<zip_source_t, FreeSource>;

struct CloseEntry {
  void operator()(zip_file_t *F) const { zip_fclose(F); }
};

std::string describe(zip_error_t &E) {
  std::string Text = zip_error_strerror(&E);
  zip_error_fini(&E);
  return Text;
}

/// What the directory says of \p Entry; zeros where it says nothing.
zip_stat_t statusOf(zip_t *Archive, uint64_t Entry) {
  zip_stat_t Status;
  zip_stat_init(&Status);
  zip_stat_index(Archive, Entry, 0, &Status);
  return Status;
}

} // namespace

bool isZip(Bytes File) { return hasMark(FileKind::Zip, File); }

void ZipArchive::Discard::operator()(zip *Z) const { zip_discard(Z); }

Expected<ZipArchive> ZipArchive::open(const std::string &Where,
                                      const std::string &What, Bytes File) {
  const auto None = [&] {
    return otherKind(Where, File, What, "not a zip archive");
  };
  if (File.empty()) // which libzip takes for an archive without entries
    return None();
  zip_error_t E;
  zip_error_init(&E);
  zip_source_t *Memory =
      zip_source_buffer_create(File.data(), File.size(), 0, &E);
  if (!Memory)
    return Error{Where, describe(E), ExitCode::LimitReached};
  zip_t *Z = zip_open_from_source(Memory, ZIP_RDONLY, &E);
  if (!Z) {
    zip_source_free(Memory);
    const std::string Why = describe(E);
    return isZip(File) ? Error{Where, fmt::format("{}, expected {}", Why, What)}
                       : None();
  }
  zip_error_fini(&E);
  return ZipArchive(Where, File.size(), Z);
}

uint64_t ZipArchive::entries() const {
  return static_cast<uint64_t>(zip_get_num_entries(Handle.get(), 0));
}

std::string ZipArchive::name(uint64_t Entry) const {
  const char *Name = zip_get_name(Handle.get(), Entry, ZIP_FL_ENC_RAW);
  return Name ? printable(Name) : "";
}

std::string ZipArchive::placeOf(uint64_t Entry) const {
  return fmt::format("{}: {}", Where, name(Entry));
}

Error ZipArchive::tooMuch(uint64_t Entry) const {
  return {placeOf(Entry), fmt::format("more than {} bytes of entries in an "
                                      "archive of {}, expected less",
                                      unpackLimit(Size), Size)};
}

Expected<uint64_t> ZipArchive::find(const std::string &Name) const {
  const zip_int64_t Entry = zip_name_locate(Handle.get(), Name.c_str(), 0);
  if (Entry < 0)
    return Error{fmt::format("{}: {}", Where, printable(Name)),
                 "no such entry, expected it in the archive"};
  return static_cast<uint64_t>(Entry);
}

uint64_t ZipArchive::packedSize(uint64_t Entry) const {
  return std::min<uint64_t>(statusOf(Handle.get(), Entry).comp_size, Size);
}

Expected<bool> ZipArchive::unpack(uint64_t Entry, std::size_t Most,
                                  std::vector<std::byte> &To) {
  const std::unique_ptr<zip_file_t, CloseEntry> F(
      zip_fopen_index(Handle.get(), Entry, 0));
  if (!F)
    return Error{placeOf(Entry), fmt::format("cannot open the entry: {}",
                                             zip_strerror(Handle.get()))};
  constexpr std::size_t Chunk = 1 << 16;
  std::vector<std::byte> Part(Chunk);
  while (To.size() < Most) {
    const zip_int64_t Got =
        zip_fread(F.get(), Part.data(), std::min(Chunk, Most - To.size()));
    if (Got < 0)
      return Error{placeOf(Entry), fmt::format("cannot read the entry: {}",
                                               zip_file_strerror(F.get()))};
    if (Got == 0)
      return true;
    To.insert(To.end(), Part.begin(), Part.begin() + Got);
  }
  return false;
}

Expected<std::vector<std::byte>> ZipArchive::readStart(uint64_t Entry,
                                                       std::size_t Most) {
  std::vector<std::byte> Start;
  if (const auto Done = unpack(Entry, Most, Start); !Done)
    return Done.error();
  if (Start.size() > Left)
    return tooMuch(Entry);
  Left -= Start.size();
  return Start;
}

Expected<std::vector<std::byte>> ZipArchive::read(uint64_t Entry,
                                                  std::size_t Most) {
  const uint64_t Claimed = statusOf(Handle.get(), Entry).size;
  std::vector<std::byte> Content;
  // The byte beyond shows that there is more.
  if (Claimed <= std::min(Most, Left)) {
    Content.reserve(Claimed);
    const auto Ended = unpack(Entry, std::min(Most, Left) + 1, Content);
    if (!Ended)
      return Ended.error();
    if (*Ended) {
      Left -= Content.size();
      return Content;
    }
  }
  if (Most < Left)
    return Error{placeOf(Entry), fmt::format("an entry of more than {0} bytes, "
                                             "expected at most {0}",
                                             Most)};
  return tooMuch(Entry);
}

Expected<std::string>
makeZip(const std::string &Where,
        const std::map<std::string, std::string> &Entries) {
  zip_error_t E;
  zip_error_init(&E);
  const Source Memory(zip_source_buffer_create(nullptr, 0, 0, &E));
  if (!Memory)
    return Error{Where, describe(E), ExitCode::LimitReached};
  zip_source_keep(Memory.get()); // closing the archive gives up its share
  std::unique_ptr<zip_t, void (*)(zip_t *)> Z(
      zip_open_from_source(Memory.get(), ZIP_TRUNCATE, &E), zip_discard);
  if (!Z) {
    zip_source_free(Memory.get());
    return Error{Where, describe(E), ExitCode::LimitReached};
  }
  for (const auto &[Name, Content] : Entries) { // read on closing
    zip_source_t *S =
        zip_source_buffer(Z.get(), Content.data(), Content.size(), 0);
    const zip_int64_t Index =
        S ? zip_file_add(Z.get(), Name.c_str(), S, ZIP_FL_ENC_UTF_8) : -1;
    if (Index < 0) {
      zip_source_free(S);
      return Error{Where, zip_strerror(Z.get()), ExitCode::LimitReached};
    }
    // A fixed date (1 January 1980), so that equal entries make equal files.
    constexpr zip_uint16_t FirstDay = (1 << 5) | 1;
    zip_file_set_dostime(Z.get(), static_cast<zip_uint64_t>(Index), 0, FirstDay,
                         0);
  }
  if (zip_close(Z.get()) != 0)
    return Error{Where, zip_strerror(Z.get()), ExitCode::LimitReached};
  [[maybe_unused]] zip_t *Closed = Z.release();

  zip_stat_t Stat;
  if (zip_source_stat(Memory.get(), &Stat) != 0 ||
      zip_source_open(Memory.get()) != 0)
    return Error{Where, "cannot read back the archive", ExitCode::LimitReached};
  std::string Out(Stat.size, '\0');
  const zip_int64_t Got = zip_source_read(Memory.get(), Out.data(), Out.size());
  zip_source_close(Memory.get());
  if (Got != static_cast<zip_int64_t>(Out.size()))
    return Error{Where, "cannot read back the archive", ExitCode::LimitReached};
  return Out;
}

} // namespace vorion::splat
