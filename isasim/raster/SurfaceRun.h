/// One command of opaque primitives in the works (docs/primitives.md).
#pragma once

#include "raster/BatchRun.h"
#include "raster/RasterAgent.h"
#include "raster/RasterMemory.h"
#include "raster/Surfaces.h"

#include <memory>

namespace vorion::raster {

/// The oldest command of \p Agent, whose front end is opaque. Keeps references
/// to the others, which must outlive it. \p Log: who wants to know what is
/// fetched; nullptr for nobody.
std::unique_ptr<BatchRun> makeSurfaceRun(const RasterAgent &Agent,
                                         RasterMemory &Memory,
                                         SurfaceBuffer &Tile,
                                         const WorkLog *Log);

} // namespace vorion::raster
