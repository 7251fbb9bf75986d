/// The provenance of measurements and of the files that they need. A stored
/// measurement is used only if its provenance is the same.
#pragma once

#include "capture/Capture.h"
#include "device/DeviceOptions.h"
#include "vorion/support/Expected.h"

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

/// For each input that may differ ("scene", "programs"), the name in messages
/// and the hash of its contents, or the options on the command line. It
/// contains no file names.
using Provenance = std::map<std::string, std::string>;

/// Hash of a machine's configuration, without the name of its file.
Expected<std::string> hashMachine(const DeviceOptions &Machine);

/// The common provenance of all measurements: the programs and the machine.
Expected<Provenance> commonProvenance(const DeviceOptions &Machine);

/// Hash of a view, without its name and number.
std::string hashView(const Camera &View);

/// Hash of the inputs that training reads from a capture: pictures, masks,
/// poses, initial points, and the selection of held-out views. An Error if a
/// picture cannot be read.
Expected<std::string> hashCapture(const Capture &C);

/// The names of the differences between \p Had, any JSON, and \p Wanted: "scene
/// and programs"; empty if they are equal.
std::string difference(const nlohmann::ordered_json &Had,
                       const Provenance &Wanted);

/// The hashes of \p From as a line of a page's footer: "fnv1a64: machine
/// 0123456789abcdef, scene ...", without options, which the command contains.
std::string hashLine(const Provenance &From);

/// Creates \p Files by \p Make, unless they are unchanged since an earlier call
/// with the same \p From. The provenance is stored next to the first file, with
/// the extension .origin.
Expected<Success> makeOnce(const std::vector<std::string> &Files,
                           const Provenance &From,
                           const std::function<Expected<Success>()> &Make);

} // namespace vorion::splat
