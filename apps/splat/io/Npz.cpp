// Archives of arrays; Npy.cpp has the arrays.
#include "io/Npz.h"
#include "io/NpyFormat.h"
#include "io/Zip.h"

#include "vorion/support/File.h"

#include <fmt/format.h>
#include <map>
#include <optional>
#include <utility>

namespace vorion::splat {

struct NpzFile::Content {
  /// Where an array is, and what it unpacks to.
  struct Place {
    uint64_t Entry;
    std::size_t Size;
  };

  std::string Path;
  std::vector<std::byte> Bytes; ///< which the archive views
  std::optional<ZipArchive> Archive;
  std::map<std::string, NpyShape> Shapes;
  std::map<std::string, Place> Places;

  /// Takes the header of an array.
  Expected<Success> add(uint64_t Entry) {
    std::string Key = Archive->name(Entry);
    const std::string Where = fmt::format("{}: {}", Path, Key);
    if (!Key.ends_with(".npy"))
      return Error{Where, "expected only .npy entries"};
    Key.resize(Key.size() - 4);
    const auto Start = Archive->readStart(Entry, MostNpyStart);
    if (!Start)
      return Start.error();
    auto H = parseNpyHeader(Where, *Start);
    if (!H)
      return H.error();
    Places[Key] = {Entry, H->Begin + H->Size};
    Shapes[Key] = {std::move(H->Type), std::move(H->Shape)};
    return Success{};
  }
};

NpzFile::NpzFile(std::unique_ptr<Content> TheContent)
    : Own(std::move(TheContent)) {}
NpzFile::NpzFile(NpzFile &&) noexcept = default;
NpzFile::~NpzFile() = default;

Expected<NpzFile> NpzFile::open(const std::string &Path) {
  // Through memory, so that a folder or a pipe gets readFile's message.
  auto File = readFile(Path);
  if (!File)
    return File.error();
  auto C = std::make_unique<Content>();
  C->Path = Path;
  C->Bytes = std::move(*File);
  auto Z = ZipArchive::open(Path, "an .npz archive", C->Bytes);
  if (!Z)
    return Z.error();
  C->Archive.emplace(std::move(*Z));
  for (uint64_t I = 0; I < C->Archive->entries(); ++I)
    if (auto Added = C->add(I); !Added)
      return Added.error();
  return NpzFile(std::move(C));
}

const std::map<std::string, NpyShape> &NpzFile::shapes() const {
  return Own->Shapes;
}

const NpyShape *NpzFile::find(const std::string &Name) const {
  const auto Found = Own->Shapes.find(Name);
  return Found == Own->Shapes.end() ? nullptr : &Found->second;
}

Expected<NpyArray> NpzFile::read(const std::string &Name) {
  const auto &[Entry, Size] = Own->Places.at(Name);
  auto Bytes = Own->Archive->read(Entry, Size);
  if (!Bytes)
    return Bytes.error();
  return parseNpy(fmt::format("{}: {}.npy", Own->Path, Name),
                  std::move(*Bytes));
}

Expected<Npz> readNpz(const std::string &Path) {
  auto File = NpzFile::open(Path);
  if (!File)
    return File.error();
  Npz Arrays;
  for (const auto &[Name, Shape] : File->shapes()) {
    auto A = File->read(Name);
    if (!A)
      return A.error();
    Arrays[Name] = std::move(*A);
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
