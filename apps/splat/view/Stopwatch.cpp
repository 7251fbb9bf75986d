#include "view/Stopwatch.h"

#include "device/ClockedMachine.h"
#include "study/Process.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// Both settings of two views.
constexpr std::size_t MostKept = 4;

/// \p Tiles: the file of tiles, empty for none.
Expected<MachineTime> readTime(const std::string &Report,
                               const std::string &Tiles) {
  const auto Read = readJson<Json>(Report, "a report of splat render");
  if (!Read)
    return Read.error();
  MachineTime T;
  const Json &Time = Read->at("time");
  T.Cycles = Time.at("sum").at("cycles");
  T.Milliseconds = Time.at("frame_ms");
  T.On = clockedMachine(Time.at("sum"));
  for (const Json &Stage : Time.at("stages"))
    if (Stage.contains("time"))
      T.Stages.emplace_back(Stage.at("name"), Stage["time"].at("cycles"));
  if (Tiles.empty())
    return T;
  auto Work = readTileWork(Tiles);
  if (!Work)
    return Work.error();
  T.Tiles = std::move(Work->Tiles);
  return T;
}

} // namespace

std::string Stopwatch::sceneFile(uint64_t Number,
                                 std::string_view Ending) const {
  return fmt::format("{}/scene-{}{}", Folder.path(), Number, Ending);
}

std::vector<std::string> Stopwatch::words(const std::string &Scene,
                                          const std::string &Mesh,
                                          const ShownScene &S,
                                          const ViewRequest &R,
                                          const std::string &Cameras) const {
  std::vector<std::string> Words{"render", Scene};
  const auto Append = [&Words](const std::vector<std::string> &More) {
    Words.insert(Words.end(), More.begin(), More.end());
  };
  Append(S.Words);
  if (!Mesh.empty())
    Append({"--mesh", Mesh});
  if (S.Surface && S.Light)
    Append({fmt::format("--light={}", fmt::join(*S.Light, ","))});
  Append(DeviceWords);
  Append({"--cameras", Cameras, "--near",
          fmt::format("{}", optionsOf(R, S).nearLimit())});
  Append(R.Chosen.arguments());
  return Words;
}

Expected<std::shared_ptr<const MachineTime>>
Stopwatch::measure(const ShownScene &S, const ViewRequest &R,
                   const std::function<bool()> &GiveUp) {
  if (!Lock.lockUnless(GiveUp))
    return superseded();
  const std::lock_guard Held(Lock, std::adopt_lock);
  const auto Known = std::ranges::find_if(Last, [&](const Kept &K) {
    return K.Scene == S.Number && K.View == R.View && K.Chosen == R.Chosen;
  });
  if (Known != Last.end())
    return Known->Time;
  if (GiveUp())
    return superseded();
  const auto File = [this](const char *Name) {
    return Folder.path() + "/" + Name;
  };
  if (S.IsTemporary && !std::filesystem::exists(S.Path))
    if (auto Written = writeShown(S.Path, S); !Written)
      return Written.error();
  if (auto Written = writeCameras(File("cameras.json"), {R.View}); !Written)
    return Written.error();
  std::vector<std::string> Words =
      words(S.Path, S.AddedMesh.Path, S, R, File("cameras.json"));
  Words.insert(Words.end(), {"-o", File("picture.pfm"), "--json",
                             File("report.json"), "--time"});
  DeviceOptions Watched = Machine;
  // With a mesh a tile has several commands.
  const std::string Tiles = S.Surface ? "" : File("tiles");
  if (!Tiles.empty())
    Watched.set("VORION_TILES", Tiles);
  // A process that is ended leaves there what it would have removed.
  Watched.set("TMPDIR", Folder.path());
  if (auto Done = runSplat(Words, Watched, File("log"), GiveUp); !Done)
    return GiveUp() ? superseded() : Done.error();
  auto Time = readTime(File("report.json"), Tiles);
  if (!Time)
    return Time.error();
  Last.push_front({S.Number, R.View, R.Chosen,
                   std::make_shared<const MachineTime>(std::move(*Time))});
  if (Last.size() > MostKept)
    Last.pop_back();
  return Last.front().Time;
}

} // namespace vorion::splat
