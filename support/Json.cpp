#include "vorion/support/Json.h"

#include "vorion/support/File.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace vorion {
namespace {

/// A list or an object that has begun, and its commas by now.
struct Bracket {
  bool IsObject;
  std::size_t Commas = 0;
};

/// The parser takes it before the text.
constexpr std::string_view ByteOrderMark = "\xef\xbb\xbf";

/// What \p Text asks for beyond \p Limits, found before anything is made of it.
/// Up to the first error of syntax this sees brackets and strings as the parser
/// does.
std::string beyond(std::string_view Text, const JsonLimits &Limits) {
  if (Text.size() > Limits.Bytes)
    return fmt::format("{} bytes of JSON, expected at most {}", Text.size(),
                       Limits.Bytes);
  // What begins otherwise, such as a picture, is no JSON, which the parser
  // says.
  const std::size_t Start = Text.find_first_not_of(
      " \t\r\n", Text.starts_with(ByteOrderMark) ? ByteOrderMark.size() : 0);
  if (Start == std::string_view::npos ||
      (Text[Start] != '[' && Text[Start] != '{'))
    return {};
  std::size_t Values = 1;
  std::vector<Bracket> Open;
  bool InText = false;
  for (std::size_t I = 0; I < Text.size(); ++I) {
    const char C = Text[I];
    if (InText) {
      I += C == '\\';
      InText = C != '"';
      continue;
    }
    InText = C == '"';
    Values += C == '[' || C == '{' || C == ',';
    if (C == '[' || C == '{')
      Open.push_back({C == '{'});
    else if (Open.empty())
      continue;
    else if (C == ']' || C == '}')
      Open.pop_back();
    else if (C == ',')
      ++Open.back().Commas;
    if (Open.size() > Limits.Depth)
      return fmt::format(
          "lists and objects nested deeper than {}, expected fewer levels",
          Limits.Depth);
    if (!Open.empty() && Open.back().IsObject &&
        Open.back().Commas >= Limits.Keys)
      return fmt::format("an object of more than {} keys, expected fewer",
                         Limits.Keys);
    if (Values > Limits.Values)
      return fmt::format("more than {} values, expected fewer", Limits.Values);
  }
  return {};
}

/// \p Where with the line and the column of number \p Byte of \p Text.
std::string placeOf(std::string_view Text, std::size_t Byte,
                    const std::string &Where) {
  const std::string_view Before = Text.substr(0, Byte > 0 ? Byte - 1 : 0);
  const std::size_t Line = Before.rfind('\n');
  return fmt::format("{}:{}:{}", Where,
                     1 + std::count(Before.begin(), Before.end(), '\n'),
                     Line == std::string_view::npos ? Before.size() + 1
                                                    : Before.size() - Line);
}

/// Why, of what the parser \p Said: "[...] parse error at line 1, column 2:
/// syntax error while parsing value - invalid literal; last read: '...'". What
/// it read may be any bytes, and what it expected is the parser's matter.
std::string_view reasonOf(std::string_view Said) {
  // Versions from 3.12 on have a sentence of its own for no text at all.
  if (Said.find(": attempting to parse an empty input") !=
      std::string_view::npos)
    return "unexpected end of input";
  constexpr std::string_view Begin = " - ";
  const std::size_t At = Said.find(Begin);
  if (At == std::string_view::npos)
    return "damaged";
  Said.remove_prefix(At + Begin.size());
  return Said.substr(0, Said.find("; "));
}

/// A key, and the number of its first byte in the text.
struct PlacedKey {
  std::string Name;
  std::size_t Byte;
};

/// The first key of \p Text, which is JSON, that its object has already: the
/// parser keeps one of the values and drops the other.
template <typename Kind>
std::optional<PlacedKey> repeatedKey(std::string_view Text) {
  std::vector<std::string> Keys;  // of all objects that are open
  std::vector<std::size_t> Begin; // of each open bracket, its first key
  for (std::size_t I = 0; I < Text.size(); ++I) {
    const char C = Text[I];
    if (C == '{' || C == '[') {
      Begin.push_back(Keys.size());
    } else if (C == '}' || C == ']') {
      Keys.resize(Begin.back());
      Begin.pop_back();
    } else if (C == '"') {
      const std::size_t Start = I;
      while (Text[++I] != '"')
        I += Text[I] == '\\';
      const std::size_t Next = Text.find_first_not_of(" \t\r\n", I + 1);
      if (Next == std::string_view::npos || Text[Next] != ':')
        continue;
      std::string Name(Text.substr(Start + 1, I - Start - 1));
      if (Name.find('\\') != std::string::npos)
        Name = ownJson<Kind>(Text.substr(Start, I + 1 - Start))
                   .template get<std::string>();
      if (std::find(Keys.begin() + static_cast<std::ptrdiff_t>(Begin.back()),
                    Keys.end(), Name) != Keys.end())
        return PlacedKey{std::move(Name), Start + 1};
      Keys.push_back(std::move(Name));
    }
  }
  return std::nullopt;
}

} // namespace

template <typename Kind>
Expected<Kind> parseJson(std::string_view Text, const std::string &Where,
                         std::string_view Wanted, const JsonLimits &Limits) {
  if (std::string Problem = beyond(Text, Limits); !Problem.empty())
    return Error{Where, std::move(Problem)};
  try {
    Kind J = Kind::parse(Text.begin(), Text.end());
    if (const auto Again = repeatedKey<Kind>(Text))
      return Error{
          placeOf(Text, Again->Byte, Where),
          fmt::format("duplicate key {} in an object, expected unique keys",
                      printable(Again->Name))};
    return J;
  } catch (const nlohmann::json::parse_error &E) {
    const auto File = std::as_bytes(std::span(Text));
    if (!mayBeJson(fileKindOf(File)))
      return otherKind(Where, File, Wanted, "");
    return Error{
        placeOf(Text, E.byte, Where),
        fmt::format("not JSON: {}, expected {}", reasonOf(E.what()), Wanted)};
  } catch (const nlohmann::json::out_of_range &) {
    return Error{
        Where,
        "a number outside the range of double, expected one below 1.8e308"};
  }
}

/// What \p Path holds, whose bytes are \p Read.
template <typename Kind>
static Expected<Kind>
parseRead(const Expected<std::vector<std::byte>> &Read, const std::string &Path,
          std::string_view Wanted, const JsonLimits &Limits) {
  if (!Read)
    return Read.error();
  return parseJson<Kind>(
      {reinterpret_cast<const char *>(Read->data()), Read->size()}, Path,
      Wanted, Limits);
}

template <typename Kind>
Expected<Kind> readJson(const std::string &Path, std::string_view Wanted,
                        const JsonLimits &Limits) {
  return parseRead<Kind>(readFile(Path, Limits.Bytes), Path, Wanted, Limits);
}

template <typename Kind>
Expected<Kind> readRegularJson(const std::string &Path,
                               std::string_view Wanted) {
  const JsonLimits Limits;
  return parseRead<Kind>(readRegularFile(Path, Limits.Bytes), Path, Wanted,
                         Limits);
}

template <typename Kind> Kind ownJson(std::string_view Text) {
  Kind J = Kind::parse(Text.begin(), Text.end(), nullptr,
                       /*allow_exceptions=*/false);
  assert(!J.is_discarded() && "JSON of ours that is none");
  return J;
}

template <typename Kind> std::string jsonText(const Kind &J, int Indent) {
  return J.dump(Indent, ' ', /*ensure_ascii=*/false,
                Kind::error_handler_t::replace);
}

#define VORION_INSTANTIATE(KIND)                                               \
  template Expected<KIND> parseJson(std::string_view, const std::string &,     \
                                    std::string_view, const JsonLimits &);     \
  template Expected<KIND> readJson(const std::string &, std::string_view,      \
                                   const JsonLimits &);                        \
  template Expected<KIND> readRegularJson(const std::string &,                 \
                                          std::string_view);                   \
  template KIND ownJson(std::string_view);                                     \
  template std::string jsonText(const KIND &, int);
VORION_INSTANTIATE(nlohmann::json)
VORION_INSTANTIATE(nlohmann::ordered_json)
#undef VORION_INSTANTIATE

} // namespace vorion
