/// Explanation of a plan's effects, as text and as JSON.
#pragma once

#include "render/Plan.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vorion::splat {

/// One line for each program with its files and macros, then one line for each
/// effect, by kind: whether it is on, the form of its code, and the deciding
/// figure.
std::string explain(const RenderPlan &Plan);

/// The same as a JSON array: name, kind, needed, on, code, figure.
nlohmann::ordered_json effectsJson(const EffectPlan &Plan);

} // namespace vorion::splat
