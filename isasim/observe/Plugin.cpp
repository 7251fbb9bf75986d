/// Loads shared objects whose observers watch runs.
#include "vorion/isasim/Plugin.h"

#include "observe/Tool.h"

#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>

namespace vorion::isasim {

namespace {

/// \p Path stays loaded: its code is needed until the process ends.
Expected<std::unique_ptr<Observer>> load(const std::string &Path) {
  // With a folder, or the system's would be searched.
  void *Library =
      dlopen(std::filesystem::absolute(Path).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!Library)
    return Error{Path,
                 fmt::format("cannot be loaded: {}, expected a plugin of the "
                             "simulator",
                             dlerror())};
  const auto *Found =
      static_cast<const Plugin *>(dlsym(Library, "vorion_plugin"));
  if (!Found)
    return Error{Path, "has no vorion_plugin, expected a plugin of the "
                       "simulator"};
  if (Found->Version != PluginVersion)
    return Error{Path, fmt::format("is a plugin of version {}, expected {}",
                                   Found->Version, PluginVersion)};
  if (Found->Layout != pluginLayout())
    return Error{Path, "was built with other headers, expected those of this "
                       "simulator"};
  std::unique_ptr<Observer> Made = Found->Make();
  if (!Made)
    return Error{Path, "made no observer, expected one"};
  return Made;
}

class PluginTool : public Tool {
public:
  explicit PluginTool(std::vector<std::unique_ptr<Observer>> MadeIn)
      : Made(std::move(MadeIn)) {}
  std::vector<Observer *> observers() override {
    std::vector<Observer *> All;
    All.reserve(Made.size());
    for (const auto &O : Made)
      All.push_back(O.get());
    return All;
  }

private:
  std::vector<std::unique_ptr<Observer>> Made;
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &) {
  std::vector<std::unique_ptr<Observer>> All;
  std::istringstream Paths(Text);
  for (std::string Path; std::getline(Paths, Path, ',');) {
    Expected<std::unique_ptr<Observer>> Made = load(Path);
    if (!Made)
      return Made.error();
    All.push_back(std::move(*Made));
  }
  return std::unique_ptr<Tool>(std::make_unique<PluginTool>(std::move(All)));
}

} // namespace

const ToolKind tools::Plugins{.Make = make};

} // namespace vorion::isasim
