#include "accuracy/Rtl.h"

#include "picture/Options.h"
#include "study/Process.h"
#include "vorion/support/Environment.h"

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <string>
#include <system_error>
#include <unistd.h>

namespace vorion::splat {

namespace {

namespace fs = std::filesystem;

/// Few enough that a frame of any scene takes seconds.
constexpr unsigned DrawnTiles = 8;
/// After so many cycles its memory answers, as a hit of the L2 does.
constexpr unsigned Latency = 10;

/// Where \p Name would be started from; empty if nowhere.
std::string inPath(const std::string &Name) {
  const char *Path = environmentVariable("PATH");
  std::istringstream Folders(Path ? Path : "");
  for (std::string Folder; std::getline(Folders, Folder, ':');)
    if (const std::string File = fmt::format("{}/{}", Folder, Name);
        access(File.c_str(), X_OK) == 0)
      return File;
  return {};
}

/// What it is made of, in the tree that this program lies in.
struct Parts {
  std::string Build, Tiles, Plugin;
};

Expected<Parts> findParts() {
  std::error_code Ignored;
  const fs::path Tree =
      fs::read_symlink("/proc/self/exe", Ignored).parent_path().parent_path();
  Parts P{Tree / "share/vorion/rtl/build.sh", Tree / "bin/isasim-raster-tiles",
          Tree / "lib/isasim-tile-writer.so"};
  if (inPath("verilator").empty())
    return Error{"", "not run: Verilator is not installed (Debian package "
                     "verilator)"};
  for (const std::string &File : {P.Build, P.Tiles, P.Plugin})
    if (!fs::exists(File, Ignored))
      return Error{"", fmt::format("not run: {} is missing", File)};
  return P;
}

/// Runs \p Words; \p What names the step in the Error.
Expected<ProcessEnd> run(const char *What, std::vector<std::string> Words,
                         const std::string &Out, const std::string &Log) {
  auto Ended = runProgram(std::move(Words), {}, Out, Log);
  if (Ended && Ended->Code == ExitCode::Ok)
    return Ended;
  return Error{"", fmt::format("not run: {} failed: {}", What,
                               Ended ? lastLine(Log) : Ended.error().What)};
}

unsigned tilesOf(const Camera &View) {
  const auto Along = [](int Pixels) {
    const unsigned Side = RenderOptions().tileSize();
    return (static_cast<unsigned>(Pixels) + Side - 1) / Side;
  };
  return Along(View.Width) * Along(View.Height);
}

/// Parses the last line of the test bench: "8 tiles, 0 wrong pixels; clock 1
/// cycles, RTL 1, error +0.05 %, of a tile at most 1.14 %".
Expected<RtlRun> parse(const std::string &Line) {
  RtlRun R;
  if (std::sscanf(Line.c_str(),
                  "%u tiles, %u wrong pixels; clock %*u cycles, RTL %*u, error "
                  "%lf %%, of a tile at most %lf %%",
                  &R.Tiles, &R.WrongPixels, &R.ErrorPercent,
                  &R.WorstPercent) != 4)
    return Error{"", "not run: unexpected output of the test bench: " + Line};
  return R;
}

} // namespace

Expected<RtlRun> runRtl(const SweepPlan &P, const Camera &View,
                        const std::function<void(std::string_view)> &Log) {
  if (P.Surface)
    return Error{"", "not run: the circuit has no limits of pixels, which a "
                     "mesh needs"};
  const auto Found = findParts();
  if (!Found)
    return Found.error();
  const std::string Folder = P.Folder + "/work/rtl";
  const auto File = [&](const char *Name) { return Folder + "/" + Name; };
  std::error_code Failed;
  fs::create_directories(Folder, Failed);
  Log("rasterizer's RTL: building");
  if (auto Built = run("building", {Found->Build, File("built")},
                       File("build.log"), File("build.log"));
      !Built)
    return Built.error();

  Log("rasterizer's RTL: writing tiles");
  std::vector<std::string> Words =
      renderWords(P, View.Name, File("picture.pfm"));
  Words.insert(Words.end(), {"--exp", "table"});
  DeviceOptions Machine = P.Machine;
  Machine.set("VORION_TIME", "off");
  Machine.set("VORION_PLUGINS", Found->Plugin);
  Machine.set("VORION_RASTER_TILES", File("all"));
  if (auto Drawn = runSplat(Words, Machine, File("render.log")); !Drawn)
    return Error{"", "not run: " + Drawn.error().What};
  auto Drawn =
      run("selecting tiles",
          {Found->Tiles, File("all"), "--latency", fmt::format("{}", Latency),
           "--random", fmt::format("{}", DrawnTiles)},
          File("tiles"), File("tiles.log"));
  fs::remove(File("all"), Failed); // large
  if (!Drawn)
    return Drawn.error();

  Log("rasterizer's RTL: simulating");
  // Any error of cycles is a result.
  const auto Ended = runProgram({File("built/Bench"), File("tiles"), "1e9"}, {},
                                File("bench.log"), File("bench.log"));
  if (!Ended)
    return Ended.error();
  auto R = parse(lastLine(File("bench.log")));
  if (R) {
    R->AllTiles = tilesOf(View);
    R->Seconds = Ended->ProcessorSeconds;
  }
  return R;
}

} // namespace vorion::splat
