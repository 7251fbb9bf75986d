/// The input files of a command, for claimOutputs(): no output may be an input.
#pragma once

#include "vorion/support/Outputs.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// Collects input files with their names in messages. A scene, a capture or
/// cameras may consist of many files in folders, which are all added. Empty
/// paths are ignored.
class InputFiles {
public:
  InputFiles &file(const std::string &Name, const std::string &Path);
  InputFiles &scene(const std::string &Path,
                    const std::string &Name = "the scene");
  InputFiles &capture(const std::string &Path);
  InputFiles &cameras(const std::string &Path);
  /// The files of observers that environment variables request.
  InputFiles &watched();

  const std::vector<NamedFile> &named() const { return Named; }

private:
  InputFiles &add(const std::string &Name, const std::vector<std::string> &Of);

  std::vector<NamedFile> Named;
};

} // namespace vorion::splat
