/// SOG data sets in one file, a zip archive.

#include "io/Zip.h"
#include "scene/ForeignFile.h"
#include "scene/formats/Formats.h"
#include "scene/formats/Sog.h"
#include "vorion/support/Json.h"

#include <algorithm>

namespace vorion::splat {

bool isSog(Bytes File) { return isZip(File); }

Expected<SceneFile> parseSog(const std::string &Where, Bytes File,
                             const ReadOptions & /*Options*/) {
  auto Z = ZipArchive::open(Where, "a SOG archive", File);
  if (!Z)
    return Z.error();
  std::vector<std::string> Names;
  Names.reserve(Z->entries());
  for (uint64_t I = 0; I < Z->entries(); ++I)
    Names.push_back(Z->name(I));
  if (std::ranges::find(Names, "meta.json") == Names.end())
    return foreignArchive(Where, Names);
  const auto MetaEntry = Z->find("meta.json");
  if (!MetaEntry)
    return MetaEntry.error();
  const auto Meta = Z->read(*MetaEntry, JsonLimits().Bytes);
  if (!Meta)
    return Meta.error();
  const auto Picture =
      [&Z](const std::string &Name,
           std::size_t Most) -> Expected<std::vector<std::byte>> {
    const auto Entry = Z->find(Name);
    if (!Entry)
      return Entry.error();
    // A WebP is packed already; small ones are let be.
    constexpr std::size_t Again = 16, Small = std::size_t(1) << 20;
    return Z->read(*Entry,
                   std::min(Most, Again * Z->packedSize(*Entry) + Small));
  };
  return parseSogData(Where, Where + ": meta.json", *Meta, Picture);
}

} // namespace vorion::splat
