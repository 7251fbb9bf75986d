/// What the numeric sanitizer found in rasterizers and pixel units.
#pragma once

#include "observe/numerics/RasterShadow.h"

#include <nlohmann/json.hpp>

#include <string>

namespace vorion::isasim {

/// Empty if no command was executed. \p Top: how many Gaussians and pixels.
std::string rasterText(const RasterFindings &F, unsigned Top);
nlohmann::ordered_json rasterJson(const RasterFindings &F);

} // namespace vorion::isasim
