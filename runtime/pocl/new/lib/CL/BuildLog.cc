//===- BuildLog.cc - messages in the words of the program -----------------===//

#include "BuildLog.h"

#include <algorithm>

namespace pocl {

namespace {

constexpr std::string_view RenamedFrom = "_builtin_renames.h:";
constexpr std::string_view ExpandedFrom = "note: expanded from macro '";
/// Before the name of a function in the library.
constexpr std::string_view OwnName = "'_cl_";
/// An option that programs cannot give.
constexpr std::string_view Advice = "; pass -fshow-overloads=all to show them";

/// Whether a line is one of the source text, or has its marks: "  7 | x = 1;".
bool isOfSource(std::string_view Line) {
  const size_t At = Line.find_first_not_of(" 0123456789");
  return At != 0 && At != std::string_view::npos && Line[At] == '|';
}

bool isOfRenaming(std::string_view Line) {
  const size_t At = Line.find(RenamedFrom);
  return At != std::string_view::npos &&
         Line.find(ExpandedFrom, At) != std::string_view::npos;
}

std::string withoutOwnNames(std::string_view Line) {
  std::string Text(Line);
  for (size_t At = 0; (At = Text.find(OwnName, At)) != std::string::npos; ++At)
    Text.erase(At + 1, OwnName.size() - 1);
  if (const size_t At = Text.find(Advice); At != std::string::npos)
    Text.erase(At, Advice.size());
  return Text;
}

} // namespace

std::string asTheAuthorSees(std::string_view Text) {
  std::string Seen;
  bool IsShown = true;
  while (!Text.empty()) {
    const size_t End = std::min(Text.find('\n'), Text.size() - 1) + 1;
    const std::string_view Line = Text.substr(0, End);
    Text.remove_prefix(End);
    if (isOfSource(Line)) {
      if (IsShown)
        Seen += Line;
      continue;
    }
    IsShown = !isOfRenaming(Line);
    if (IsShown)
      Seen += withoutOwnNames(Line);
  }
  return Seen;
}

} // namespace pocl
