#include "Tool.h"

#include <cassert>

namespace vorion::test {

int runTool(CLI::App &App, int Count, char **Values,
            const std::function<Expected<Success>()> &Run) {
  App.footer(std::string(ExitCodeHelp));
  try {
    App.parse(Count, Values);
  } catch (const CLI::Success &E) {
    return App.exit(E); // --help
  } catch (const CLI::ParseError &E) {
    return reportUsageError(App.get_name(), E.what());
  }
  const auto Done = Run();
  return Done ? 0 : reportError(App.get_name(), Done.error());
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
