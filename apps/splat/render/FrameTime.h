/// How long a frame takes on the machine, stage by stage.
#pragma once

#include "Renderer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vorion::splat {

/// JSON of the frame: cycles a stage and a unit, frames a second. The frame is
/// from projecting to the finished picture; uploading a scene and reading the
/// picture back are told apart. Empty without the clock.
std::string frameJson(const std::vector<StageReport> &Stages);
/// The same as a table, in which \p What stands for a frame ("iteration").
std::string frameText(const std::vector<StageReport> &Stages,
                      const std::string &What = "frame");
/// The frame's cycles on the machine; 0 without the clock.
std::uint64_t frameCycles(const std::vector<StageReport> &Stages);

/// JSON of a sequence: throughput, each picture's latency, how long cores,
/// rasterizers and pixel units were busy, which of them bounds the rest, and
/// how much of their work ran beside another's. Empty without the clock.
std::string sequenceJson(const SequenceResult &R);
/// The same as a table.
std::string sequenceText(const SequenceResult &R);

} // namespace vorion::splat
