/// What a plan's effects are and why, for people and for programs.
#pragma once

#include "render/Plan.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vorion::splat {

/// A line a program with its files and macros, then a line an effect, by kind:
/// whether it is on, in which form its code is there, and the figure that
/// decided.
std::string explain(const RenderPlan &Plan);

/// JSON array of the same: name, kind, needed, on, code, figure.
nlohmann::ordered_json effectsJson(const EffectPlan &Plan);

} // namespace vorion::splat
