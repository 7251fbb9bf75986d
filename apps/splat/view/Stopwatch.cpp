#include "view/Stopwatch.h"

#include "device/ClockedMachine.h"
#include "study/Process.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// Both settings of two views.
constexpr std::size_t MostKept = 4;

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
  auto Work = readTileWork(Tiles);
  if (!Work)
    return Work.error();
  T.Tiles = std::move(Work->Tiles);
  return T;
}

} // namespace

std::string Stopwatch::sceneFile(uint64_t Number) const {
  return fmt::format("{}/scene-{}", Folder.path(), Number);
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
  Camera View = R.View;
  View.Name = "page";
  if (auto Written = writeCameras(File("cameras.json"), {View}); !Written)
    return Written.error();
  std::vector<std::string> Words{"render", S.Path};
  Words.insert(Words.end(), S.Words.begin(), S.Words.end());
  Words.insert(Words.end(), DeviceWords.begin(), DeviceWords.end());
  Words.insert(Words.end(),
               {"--cameras", File("cameras.json"), "--view", "page", "-o",
                File("picture.pfm"), "--json", File("report.json"), "--time"});
  const auto Knobs = R.Chosen.arguments();
  Words.insert(Words.end(), Knobs.begin(), Knobs.end());
  DeviceOptions Watched = Machine;
  Watched.set("VORION_TILES", File("tiles"));
  // A process that is ended leaves there what it would have removed.
  Watched.set("TMPDIR", Folder.path());
  if (auto Done = runSplat(Words, Watched, File("log"), GiveUp); !Done)
    return GiveUp() ? superseded() : Done.error();
  auto Time = readTime(File("report.json"), File("tiles"));
  if (!Time)
    return Time.error();
  Last.push_front({S.Number, R.View, R.Chosen,
                   std::make_shared<const MachineTime>(std::move(*Time))});
  if (Last.size() > MostKept)
    Last.pop_back();
  return Last.front().Time;
}

} // namespace vorion::splat
