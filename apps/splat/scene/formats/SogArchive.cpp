/// SOG data sets in one file, a zip archive.

#include "io/Zip.h"
#include "scene/ForeignFile.h"
#include "scene/formats/Formats.h"
#include "scene/formats/Sog.h"

#include <algorithm>

namespace vorion::splat {

bool isSog(Bytes File) { return isZip(File); }

Expected<SceneFile> parseSog(const std::string &Where, Bytes File,
                             const ReadOptions &Options) {
  auto Z = ZipArchive::open(Where, "a SOG archive", File);
  if (!Z)
    return Z.error();
  std::vector<std::string> Names;
  Names.reserve(Z->entries());
  for (uint64_t I = 0; I < Z->entries(); ++I)
    Names.push_back(Z->name(I));
  if (std::ranges::find(Names, "meta.json") == Names.end())
    return foreignArchive(Where, Names);
  const auto Meta = Z->read("meta.json");
  if (!Meta)
    return Meta.error();
  return parseSogData(
      Where, Where + ": meta.json", *Meta,
      [&Z](const std::string &Name) { return Z->read(Name); }, Options);
}

} // namespace vorion::splat
