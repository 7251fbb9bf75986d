/// What every warp and rasterizer did and when, for Perfetto
/// (docs/debugging.md, "Timeline").
#pragma once

#include "observe/TraceEvents.h"
#include "vorion/isasim/Observer.h"

#include <cstdio>
#include <string>
#include <vector>

namespace vorion::isasim {

/// Time here is counted, not modelled: a microsecond stands for one warp
/// instruction of a core. Between two points where all cores are parked, all
/// cores start at once, and the longest decides where the next part starts. A
/// rasterizer's span is as long as its lanes need for the fragments at one lane
/// slot each, from the point where its command was executed or the end of its
/// span before.
class Timeline : public Observer {
public:
  /// \p File as for TraceEvents. It is complete after every run.
  explicit Timeline(std::FILE *File)
      : Out(File, "1 warp instruction of a core, or 1 clock of a rasterizer's "
                  "lanes") {}

  void runNamed(const std::string &Name) override { RunName = Name; }
  void runBegins(const RunStart &R) override;
  void syncPoint(std::span<const std::unique_ptr<Core>> Cores) override;
  void rasterCommand(const raster::CommandWork &W) override;
  void runEnds(const RunResult &R) override;

private:
  struct Slice {
    std::string Name;
    uint64_t From = 0, To = 0;
  };
  /// One row of the picture.
  struct Row {
    unsigned Process = 0, Thread = 0;
    Slice Last; ///< not yet written: it may grow
    uint64_t Retired = 0;
  };

  void add(Row &R, const std::string &Name, uint64_t From, uint64_t To);
  void flush(Row &R);

  TraceEvents Out;
  std::string RunName;
  std::shared_ptr<const Image> Program;
  std::vector<Row> Warps, Units;
  unsigned CoresPerUnit = 1;
  uint64_t Now = 0, RunBegan = 0;
  unsigned Runs = 0;
};

} // namespace vorion::isasim
