#include "scene/SceneFiles.h"

#include "io/Bytes.h"
#include "io/Inside.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

namespace vorion::splat {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

bool isFile(const fs::path &Path) {
  std::error_code Ignored;
  return fs::is_regular_file(Path, Ignored);
}

/// Whether \p Path is a text that begins as a JSON object; most scenes are too
/// large to be read for this alone.
bool isDescription(const std::string &Path) {
  constexpr std::size_t Looked = 4096;
  const auto Start = readStart(Path, Looked);
  return Start && trimmed(asText(*Start), " \t\r\n").starts_with('{');
}

/// Descriptions in the folder \p Path, as readSogFolder() looks for them.
std::vector<std::string> descriptionsIn(const fs::path &Path) {
  for (const char *Name : {"lod-meta.json", "meta.json"})
    if (isFile(Path / Name))
      return {(Path / Name).string()};
  std::vector<std::string> Chunks;
  std::error_code Ignored;
  for (fs::directory_iterator It(Path, Ignored), End; It != End;
       It.increment(Ignored))
    if (const fs::path File = It->path() / "meta.json"; isFile(File))
      Chunks.push_back(File.string());
  return Chunks;
}

/// Every file of a scene, from one description to the next.
class Walk {
public:
  void add(const std::string &File) {
    if (!Seen.insert(fs::path(File).lexically_normal().string()).second)
      return;
    Files.push_back(File);
    if (!isDescription(File))
      return;
    const auto Content =
        readRegularJson<Json>(File, "a description of a scene");
    if (Content)
      addNamed(fs::path(File).parent_path(), *Content);
  }

  std::vector<std::string> Files;

private:
  /// Whatever text in \p J is the name of a file in \p Folder: all formats say
  /// it under other keys.
  void addNamed(const fs::path &Folder, const Json &J) {
    // Longer than any name: data in the text itself.
    constexpr std::size_t MostLetters = 4096;
    if (J.is_string()) {
      const auto &Name = J.get_ref<const std::string &>();
      if (Name.size() <= MostLetters && staysInside(Name) &&
          isFile(Folder / Name))
        add((Folder / Name).string());
    }
    if (J.is_structured())
      for (const Json &Inner : J)
        addNamed(Folder, Inner);
  }

  std::set<std::string> Seen;
};

} // namespace

std::vector<std::string> sceneFiles(const std::string &Path) {
  Walk W;
  std::error_code Ignored;
  if (fs::is_directory(Path, Ignored))
    for (const std::string &File : descriptionsIn(Path))
      W.add(File);
  else
    W.add(Path);
  return std::move(W.Files);
}

} // namespace vorion::splat
