/// What the numeric sanitizer found, as text and as JSON.
#pragma once

#include "observe/numerics/CoreShadow.h"
#include "observe/numerics/RasterShadow.h"

#include <string>

namespace vorion::isasim {

struct NumericFindings {
  const NumericSites &Sites;
  const RasterFindings &Units;
  const NumericLimits &Limits;
  uint64_t Runs;
  unsigned Top; ///< lines, Gaussians and pixels that the text shows
};

std::string numericText(const NumericFindings &F);
std::string numericJson(const NumericFindings &F);

} // namespace vorion::isasim
