#include "commands/HeatMapFiles.h"

#include "picture/HeatMap.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace vorion::splat {

namespace {

std::string pictureOf(const std::string &Prefix, Heat H) {
  return fmt::format("{}.{}.png", Prefix, name(H));
}

std::string reportOf(const std::string &Prefix) { return Prefix + ".json"; }

/// What stands behind a value of \p H: of cycles, whose they are.
std::string unitOf(Heat H, const DrawnTiles &Drawn) {
  if (H == Heat::Cycles)
    return ", of " + Drawn.On;
  return H == Heat::Saturation ? " %" : "";
}

} // namespace

std::vector<NamedFile> HeatMapFiles::outputs(const std::string &Prefix) {
  if (Prefix.empty())
    return {};
  std::vector<NamedFile> All{{"--heat-map", reportOf(Prefix)}};
  for (const Heat H : Heats)
    All.push_back({"--heat-map", pictureOf(Prefix, H)});
  return All;
}

Expected<HeatMapFiles> HeatMapFiles::begin(std::string Prefix,
                                           DeviceOptions &Options) {
  std::string Region = Options.text("VORION_REGION");
  // Who asks for the tiles in a file, too, gets them there.
  if (std::string Given = Options.text("VORION_TILES"); !Given.empty())
    return HeatMapFiles(std::move(Prefix), std::nullopt, std::move(Given),
                        std::move(Region));
  auto Folder = TemporaryFolder::make("splat-heat-map");
  if (!Folder)
    return Folder.error();
  std::string File = Folder->path() + "/tiles.jsonl";
  Options.set("VORION_TILES", File);
  return HeatMapFiles(std::move(Prefix), std::move(*Folder), std::move(File),
                      std::move(Region));
}

Expected<DrawnTiles> HeatMapFiles::tiles() const {
  auto Drawn = readTileWork(File);
  if (!Region.empty() && (!Drawn || Drawn->Tiles.empty()))
    return Error{
        "",
        fmt::format("no tiles: VORION_REGION={} contains no launch that "
                    "blends, expected a region with the kernel rasterize",
                    Region),
        ExitCode::Usage};
  if (!Drawn || Drawn->Tiles.empty())
    return Error{"",
                 "the device reports nothing about tiles, expected a Vorion "
                 "device with --heat-map",
                 ExitCode::Usage};
  return Drawn;
}

Expected<Success> HeatMapFiles::write(const Camera &View,
                                      nlohmann::ordered_json Report) const {
  if (Prefix.empty())
    return Success{};
  const auto Drawn = tiles();
  if (!Drawn)
    return Drawn.error();
  for (const Heat H : Heats) {
    if (auto Written =
            writePng(pictureOf(Prefix, H),
                     drawHeat(Drawn->Tiles, H, View.Width, View.Height));
        !Written)
      return Written;
    printOut("heat map of {}: {}, up to {:.0f}{}\n", name(H),
             pictureOf(Prefix, H), scaleOf(Drawn->Tiles, H), unitOf(H, *Drawn));
  }
  Report["schema"]["name"] = "splat-heat-map";
  Report["heat_map"] = heatJson(*Drawn);
  return writeFileAtomically(reportOf(Prefix), jsonText(Report, 2) + "\n");
}

} // namespace vorion::splat
