/// Checker of accesses outside what the work-item may touch.
#pragma once

#include "observe/check/Check.h"

#include <vector>

namespace vorion::isasim {

class BoundsCheck : public Check {
public:
  BoundsCheck(Reporter Out, const Places &Where) : Out(Out), Where(Where) {}
  /// What runs over the end of a buffer does not reach the next one.
  uint64_t guardBytes() const override { return 4096; }
  void runBegins(const RunStart &R) override;
  void fetch(const Step &S) override;
  void rasterCommand(const raster::CommandWork &W) override;

private:
  void checkRange(const raster::CommandWork &W, const char *What,
                  uint32_t Address, uint64_t Bytes);

  Reporter Out;
  const Places &Where;
  std::vector<Culprit> Starts; ///< who started a command last, by core
};

} // namespace vorion::isasim
