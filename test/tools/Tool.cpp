#include "Tool.h"

#include "vorion/support/CommandLine.h"
#include "vorion/support/Tool.h"

#include <cassert>

namespace vorion::test {

int runTool(CLI::App &App, int Count, char **Values,
            const std::function<Expected<Success>()> &Run) {
  App.footer(std::string(ExitCodeHelp));
  return vorion::runTool(App.get_name(), [&] {
    if (const auto Ended = parseCommandLine(App, {Values + 1, Values + Count}))
      return *Ended;
    const auto Done = Run();
    return Done ? 0 : reportError(App.get_name(), Done.error());
  });
}

reference::Support supportNamed(const std::string &Name) {
  using reference::Support;
  if (Name == "box3")
    return Support::Box3;
  if (Name == "square3")
    return Support::Square3;
  if (Name == "official16")
    return Support::Official16;
  assert(Name == "exact" && "the command line allows no other");
  return Support::Exact;
}

} // namespace vorion::test
