/// The time of a frame on the machine, by stage. There is no time if only some
/// of its kernels were timed.
#pragma once

#include "render/Renderer.h"

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// Time of a frame, from projection to the complete picture, without upload of
/// the scene and readback of the picture.
struct FrameMilliseconds {
  double Kernels = 0, Launches = 0, Copies = 0;
  double all() const { return Kernels + Launches + Copies; }
};
/// Empty without the clock.
std::optional<FrameMilliseconds>
frameMilliseconds(const std::vector<StageReport> &Stages);
/// \name Sums over the kernels of a stage or the frame; empty unless all were
/// timed
/// @{
std::optional<TimeReport> stageTime(const StageReport &S);
std::optional<TimeReport> frameTime(const std::vector<StageReport> &Stages);
/// @}

/// JSON of the frame: cycles of each stage and unit, frames per second. Null
/// without the clock.
nlohmann::ordered_json frameJson(const std::vector<StageReport> &Stages);
/// The same as a table, with \p What in place of "frame", such as "iteration";
/// empty without the clock.
std::string frameText(const std::vector<StageReport> &Stages,
                      const std::string &What = "frame");

/// JSON of a sequence: throughput, latency of each picture, busy times of
/// cores, rasterizers and pixel units, the bottleneck among them, and the
/// overlap of their work. Null without the clock.
nlohmann::ordered_json sequenceJson(const SequenceResult &R);
/// The same as a table; empty without the clock.
std::string sequenceText(const SequenceResult &R);

} // namespace vorion::splat
