#include "capture/PictureNames.h"

#include "capture/CaptureFiles.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <set>

namespace vorion::splat {

namespace fs = std::filesystem;

namespace {

/// \p Name as a path of slashes without `.` folders.
std::string withSlashes(const std::string &Name) {
  std::string Path = Name;
  std::ranges::replace(Path, '\\', '/');
  return fs::path(Path).lexically_normal().string();
}

/// The same in small letters, with one blank for each run of them.
std::string folded(const std::string &Name) {
  const std::string Text = lowerCase(withSlashes(Name));
  std::string Out;
  for (std::size_t I = 0; I < Text.size(); ++I) {
    const bool Encoded = Text.compare(I, 3, "%20") == 0;
    if (!Encoded && Text[I] != ' ') {
      Out += Text[I];
      continue;
    }
    I += Encoded ? 2 : 0;
    if (!Out.ends_with(' '))
      Out += ' ';
  }
  return std::string(trimmed(Out, " "));
}

std::string withoutExtension(const std::string &Name) {
  return fs::path(folded(Name)).replace_extension().string();
}
std::string withoutFolder(const std::string &Name) {
  return fs::path(folded(Name)).filename().string();
}
std::string stem(const std::string &Name) {
  return fs::path(folded(Name)).stem().string();
}

struct Rule {
  const char *Text;
  std::string (*Key)(const std::string &Name);
  bool IgnoresFolders;
};
constexpr Rule Rules[] = {
    {"with other separators", withSlashes, false},
    {"in another case or with other blanks", folded, false},
    {"with another file extension", withoutExtension, false},
    {"in another folder", withoutFolder, true},
    {"in another folder, with another file extension", stem, true},
};

/// The pictures in \p Folder and below it, relative to it.
std::vector<std::string> picturesBelow(const fs::path &Folder) {
  constexpr int MostFolders = 8;
  constexpr std::size_t MostFiles = 1'000'000;
  std::vector<std::string> Files;
  std::error_code Ignored;
  fs::recursive_directory_iterator It(
      Folder, fs::directory_options::skip_permission_denied, Ignored);
  std::size_t Count = 0;
  for (; It != fs::recursive_directory_iterator() && ++Count < MostFiles;
       It.increment(Ignored)) {
    if (It.depth() == MostFolders)
      It.disable_recursion_pending();
    if (isPictureName(It->path()) && It->is_regular_file(Ignored))
      Files.push_back(It->path().lexically_relative(Folder).string());
  }
  std::ranges::sort(Files);
  return Files;
}

} // namespace

MatchedPictures matchPictures(const fs::path &Folder,
                              const std::vector<std::string> &Names) {
  MatchedPictures M;
  std::vector<std::size_t> Missing;
  std::set<std::string> Used;
  for (std::size_t I = 0; I < Names.size(); ++I) {
    M.Files.push_back(pictureOf(Folder, Names[I]));
    if (fileExists(M.Files.back()))
      Used.insert(M.Files.back().lexically_relative(Folder).lexically_normal());
    else
      Missing.push_back(I);
  }
  M.Found = Names.size() - Missing.size();
  if (Missing.empty())
    return M;
  std::vector<std::string> Files = picturesBelow(Folder);
  for (const Rule &R : Rules) {
    if (R.IgnoresFolders && M.Found != 0)
      break;
    std::erase_if(Files,
                  [&](const std::string &F) { return Used.contains(F); });
    std::map<std::string, std::vector<std::size_t>> NamesBy;
    std::map<std::string, std::vector<std::string>> FilesBy;
    for (const std::size_t I : Missing)
      NamesBy[R.Key(Names[I])].push_back(I);
    for (const std::string &F : Files)
      FilesBy[R.Key(F)].push_back(F);
    std::size_t Count = 0;
    std::string Example;
    for (const auto &[Key, Of] : NamesBy) {
      const auto Same = FilesBy.find(Key);
      if (Same == FilesBy.end() || Of.size() != 1 || Same->second.size() != 1)
        continue;
      const std::string &File = Same->second.front();
      M.Files[Of.front()] = Folder / File;
      Used.insert(File);
      std::erase(Missing, Of.front());
      if (Count++ == 0)
        Example = fmt::format("{} is {}", printable(Names[Of.front()]),
                              printable(File));
    }
    M.Found += Count;
    if (Count > 0)
      M.Notes.push_back(fmt::format(
          "{} found {}: {}", counted(Count, "picture"), R.Text, Example));
  }
  return M;
}

} // namespace vorion::splat
