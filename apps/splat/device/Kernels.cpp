#include "device/Kernels.h"

#include "vorion/support/File.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace vorion::splat {

namespace {

Expected<std::string> read(const std::string &File, const std::string &Folder) {
  if (Folder.empty()) {
    const std::string_view Text = kernelSource(File);
    if (Text.empty())
      return Error{File, "unknown kernel file"};
    return std::string(Text);
  }
  const auto Bytes = readRegularFile(Folder + "/" + File);
  if (!Bytes)
    return Bytes.error();
  return std::string(reinterpret_cast<const char *>(Bytes->data()),
                     Bytes->size());
}

/// The file that \p Line includes; empty if it includes none.
std::string_view includedBy(std::string_view Line) {
  constexpr std::string_view Begin = "#include \"";
  if (!Line.starts_with(Begin))
    return {};
  Line.remove_prefix(Begin.size());
  return Line.substr(0, Line.find('"'));
}

/// Every kernel file has #pragma once where another includes it.
class Assembler {
public:
  explicit Assembler(const std::string &FolderIn) : Folder(FolderIn) {}

  Expected<Success> add(const std::string &File) {
    if (Always.contains(File) || !Open.insert(File).second)
      return Success{};
    const auto Source = read(File, Folder);
    if (!Source)
      return Source.error();
    const bool IsAlways = Conditions == 0;
    // The first #include of a file may be in a part that is left out.
    std::string Guard = "INCLUDED_" + File;
    std::ranges::replace(Guard, '.', '_');
    Text +=
        fmt::format("#ifndef {0}\n#define {0}\n#line 1 \"{1}\"\n", Guard, File);
    if (auto Done = addLines(File, *Source); !Done)
      return Done;
    Text += "#endif\n";
    Open.erase(File);
    if (IsAlways)
      Always.insert(File);
    return Success{};
  }

  std::string Text;

private:
  Expected<Success> addLines(const std::string &File, std::string_view Source) {
    // A part that is left out takes the #line behind its files with it.
    bool HasFilesInParts = false;
    const auto AddNumber = [&](unsigned Number) {
      Text += fmt::format("#line {} \"{}\"\n", Number, File);
    };
    for (unsigned Number = 1; !Source.empty(); ++Number) {
      const std::string_view Line = Source.substr(0, Source.find('\n'));
      Source.remove_prefix(std::min(Line.size() + 1, Source.size()));
      if (const std::string_view Other = includedBy(Line); !Other.empty()) {
        if (auto Done = add(std::string(Other)); !Done)
          return Done;
        AddNumber(Number + 1);
        HasFilesInParts |= Conditions != 0;
        continue;
      }
      if (Line.starts_with("#if"))
        ++Conditions;
      else if (Line.starts_with("#endif"))
        --Conditions;
      if (Line != "#pragma once")
        Text += Line;
      Text += '\n';
      if (HasFilesInParts &&
          (Line.starts_with("#el") || Line.starts_with("#endif")))
        AddNumber(Number + 1);
    }
    return Success{};
  }

  const std::string &Folder;
  std::set<std::string> Open;   ///< whose lines are being added
  std::set<std::string> Always; ///< that are there, whatever the macros are
  unsigned Conditions = 0;      ///< that enclose the next line
};

} // namespace

Expected<std::string> programText(const std::string &File,
                                  const std::string &Folder) {
  Assembler A(Folder);
  if (auto Done = A.add(File); !Done)
    return Done.error();
  return std::move(A.Text);
}

} // namespace vorion::splat
