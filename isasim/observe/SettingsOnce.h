/// That a list of settings, as "file=a,core=2", has each of them once: of two,
/// one would be without effect.
#pragma once

#include "vorion/support/Expected.h"

#include <fmt/format.h>
#include <set>
#include <string>
#include <string_view>

namespace vorion::isasim {

class SettingsOnce {
public:
  /// Whether \p Setting, "NAME=VALUE", is the first of its name.
  bool isNew(std::string_view Setting) {
    return Names.emplace(nameOf(Setting)).second;
  }
  /// Of one that is not; \p Of is what takes the settings.
  static Error twice(std::string_view Of, std::string_view Setting) {
    return {"",
            fmt::format("{} setting '{}', expected '{}' only once", Of, Setting,
                        nameOf(Setting)),
            ExitCode::Usage};
  }

private:
  static std::string_view nameOf(std::string_view Setting) {
    return Setting.substr(0, Setting.find('='));
  }
  std::set<std::string, std::less<>> Names;
};

} // namespace vorion::isasim
