/// How long a frame takes on the machine, stage by stage. A clock that was on
/// for some of its kernels alone is none.
#pragma once

#include "render/Renderer.h"

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// Of a frame, which is from projecting to the finished picture: uploading a
/// scene and reading the picture back are told apart.
struct FrameMilliseconds {
  double Kernels = 0, Launches = 0, Copies = 0;
  double all() const { return Kernels + Launches + Copies; }
};
/// Nothing without the clock.
std::optional<FrameMilliseconds>
frameMilliseconds(const std::vector<StageReport> &Stages);
/// \name Sums of a stage's or the frame's kernels; nothing unless all were
/// timed
/// @{
std::optional<TimeReport> stageTime(const StageReport &S);
std::optional<TimeReport> frameTime(const std::vector<StageReport> &Stages);
/// @}

/// JSON of the frame: cycles a stage and a unit, frames a second. Null without
/// the clock.
nlohmann::ordered_json frameJson(const std::vector<StageReport> &Stages);
/// The same as a table, in which \p What stands for a frame ("iteration");
/// empty without the clock.
std::string frameText(const std::vector<StageReport> &Stages,
                      const std::string &What = "frame");

/// JSON of a sequence: throughput, each picture's latency, how long cores,
/// rasterizers and pixel units were busy, which of them bounds the rest, and
/// how much of their work ran beside another's. Null without the clock.
nlohmann::ordered_json sequenceJson(const SequenceResult &R);
/// The same as a table; empty without the clock.
std::string sequenceText(const SequenceResult &R);

} // namespace vorion::splat
