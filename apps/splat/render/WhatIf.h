/// What bounds the stages of a frame, and what other settings of the machine
/// would change. Figures of other settings are measured; where none is, the
/// text and JSON say so.
#pragma once

#include "render/EffectCosts.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// A frame on the machine with other settings.
struct WhatIf {
  std::string Settings;         ///< KEY=VALUE,...
  nlohmann::ordered_json Frame; ///< as of frameJson()
  std::string PictureHash;
};

/// Draws \p C by \p Plan with each of \p Settings, in a process and on a
/// machine of its own, as \p OpenWith opens it.
Expected<std::vector<WhatIf>>
measureWhatIf(const std::vector<std::string> &Settings,
              const std::function<DeviceOpener(const std::string &)> &OpenWith,
              const std::string &KernelFolder, const RenderPlan &Plan,
              const EffectInputs &In, const Camera &C,
              const std::function<void(std::string_view)> &Progress);

/// The stages of \p Frame, of frameJson(), with the reason of most of their
/// cycles, the rates of the unit and of DRAM as fractions of their peaks, and
/// what helps: the best of \p All with its time, and a setting that was not
/// measured, which adds what the stage waits for.
nlohmann::ordered_json boundsJson(const nlohmann::ordered_json &Frame,
                                  const std::vector<WhatIf> &All);

/// \p All with their times, and whether their picture has the hash \p Hash.
nlohmann::ordered_json whatIfJson(const std::vector<WhatIf> &All,
                                  const std::string &Hash);

/// The same as text, and a table of \p All, if there are any; \p Hash is of the
/// picture, and empty where nothing else can be measured. Empty without the
/// clock.
std::string boundsText(const nlohmann::ordered_json &Frame,
                       const std::vector<WhatIf> &All, const std::string &Hash);

} // namespace vorion::splat
