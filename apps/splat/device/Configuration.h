/// The configuration of a Vorion device in reports.
#pragma once

#include "device/DeviceOptions.h"
#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>

namespace vorion::splat {

/// The value of VORION_CONFIG of \p O (the name of a machine, a file, or JSON
/// text), the changes of VORION_SET (runtime/include/vorion/runtime.h), and the
/// plugins of VORION_PLUGINS, one of which may compute the rasterizers'
/// exponentials (docs/plugins.md).
Expected<nlohmann::ordered_json> machineConfiguration(const DeviceOptions &O);

} // namespace vorion::splat
