/// Texts and records about a machine that has stopped.
#pragma once

#include "core/Core.h"
#include "vorion/isasim/Result.h"

#include <memory>
#include <vector>

namespace vorion::isasim {

/// "waits for the rasterizer" and so on: why \p S does not go on.
std::string waitsFor(const WarpState &S);

/// What stopped \p S, which has trapped.
Trap makeTrap(const WarpState &S, const std::shared_ptr<const Image> &Program);

/// "core 0, warp 0: load access fault at 0x... ..." with pc, instruction text,
/// source line and active lanes.
std::string trapReport(const Trap &T);

/// A line for each warp that has not ended: where it is and what it waits for.
/// Warps that wait alike at one pc share a line.
std::string warpReport(const std::vector<std::unique_ptr<Core>> &Cores,
                       const std::shared_ptr<const Image> &Program);

} // namespace vorion::isasim
