#include "vorion/support/HelpText.h"

#include "vorion/support/Diagnostics.h"
#include "vorion/support/Printable.h"
#include "vorion/support/Terminal.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <unistd.h>

namespace vorion {
namespace {

/// Adds words to a text and begins a new line where one does not fit.
class Lines {
public:
  /// What is behind a line's break begins at \p Indent.
  Lines(std::string &To, std::size_t Columns, std::size_t Indent)
      : To(To), Columns(Columns), Indent(Indent) {}

  /// Adds \p Text as it is.
  void put(std::string_view Text) {
    To += Text;
    Used += columns(Text);
  }
  void breakLine() {
    To += '\n';
    Used = 0;
    put(std::string(Indent, ' '));
    IsBegun = false;
  }
  /// Adds \p Word behind a blank, in parts if no line holds it.
  void add(std::string_view Word) {
    if (IsBegun && Used + 1 + columns(Word) > Columns)
      breakLine();
    if (IsBegun)
      put(" ");
    while (Used + columns(Word) > Columns) {
      std::string_view Part = firstColumns(Word, Columns - Used);
      if (Part.empty()) // a letter of two columns where there is one
        break;
      put(Part);
      Word.remove_prefix(Part.size());
      breakLine();
    }
    put(Word);
    IsBegun = true;
  }
  void addWords(std::string_view Text) {
    while (!Text.empty()) {
      const std::size_t End = std::min(Text.find(' '), Text.size());
      if (End != 0)
        add(Text.substr(0, End));
      Text.remove_prefix(std::min(End + 1, Text.size()));
    }
  }

private:
  std::string &To;
  std::size_t Columns, Indent, Used = 0;
  bool IsBegun = false;
};

/// The columns of a line of help: an option, and its description behind two
/// blanks or more. A line of a description alone has no option.
struct Row {
  std::size_t Begin; ///< of what the line holds
  /// Of the description; nothing in a plain sentence.
  std::optional<std::size_t> Second;
};

Row rowOf(std::string_view Line) {
  constexpr std::size_t Deep = 16; // no option begins there
  const std::size_t Begin = std::min(Line.find_first_not_of(' '), Line.size());
  if (Begin == Line.size())
    return {Begin, std::nullopt};
  if (Begin >= Deep)
    return {Begin, Begin};
  const std::size_t Second =
      Line.find_first_not_of(' ', Line.find("  ", Begin));
  return {Begin, Second == std::string_view::npos ? std::nullopt
                                                  : std::optional(Second)};
}

/// Wraps \p Line, of which \p Of says the columns.
void wrapRow(std::string &To, std::string_view Line, const Row &Of,
             std::size_t Columns) {
  constexpr std::size_t LeastRoom = 24, Step = 4;
  const std::size_t Kept = Of.Second.value_or(Of.Begin);
  if (!Of.Second || Columns >= Kept + LeastRoom) {
    Lines L(To, Columns, Kept);
    L.put(Line.substr(0, Kept));
    L.addWords(Line.substr(Kept));
    return;
  }
  const std::size_t Indent = std::min(Of.Begin, std::size_t{2});
  Lines L(To, Columns, Indent + Step);
  if (Of.Begin != Kept) {
    L.put(std::string(Indent, ' '));
    L.addWords(Line.substr(0, Kept));
    L.breakLine();
  } else {
    L.put(std::string(Indent + Step, ' '));
  }
  L.addWords(Line.substr(Kept));
}

/// How wide help may be; nothing for as wide as it is.
std::optional<std::size_t> helpColumns() {
  if (const char *Text = std::getenv("COLUMNS")) {
    std::size_t Number = 0;
    const std::string_view Whole = Text;
    const auto [End, Status] =
        std::from_chars(Whole.data(), Whole.data() + Whole.size(), Number);
    if (Status == std::errc() && End == Whole.data() + Whole.size() &&
        Number > 0)
      return Number;
  }
  return columnsOf(STDOUT_FILENO);
}

} // namespace

std::string wrapped(std::string_view Text, std::size_t Columns) {
  constexpr std::size_t Least = 20;
  Columns = std::max(Columns, Least);
  const auto TakeLine = [&Text] {
    const std::size_t End = std::min(Text.find('\n'), Text.size());
    const std::string_view Line = Text.substr(0, End);
    Text.remove_prefix(std::min(End + 1, Text.size()));
    return Line;
  };
  std::string To;
  while (!Text.empty()) {
    const std::string_view First = TakeLine();
    const Row Of = rowOf(First);
    // A description may have several lines.
    std::string AsIs(First), Joined(First);
    bool Fits = columns(First) <= Columns;
    while (!Text.empty() && Of.Second) {
      const std::string_view Next = Text.substr(0, Text.find('\n'));
      const Row More = rowOf(Next);
      if (More.Begin != *Of.Second || More.Begin == Next.size())
        break;
      AsIs.append("\n").append(Next);
      Joined.append(" ").append(Next.substr(More.Begin));
      Fits = Fits && columns(Next) <= Columns;
      TakeLine();
    }
    if (Fits)
      To += AsIs;
    else
      wrapRow(To, Joined, Of, Columns);
    To += '\n';
  }
  return To;
}

void printHelp(std::string_view Text) {
  const auto Columns = helpColumns();
  printText(Columns ? wrapped(Text, *Columns) : Text);
}

} // namespace vorion
