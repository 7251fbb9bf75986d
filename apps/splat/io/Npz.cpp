// Archives of arrays; Npy.cpp has the arrays.
#include "io/Npz.h"
#include "io/NpyFormat.h"
#include "io/Zip.h"

#include "vorion/support/File.h"

#include <fmt/format.h>
#include <map>

namespace vorion::splat {

Expected<Npz> readNpz(const std::string &Path) {
  // Through memory, so that a folder or a pipe gets readFile's message.
  const auto File = readFile(Path);
  if (!File)
    return File.error();
  auto Z = ZipArchive::open(Path, "an .npz archive", *File);
  if (!Z)
    return Z.error();
  Npz Arrays;
  for (uint64_t I = 0; I < Z->entries(); ++I) {
    std::string Key = Z->name(I);
    const std::string Where = fmt::format("{}: {}", Path, Key);
    if (!Key.ends_with(".npy"))
      return Error{Where, "expected only .npy entries"};
    Key.resize(Key.size() - 4);
    const auto Bytes = Z->read(I);
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
  std::map<std::string, std::string> Entries;
  for (const auto &[Name, A] : Arrays)
    Entries[Name + ".npy"] = formatNpy(A);
  const auto Archive = makeZip(Path, Entries);
  if (!Archive)
    return Archive.error();
  return writeFileAtomically(Path, *Archive);
}

} // namespace vorion::splat
