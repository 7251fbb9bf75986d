#include "device/TileWork.h"

#include "device/ClockedMachine.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <ranges>
#include <string_view>
#include <utility>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// Adds a line of the device's file.
void addLine(std::map<std::pair<int, int>, TileWork> &To, const Json &Line) {
  const int X = Line.at("x"), Y = Line.at("y");
  TileWork &T = To[{Y, X}];
  T.X = X;
  T.Y = Y;
  T.Width = Line.at("width");
  T.Height = Line.at("height");
  T.Blends += Line.at("blends").get<uint64_t>();
  T.Saturated += Line.at("saturated").get<uint64_t>();
  const uint64_t Cycles =
      Line.at("end").get<uint64_t>() - Line.at("begin").get<uint64_t>();
  if (Line.at("unit") != "rasterizer") {
    T.PixelUnitCycles += Cycles;
    return;
  }
  T.Cycles += Cycles;
  T.List += Line.at("list").get<uint64_t>();
  T.Pixels += static_cast<uint64_t>(T.Width) * static_cast<uint64_t>(T.Height);
}

} // namespace

Expected<DrawnTiles> readTileWork(const std::string &File) {
  const auto Bytes = readFile(File);
  if (!Bytes)
    return Bytes.error();
  std::string_view Text(reinterpret_cast<const char *>(Bytes->data()),
                        Bytes->size());
  std::map<std::pair<int, int>, TileWork> ByPlace;
  DrawnTiles Drawn;
  while (!Text.empty()) {
    const std::size_t End = std::min(Text.find('\n'), Text.size());
    const auto Line = parseJson<Json>(Text.substr(0, End), File, "a tile");
    if (!Line)
      return Line.error();
    try {
      addLine(ByPlace, *Line);
      // A line names its machine and clock as a time report does.
      Drawn.On = clockedMachine(*Line);
    } catch (const Json::exception &) {
      return Error{File, "no tiles, expected lines of VORION_TILES"};
    }
    Text.remove_prefix(std::min(End + 1, Text.size()));
  }
  std::ranges::copy(std::views::values(ByPlace),
                    std::back_inserter(Drawn.Tiles));
  return Drawn;
}

} // namespace vorion::splat
