// The zip half of Npz.h.
#include "Npz.h"
#include "NpyFormat.h"

#include "vorion/support/File.h"

#include <fmt/format.h>
#include <memory>
#include <zip.h>

namespace vorion::splat {
namespace {

struct DiscardArchive {
  void operator()(zip_t *Z) const { zip_discard(Z); }
};
struct CloseEntry {
  void operator()(zip_file_t *F) const { zip_fclose(F); }
};
struct FreeSource {
  void operator()(zip_source_t *S) const { zip_source_free(S); }
};
using Archive = std::unique_ptr<zip_t, DiscardArchive>;
using Entry = std::unique_ptr<zip_file_t, CloseEntry>;
using Source = std::unique_ptr<zip_source_t, FreeSource>;

std::string describe(zip_error_t &E) {
  std::string Text = zip_error_strerror(&E);
  zip_error_fini(&E);
  return Text;
}

/// Reads an entry to its end; what the directory claims of its size is not
/// believed before the bytes are there.
Expected<std::vector<std::byte>> readEntry(zip_t *Z, zip_uint64_t Index,
                                           const std::string &Where) {
  const Entry F(zip_fopen_index(Z, Index, 0));
  if (!F)
    return Error{Where,
                 fmt::format("cannot open the entry: {}", zip_strerror(Z))};
  std::vector<std::byte> Bytes;
  constexpr std::size_t Chunk = 1 << 20;
  while (true) {
    const std::size_t Old = Bytes.size();
    Bytes.resize(Old + Chunk);
    const zip_int64_t Got = zip_fread(F.get(), Bytes.data() + Old, Chunk);
    Bytes.resize(Old + static_cast<std::size_t>(Got > 0 ? Got : 0));
    if (Got < 0)
      return Error{Where, fmt::format("cannot read the entry: {}",
                                      zip_file_strerror(F.get()))};
    if (Got == 0)
      return Bytes;
  }
}

} // namespace

Expected<Npz> readNpz(const std::string &Path) {
  // Through memory, so that a folder or a pipe gets readFile's message.
  const auto File = readFile(Path);
  if (!File)
    return File.error();
  if (File->empty()) // which libzip takes for an archive without entries
    return Error{Path, "not an .npz archive: the file is empty"};
  zip_error_t E;
  zip_error_init(&E);
  Source Memory(zip_source_buffer_create(File->data(), File->size(), 0, &E));
  if (!Memory)
    return Error{Path, describe(E), ExitCode::Internal};
  const Archive Z(zip_open_from_source(Memory.get(), ZIP_RDONLY, &E));
  if (!Z)
    return Error{Path, fmt::format("not an .npz archive: {}", describe(E))};
  // The archive owns it now.
  [[maybe_unused]] zip_source_t *Given = Memory.release();
  zip_error_fini(&E);
  Npz Arrays;
  const zip_int64_t Entries = zip_get_num_entries(Z.get(), 0);
  for (zip_int64_t I = 0; I < Entries; ++I) {
    const char *Name =
        zip_get_name(Z.get(), static_cast<zip_uint64_t>(I), ZIP_FL_ENC_RAW);
    std::string Key = Name ? Name : "";
    const std::string Where = fmt::format("{}: {}", Path, Key);
    if (!Key.ends_with(".npy"))
      return Error{Where, "expected only .npy entries"};
    Key.resize(Key.size() - 4);
    const auto Bytes = readEntry(Z.get(), static_cast<zip_uint64_t>(I), Where);
    if (!Bytes)
      return Bytes.error();
    auto A = parseNpy(Where, *Bytes);
    if (!A)
      return A.error();
    Arrays[Key] = std::move(*A);
  }
  return Arrays;
}

Expected<Success> writeNpz(const std::string &Path, const Npz &Arrays) {
  zip_error_t E;
  zip_error_init(&E);
  const Source Memory(zip_source_buffer_create(nullptr, 0, 0, &E));
  if (!Memory)
    return Error{Path, describe(E), ExitCode::Internal};
  zip_source_keep(Memory.get()); // closing the archive gives up its share
  Archive Z(zip_open_from_source(Memory.get(), ZIP_TRUNCATE, &E));
  if (!Z) {
    zip_source_free(Memory.get());
    return Error{Path, describe(E), ExitCode::Internal};
  }
  std::vector<std::string> Files; // libzip reads them on closing
  Files.reserve(Arrays.size());
  for (const auto &[Name, A] : Arrays) {
    const std::string &File = Files.emplace_back(formatNpy(A));
    zip_source_t *S = zip_source_buffer(Z.get(), File.data(), File.size(), 0);
    const zip_int64_t Index =
        S ? zip_file_add(Z.get(), (Name + ".npy").c_str(), S, ZIP_FL_ENC_UTF_8)
          : -1;
    if (Index < 0) {
      zip_source_free(S);
      return Error{Path, zip_strerror(Z.get()), ExitCode::Internal};
    }
    // A fixed date (1 January 1980), so that equal arrays make equal files.
    constexpr zip_uint16_t FirstDay = (1 << 5) | 1;
    zip_file_set_dostime(Z.get(), static_cast<zip_uint64_t>(Index), 0, FirstDay,
                         0);
  }
  if (zip_close(Z.get()) != 0)
    return Error{Path, zip_strerror(Z.get()), ExitCode::Internal};
  [[maybe_unused]] zip_t *Closed = Z.release();

  zip_stat_t Stat;
  if (zip_source_stat(Memory.get(), &Stat) != 0 ||
      zip_source_open(Memory.get()) != 0)
    return Error{Path, "cannot read the archive back", ExitCode::Internal};
  std::string Out(Stat.size, '\0');
  const zip_int64_t Got = zip_source_read(Memory.get(), Out.data(), Out.size());
  zip_source_close(Memory.get());
  if (Got != static_cast<zip_int64_t>(Out.size()))
    return Error{Path, "cannot read the archive back", ExitCode::Internal};
  return writeFileAtomically(Path, Out);
}

} // namespace vorion::splat
