/// `--tiles`: what each command of the rasterizers was, and how long it took.

#include "observe/Tool.h"
#include "raster/WorkLog.h"
#include "timing/common/TimeObserver.h"
#include "vorion/isasim/Machine.h"
#include "vorion/support/GrowingFile.h"
#include "vorion/support/Json.h"

#include <nlohmann/json.hpp>

namespace vorion::isasim {

namespace {

using Json = nlohmann::ordered_json;

class TilesTool : public Tool, public TimeObserver {
public:
  explicit TilesTool(GrowingFile FileIn) : File(std::move(FileIn)) {}

  Expected<Success> attach(Machine &M) override {
    OnMachine = nameOf(M.config()).Name;
    ClockMhz = M.config().Timing.ClockMhz;
    return Success{};
  }
  std::vector<TimeObserver *> timeObservers() override { return {this}; }
  Expected<Success> runEnded(const std::string &, const RunResult &) override {
    ++Run;
    return File.complete();
  }

  void tile(const raster::CommandWork &W, CycleSpan When) override {
    Json Line = begin("rasterizer", W, When);
    Line.update({{"backward", W.What.IsBackward},
                 {"handed_over", W.HandedOver},
                 {"gaussians", W.Counts.Gaussians},
                 {"clipped", W.Counts.Clipped},
                 {"fragments", W.Counts.Fragments},
                 {"blends", W.Counts.Blends}});
    write(Line);
  }
  void tileRest(const raster::TailWork &W, CycleSpan When) override {
    Json Line = begin("pixel unit", W, When);
    Line.update({{"pixels", W.Counts.TailPixels},
                 {"visits", W.Counts.TailVisits},
                 {"blends", W.Counts.TailBlends}});
    write(Line);
  }

private:
  /// What the work of either unit has.
  Json begin(const char *Unit, const auto &W, CycleSpan When) const {
    return {{"machine", OnMachine},
            {"clock_mhz", ClockMhz},
            {"clock_version", ClockVersion},
            {"unit", Unit},
            {"run", Run},
            {"core", W.Core},
            {"x", W.What.X},
            {"y", W.What.Y},
            {"width", W.What.Width},
            {"height", W.What.Height},
            {"begin", When.From},
            {"end", When.Until},
            {"status", W.Status},
            {"list", W.What.Count},
            {"saturated", W.Saturated}};
  }
  void write(const Json &Line) {
    append(File.stream(), "{}\n", jsonText(Line));
  }

  GrowingFile File;
  std::string OnMachine; ///< its name
  uint32_t ClockMhz = 0;
  uint64_t Run = 1; ///< the one that goes on
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &) {
  Expected<GrowingFile> File = GrowingFile::open(Text);
  if (!File)
    return File.error();
  return std::unique_ptr<Tool>(std::make_unique<TilesTool>(std::move(*File)));
}

std::vector<NamedFile> outputs(const std::string &Text) {
  return {{"--tiles", Text}};
}

} // namespace

const ToolKind tools::Tiles{
    .Make = make, .Outputs = outputs, .NeedsClock = true};

} // namespace vorion::isasim
