#include "commands/WatchedFiles.h"

#include "doctor/Variables.h"
#include "vorion/support/Environment.h"

#include <sstream>
#include <string>

namespace vorion::splat {

std::vector<NamedFile> watchedFiles() {
  std::vector<NamedFile> All;
  for (const KnownVariable &Known : knownVariables()) {
    const char *Text = environmentVariable(Known.Name);
    if (!Known.Watches || !Text)
      continue;
    // FILE, or among others SETTING=FILE or CATEGORY:FILE.
    All.push_back({Known.Name, Text});
    std::istringstream Parts(Text);
    for (std::string Part; std::getline(Parts, Part, ',');)
      for (const char Mark : {'=', ':'})
        if (const std::size_t At = Part.find(Mark); At != std::string::npos)
          All.push_back({Known.Name, Part.substr(At + 1)});
  }
  return All;
}

} // namespace vorion::splat
