/// Loads shared objects: observers that watch runs, exponential units, and
/// policies of the clock.
#include "vorion/isasim/Plugin.h"

#include "observe/Tool.h"
#include "raster/PluggedExp.h"
#include "timing/policy/Policy.h"

#include <algorithm>
#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

namespace vorion::isasim {

namespace {

/// What the shared object defines. It stays loaded: its code is needed until
/// the process ends.
Expected<const Plugin *> load(const std::string &Path) {
  if (std::error_code Problem; !std::filesystem::exists(Path, Problem))
    return Error{Path, "no such file, expected a plugin of the simulator"};
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
    return Error{Path, "was built with headers of another version, expected "
                       "those of this simulator"};
  const PolicyMakers &P = Found->Policies;
  if (!Found->Make && !Found->Exp.Evaluate && !P.Cache && !P.Dram && !P.Warps)
    return Error{Path, "has no observer, exponential unit or policy, expected "
                       "at least one"};
  return Found;
}

/// Every machine of the process loads the same plugins.
Expected<Success> plug(const std::string &Path, const ExpUnitPlugin &Unit,
                       const ToolOutput &To) {
  const std::string_view Replaces = Unit.Replaces ? Unit.Replaces : "";
  const auto *const Old =
      std::ranges::find(raster::ExpUnits, Replaces, &raster::ExpUnit::Name);
  if (Old == std::end(raster::ExpUnits)) {
    std::vector<std::string_view> Names;
    for (const raster::ExpUnit &U : raster::ExpUnits)
      Names.push_back(U.Name);
    return Error{Path, fmt::format("replaces the exponential unit '{}', "
                                   "expected one of {}",
                                   Replaces, fmt::join(Names, ", "))};
  }
  if (raster::PluggedExp && raster::PluggedExp != Unit.Evaluate)
    return Error{
        Path,
        "has a second exponential unit, expected at most one per process"};
  if (!raster::PluggedExp) { // another machine may read it already
    To.Report(
        fmt::format("{}: computes the exponential unit '{}'", Path, Replaces));
    raster::plugExp(static_cast<uint32_t>(Old - std::begin(raster::ExpUnits)),
                    Unit.Evaluate);
  }
  return Success{};
}

/// The maker of one policy, \p What.
template <typename Maker>
Expected<Success> plug(const std::string &Path, Maker New, Maker &Old,
                       std::string_view What, const ToolOutput &To) {
  if (!New || New == Old)
    return Success{};
  if (Old)
    return Error{Path, fmt::format("{} a second time, expected at most one "
                                   "plugin of a process that does",
                                   What)};
  Old = New;
  To.Report(fmt::format("{}: {}", Path, What));
  return Success{};
}

Expected<Success> plug(const std::string &Path, const PolicyMakers &New,
                       const ToolOutput &To) {
  PolicyMakers &Old = pluggedPolicies();
  if (auto Ok =
          plug(Path, New.Cache, Old.Cache, "replaces lines of data caches", To);
      !Ok)
    return Ok;
  if (auto Ok = plug(Path, New.Dram, Old.Dram, "schedules DRAM", To); !Ok)
    return Ok;
  return plug(Path, New.Warps, Old.Warps, "schedules warps", To);
}

class PluginTool : public Tool {
public:
  explicit PluginTool(std::string Text,
                      std::vector<std::unique_ptr<Observer>> MadeIn)
      : Plugins(std::move(Text)), Made(std::move(MadeIn)) {}
  std::vector<Observer *> observers() override {
    std::vector<Observer *> All;
    All.reserve(Made.size());
    for (const auto &O : Made)
      All.push_back(O.get());
    return All;
  }
  Expected<Success> runEnded(const std::string & /*Name*/,
                             const RunResult & /*R*/) override {
    std::string Fault = takePolicyFault();
    return Fault.empty() ? Expected<Success>(Success{})
                         : Error{Plugins, std::move(Fault)};
  }

private:
  std::string Plugins; ///< the files
  std::vector<std::unique_ptr<Observer>> Made;
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &To) {
  std::vector<std::unique_ptr<Observer>> All;
  std::istringstream Paths(Text);
  for (std::string Path; std::getline(Paths, Path, ',');) {
    const Expected<const Plugin *> Found = load(Path);
    if (!Found)
      return Found.error();
    if ((*Found)->Exp.Evaluate)
      if (auto Ok = plug(Path, (*Found)->Exp, To); !Ok)
        return Ok.error();
    if (auto Ok = plug(Path, (*Found)->Policies, To); !Ok)
      return Ok.error();
    if (!(*Found)->Make)
      continue;
    All.push_back((*Found)->Make());
    if (!All.back())
      return Error{Path, "created no observer, expected one"};
  }
  return std::unique_ptr<Tool>(
      std::make_unique<PluginTool>(Text, std::move(All)));
}

} // namespace

const ToolKind tools::Plugins{.Make = make};

} // namespace vorion::isasim
