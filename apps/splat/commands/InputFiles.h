/// The files that a command reads, for claimOutputs(): no output may be one.
#pragma once

#include "vorion/support/Outputs.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// Collects them by what they are called in messages. A scene, a capture or
/// cameras may be many files, in folders, and all of them count. Empty paths
/// are files that nobody named.
class InputFiles {
public:
  InputFiles &file(const std::string &Name, const std::string &Path);
  InputFiles &scene(const std::string &Path,
                    const std::string &Name = "the scene");
  InputFiles &capture(const std::string &Path);
  InputFiles &cameras(const std::string &Path);
  /// Those of the environment's variables that watch runs.
  InputFiles &watched();

  const std::vector<NamedFile> &named() const { return Named; }

private:
  InputFiles &add(const std::string &Name, const std::vector<std::string> &Of);

  std::vector<NamedFile> Named;
};

} // namespace vorion::splat
