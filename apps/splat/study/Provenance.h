/// What measurements, and the files that they need, were made from. What is
/// kept is used only where everything that made it is the same.
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

/// What made something: by the name of each thing that may differ ("scene",
/// "programs"), by which people are told what does, a hash of its contents or
/// the options as they were given. None names a file.
using Provenance = std::map<std::string, std::string>;

/// Of a machine: what it is, and not how its file is called.
Expected<std::string> hashMachine(const DeviceOptions &Machine);

/// What every measurement is made from: the programs and the machine.
Expected<Provenance> commonProvenance(const DeviceOptions &Machine);

/// Of a view: what its picture depends on, its name and number not.
std::string hashView(const Camera &View);

/// Of all that training takes from a capture: pictures, masks, poses, first
/// points, and which views are held out. An Error if a picture cannot be read.
Expected<std::string> hashCapture(const Capture &C);

/// The things in which \p Had, any JSON, is not \p Wanted: "scene and
/// programs"; empty if it is.
std::string difference(const nlohmann::ordered_json &Had,
                       const Provenance &Wanted);

/// The hashes of \p From in a line for the foot of a page: "fnv1a64: machine
/// 0123456789abcdef, scene ...". Options are left out, as the command says
/// them.
std::string hashLine(const Provenance &From);

/// Makes \p Files, by \p Make, unless they are there as an earlier call with
/// the same \p From left them. What they were made from is beside the first
/// one, with the ending .origin.
Expected<Success> makeOnce(const std::vector<std::string> &Files,
                           const Provenance &From,
                           const std::function<Expected<Success>()> &Make);

} // namespace vorion::splat
