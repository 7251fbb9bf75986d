#include "commands/InputFiles.h"

#include "cameras/CameraFile.h"
#include "capture/Capture.h"
#include "commands/WatchedFiles.h"
#include "scene/SceneFiles.h"

namespace vorion::splat {

InputFiles &InputFiles::file(const std::string &Name, const std::string &Path) {
  return add(Name, {Path});
}

InputFiles &InputFiles::scene(const std::string &Path,
                              const std::string &Name) {
  return add(Name, sceneFiles(Path));
}

InputFiles &InputFiles::capture(const std::string &Path) {
  return add("the capture", captureFiles(Path));
}

InputFiles &InputFiles::cameras(const std::string &Path) {
  return Path.empty() ? *this : add("--cameras", cameraFiles(Path));
}

InputFiles &InputFiles::watched() {
  const std::vector<NamedFile> Files = watchedFiles();
  Named.insert(Named.end(), Files.begin(), Files.end());
  return *this;
}

InputFiles &InputFiles::add(const std::string &Name,
                            const std::vector<std::string> &Of) {
  for (const std::string &Path : Of)
    Named.push_back({Name, Path});
  return *this;
}

} // namespace vorion::splat
