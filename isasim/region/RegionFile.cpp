#include "region/RegionFile.h"

#include "machine/ByteStream.h"
#include "region/RegionFormat.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <string_view>

namespace vorion::isasim {

namespace {

constexpr std::string_view Magic = RegionMagic;
constexpr size_t VersionAt = Magic.size() - 2;

/// Writes or reads a launch.
template <typename Stream, typename SavedLaunch>
void exchange(Stream &S, SavedLaunch &L) {
  S.text(L.Name);
  S.value(L.Image);
  S.flag(L.IsFresh);
  S.list(L.ImageData);
  S.value(L.Block);
  S.flag(L.IsCounted);
  S.list(L.Pages);
  S.list(L.PageBytes);
  S.value(L.Changes);
}

/// Takes the records of a file.
class RegionParser {
public:
  RegionParser(SavedRegion &RegionIn, const std::string &WhereIn)
      : Region(RegionIn), Where(WhereIn) {}

  Expected<Success> parse(ByteReader Records);

private:
  Error damaged() const {
    return {
        Where,
        fmt::format("record {} is damaged, expected an unmodified region file",
                    Number)};
  }
  Expected<Success> machine(ByteReader R);
  Expected<Success> image(ByteReader R);
  Expected<Success> launch(ByteReader R);

  SavedRegion &Region;
  const std::string &Where;
  unsigned Number = 0; ///< of the record, from 1
};

Expected<Success> RegionParser::parse(ByteReader Records) {
  while (!Records.atEnd()) {
    ++Number;
    RecordHead Head;
    Records.value(Head);
    const auto Bytes = Records.raw(Head.Bytes);
    if (!Records.good() || sumOf(Bytes) != Head.Sum ||
        (Head.Kind == OfMachine) != (Number == 1))
      return damaged();
    const ByteReader R(Bytes);
    const auto Taken = Head.Kind == OfMachine  ? machine(R)
                       : Head.Kind == OfImage  ? image(R)
                       : Head.Kind == OfLaunch ? launch(R)
                                               : damaged();
    if (!Taken)
      return Taken;
  }
  if (Region.Launches.empty())
    return Error{Where, "no launch, expected a region that was reached"};
  return Success{};
}

Expected<Success> RegionParser::machine(ByteReader R) {
  std::string Text;
  R.text(Text);
  R.list(Region.RasterState);
  if (!R.atEnd())
    return damaged();
  const Expected<Config> C = parseConfig(Text, Where);
  if (!C)
    return C.error();
  Region.Machine = *C;
  return Success{};
}

Expected<Success> RegionParser::image(ByteReader R) {
  std::string Name;
  std::vector<std::byte> File;
  R.text(Name);
  R.list(File);
  if (!R.atEnd())
    return damaged();
  const auto Program = Image::parse(File, Name);
  if (!Program)
    return Error{Where,
                 fmt::format("image '{}': {}", Name, Program.error().What)};
  Region.Images.push_back(*Program);
  return Success{};
}

Expected<Success> RegionParser::launch(ByteReader R) {
  SavedLaunch L;
  exchange(R, L);
  if (!R.atEnd() || L.Image >= Region.Images.size() ||
      (Region.Launches.empty() && !L.IsFresh))
    return damaged();
  Region.Launches.push_back(std::move(L));
  return Success{};
}

} // namespace

bool isRegion(std::span<const std::byte> File) {
  const auto Begin = std::as_bytes(std::span(Magic.substr(0, VersionAt)));
  return File.size() >= Begin.size() &&
         std::ranges::equal(File.first(Begin.size()), Begin);
}

Expected<SavedRegion> parseRegion(std::span<const std::byte> File,
                                  const std::string &Where) {
  ByteReader R(File);
  const auto Begin = R.raw(Magic.size());
  if (R.good() && !std::ranges::equal(Begin, std::as_bytes(std::span(Magic))))
    return Error{
        Where, fmt::format("an unsupported region version, expected version {}",
                           Magic.substr(VersionAt, 1))};
  uint64_t Bytes = 0;
  R.value(Bytes);
  const size_t Head = Magic.size() + sizeof(Bytes);
  if (!R.good() || File.size() - Head != Bytes)
    return Error{Where, fmt::format("{} bytes, expected {}: the region is "
                                    "truncated, or was not completely saved",
                                    File.size(), Head + Bytes)};
  SavedRegion Region;
  if (const Expected<Success> Ok =
          RegionParser(Region, Where).parse(ByteReader(File.subspan(Head)));
      !Ok)
    return Ok.error();
  return Region;
}

Expected<Success> checkMachine(const SavedRegion &R, const Config &C,
                               const std::string &Where) {
  Config Same = C;
  Same.Timing = R.Machine.Timing;
  Same.Raster.QueueDepth = R.Machine.Raster.QueueDepth;
  const std::vector<std::string> Changes = changesOf(R.Machine, Same);
  if (Changes.empty())
    return Success{};
  return Error{
      Where,
      fmt::format("{} differs from the machine that saved the region, expected "
                  "differences in 'timing' and 'raster.queue_depth' only",
                  Changes.front()),
      ExitCode::Usage};
}

Expected<RegionWriter> RegionWriter::create(const std::string &Path,
                                            const Machine &M) {
  const auto State = M.rasterState();
  assert(State && "no command is under way");
  Expected<GrowingFile> File = GrowingFile::open(Path);
  if (!File)
    return File.error();
  Expected<MemoryChanges> Memory = MemoryChanges::of(M);
  if (!Memory)
    return Memory.error();
  RegionWriter W(std::move(*File), std::move(*Memory));
  std::FILE *F = W.File.stream();
  static_cast<void>(std::fwrite(Magic.data(), 1, Magic.size(), F));
  static_cast<void>(std::fwrite(&W.Bytes, sizeof(W.Bytes), 1, F));
  ByteWriter Record;
  Record.text(toJson(M.config()));
  Record.list(*State);
  W.append(OfMachine, Record.bytes());
  return W;
}

void RegionWriter::append(uint64_t Kind, std::span<const std::byte> Record) {
  const RecordHead Head{Kind, Record.size(), sumOf(Record)};
  static_cast<void>(std::fwrite(&Head, sizeof(Head), 1, File.stream()));
  static_cast<void>(
      std::fwrite(Record.data(), 1, Record.size(), File.stream()));
  Bytes += sizeof(Head) + Record.size();
}

Expected<Success> RegionWriter::complete() {
  constexpr std::string_view What = "the region's memory";
  std::FILE *F = File.stream();
  const bool HasSize =
      std::fseek(F, static_cast<long>(Magic.size()), SEEK_SET) == 0 &&
      std::fwrite(&Bytes, sizeof(Bytes), 1, F) == 1 &&
      std::fseek(F, 0, SEEK_END) == 0;
  if (!HasSize)
    return File.incomplete(What);
  return File.complete(What);
}

void RegionWriter::begin(const Machine &M, const std::string &Name,
                         uint32_t Block, bool IsCounted) {
  auto Known = std::ranges::find(Images, M.image());
  if (Known == Images.end()) {
    ByteWriter Record;
    Record.text(M.image()->name());
    const auto Elf = M.image()->file();
    Record.list(std::vector(Elf.begin(), Elf.end()));
    append(OfImage, Record.bytes());
    Images.push_back(M.image());
    Known = std::prev(Images.end());
  }
  Launch.emplace();
  Launch->Name = Name;
  Launch->Image = static_cast<uint32_t>(Known - Images.begin());
  if (Current != M.image()) {
    Launch->IsFresh = true;
    Launch->ImageData = M.imageData();
    Current = M.image();
  }
  Launch->Block = Block;
  Launch->IsCounted = IsCounted;
  Launch->Pages = Memory.take();
  for (const MemoryChanges::Page P : Launch->Pages) {
    const auto Page = Memory.bytes(P);
    Launch->PageBytes.insert(Launch->PageBytes.end(), Page.begin(), Page.end());
  }
}

Expected<Success> RegionWriter::end() {
  Launch->Changes = Memory.takeDigest();
  ByteWriter Record;
  exchange(Record, *Launch);
  Launch.reset();
  append(OfLaunch, Record.bytes());
  return complete();
}

} // namespace vorion::isasim
