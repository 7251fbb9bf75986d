/// The machine that a Vorion device is, as the environment asks for it.
#pragma once

#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>

namespace vorion::splat {

/// What VORION_CONFIG names, a file or the text itself, with the values that
/// VORION_SET changes, as reports have it (runtime/include/vorion/runtime.h).
Expected<nlohmann::ordered_json> machineConfiguration();

} // namespace vorion::splat
