/// The machine that a Vorion device is, as reports have it.
#pragma once

#include "device/DeviceOptions.h"
#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>

namespace vorion::splat {

/// What VORION_CONFIG of \p O says, a machine's name, a file or the text
/// itself, with the values that VORION_SET changes
/// (runtime/include/vorion/runtime.h) and the plugins of VORION_PLUGINS, of
/// which one may compute the rasterizers' exponentials (docs/plugins.md).
Expected<nlohmann::ordered_json> machineConfiguration(const DeviceOptions &O);

} // namespace vorion::splat
