/// Holds what pixels are made of against the references in fp64 and fp32.
#pragma once

#include "HardCase.h"
#include "render/PixelLists.h"

#include <string>

namespace vorion::test {

/// What is wrong with the contributors and the median depths of \p L, which
/// \p O drew; empty: nothing.
std::string wrongContributors(const HardCase &C, const splat::RenderOptions &O,
                              const splat::PixelLists &L);

} // namespace vorion::test
