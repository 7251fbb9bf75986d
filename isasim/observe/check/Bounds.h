/// Checkers of single accesses: outside what the work-item may touch, and
/// misaligned.
#pragma once

#include "observe/check/Check.h"

#include <vector>

namespace vorion::isasim {

class BoundsCheck : public Check {
public:
  BoundsCheck(Findings &OutIn, const Places &WhereIn)
      : Out(OutIn), Where(WhereIn) {}
  /// What runs over the end of a buffer does not reach the next one.
  uint64_t guardBytes() const override { return 4096; }
  void runBegins(const RunStart &R) override;
  void fetch(const Step &S) override;
  void rasterCommand(const raster::CommandWork &W) override;

private:
  void checkRange(const raster::CommandWork &W, const char *What,
                  uint32_t Address, uint64_t Bytes);

  Findings &Out;
  const Places &Where;
  std::vector<Culprit> Starts; ///< who started a command last, by core
};

class AlignCheck : public Check {
public:
  AlignCheck(Findings &OutIn, const Places &WhereIn)
      : Out(OutIn), Where(WhereIn) {}
  void fetch(const Step &S) override;

private:
  Findings &Out;
  const Places &Where;
};

/// "store of 4 bytes at 0x..., 0 bytes past the end of ..."
std::string describeAccess(const Step &S, unsigned Lane, const Places &Where);

} // namespace vorion::isasim
