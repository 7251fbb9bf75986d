/// The numeric sanitizer of `--numerics`: every fp32 value has a double beside
/// it, and where the two part is reported (docs/numeric-sanitizer.md).
#pragma once

#include "observe/numerics/CoreShadow.h"
#include "observe/numerics/RasterShadow.h"
#include "vorion/support/Expected.h"

#include <string>
#include <string_view>

namespace vorion::isasim {

struct NumericOptions {
  NumericLimits Limits;
  unsigned Top = 10; ///< lines that the text shows
  std::string Text;  ///< file; "-" for stdout, empty for none
  std::string Json;  ///< file; empty for none

  /// \p Text: "on", or settings rel=R, cancel=BITS, top=N, text=FILE, json=FILE
  /// apart by commas. Without a file the text goes to stdout.
  static Expected<NumericOptions> parse(std::string_view Text);
};

class Numerics : public Observer {
public:
  explicit Numerics(NumericOptions O);

  /// The host has written global memory: that is exact as it is.
  void hostWrote(uint32_t Address, uint64_t Bytes) override {
    Memory.drop(0, Address, Bytes);
  }

  void runBegins(const RunStart &R) override;
  void fetch(const Step &S) override { Cores.fetch(S); }
  void commit(const Commit &C) override { Cores.commit(C); }

  void rasterCommand(const raster::CommandWork &W) override {
    Units.rasterCommand(W);
  }
  void tail(const raster::TailWork &W) override { Units.tail(W); }

  /// Of all runs so far.
  std::string text() const;
  std::string json() const;

private:
  NumericOptions Options;
  NumericSites Sites;
  ShadowMemory Memory;
  CoreShadow Cores;
  RasterShadow Units;
  uint64_t Runs = 0;
};

} // namespace vorion::isasim
