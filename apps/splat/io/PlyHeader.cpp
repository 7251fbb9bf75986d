#include "io/PlyHeader.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace vorion::splat {
namespace {

struct ScalarType {
  std::string_view Name, OtherName;
  std::size_t Size; ///< bytes
  PlyType Type;
};

/// In the order of PlyType.
constexpr ScalarType ScalarTypes[] = {
    {"char", "int8", 1, PlyType::Char},
    {"uchar", "uint8", 1, PlyType::UChar},
    {"short", "int16", 2, PlyType::Short},
    {"ushort", "uint16", 2, PlyType::UShort},
    {"int", "int32", 4, PlyType::Int},
    {"uint", "uint32", 4, PlyType::UInt},
    {"float", "float32", 4, PlyType::Float},
    {"double", "float64", 8, PlyType::Double}};

const ScalarType *scalarType(std::string_view Name) {
  const auto *It = std::find_if(std::begin(ScalarTypes), std::end(ScalarTypes),
                                [&](const ScalarType &T) {
                                  return T.Name == Name || T.OtherName == Name;
                                });
  return It == std::end(ScalarTypes) ? nullptr : It;
}

bool isInteger(PlyType Type) {
  return Type != PlyType::Float && Type != PlyType::Double;
}

/// The words of \p Line, separated by blanks.
std::vector<std::string_view> words(std::string_view Line) {
  std::vector<std::string_view> Result;
  while (true) {
    const std::size_t Start = Line.find_first_not_of(" \t");
    if (Start == std::string_view::npos)
      return Result;
    const std::size_t End =
        std::min(Line.find_first_of(" \t", Start), Line.size());
    Result.push_back(Line.substr(Start, End - Start));
    Line.remove_prefix(End);
  }
}

/// Reads header lines one by one and collects what they declare.
class HeaderReader {
public:
  HeaderReader(const std::string &Where, std::string_view Text)
      : Where(Where), Text(Text) {}

  Expected<PlyHeader> read() {
    const auto First = nextLine();
    if (!First || *First != "ply")
      return error("not a PLY file, expected `ply` on the first line");
    while (true) {
      const auto Line = nextLine();
      if (!Line)
        return error("header is truncated, expected `end_header`");
      const auto W = words(*Line);
      if (W.empty() || W[0] == "obj_info")
        continue;
      if (W[0] == "comment") {
        Result.Comments.emplace_back(W[0].end(), Line->end());
        continue;
      }
      if (W[0] == "end_header")
        break;
      if (auto Problem = declare(W))
        return error(*Problem);
    }
    if (!HasFormat)
      return error("header has no format line, expected `format "
                   "binary_little_endian 1.0`");
    Result.Size = At;
    Result.LineNumber = LineNumber;
    return std::move(Result);
  }

private:
  Error error(std::string What) const {
    return Error{fmt::format("{}:{}", Where, LineNumber), std::move(What)};
  }

  /// The next line without its end; nothing if the text ends before one.
  std::optional<std::string_view> nextLine() {
    ++LineNumber;
    const std::size_t End = Text.find('\n', At);
    if (End == std::string_view::npos)
      return std::nullopt;
    std::string_view Line = Text.substr(At, End - At);
    At = End + 1;
    if (Line.ends_with('\r'))
      Line.remove_suffix(1);
    return Line;
  }

  /// Takes one declaration; gives what is wrong with it.
  std::optional<std::string> declare(const std::vector<std::string_view> &W) {
    if (W[0] == "format")
      return declareFormat(W);
    if (W[0] == "element")
      return declareElement(W);
    if (W[0] == "property")
      return declareProperty(W);
    return fmt::format("unknown header keyword `{}`, expected format, element, "
                       "property, comment or end_header",
                       printable(W[0]));
  }

  std::optional<std::string>
  declareFormat(const std::vector<std::string_view> &W) {
    constexpr std::pair<std::string_view, PlyEncoding> Encodings[] = {
        {"binary_little_endian", PlyEncoding::LittleEndian},
        {"binary_big_endian", PlyEncoding::BigEndian},
        {"ascii", PlyEncoding::Text}};
    for (const auto &[Name, Encoding] : Encodings)
      if (W.size() == 3 && W[1] == Name && W[2] == "1.0") {
        Result.Encoding = Encoding;
        HasFormat = true;
        return std::nullopt;
      }
    return fmt::format("format is `{}`, expected binary_little_endian, "
                       "binary_big_endian or ascii, and version 1.0",
                       W.size() > 1 ? printable(W[1]) : "");
  }

  std::optional<std::string>
  declareElement(const std::vector<std::string_view> &W) {
    if (W.size() != 3)
      return "expected `element <name> <count>`";
    PlyElement *E = Result.add(W[1]);
    if (!E)
      return fmt::format("element {} appears twice", printable(W[1]));
    const auto [Read, Status] =
        std::from_chars(W[2].begin(), W[2].end(), E->Count);
    if (Status != std::errc() || Read != W[2].end())
      return fmt::format("{} count `{}` is not a number, expected 0 or more",
                         printable(W[1]), printable(W[2]));
    return std::nullopt;
  }

  std::optional<std::string>
  declareProperty(const std::vector<std::string_view> &W) {
    if (Result.Elements.empty())
      return "property before the first element, expected `element <name> "
             "<count>`";
    const bool IsList = W.size() == 5 && W[1] == "list";
    const ScalarType *Count = IsList ? scalarType(W[2]) : nullptr;
    const ScalarType *Type = IsList          ? scalarType(W[3])
                             : W.size() == 3 ? scalarType(W[1])
                                             : nullptr;
    if (!Type || IsList != (Count && isInteger(Count->Type)))
      return "expected `property <scalar type> <name>` or `property list "
             "<integer type> <scalar type> <name>`";
    PlyProperty Property{std::string(W.back()), Type->Type, std::nullopt};
    if (IsList)
      Property.CountType = Count->Type;
    if (!Result.Elements.back().add(std::move(Property)))
      return fmt::format("property {} appears twice", printable(W.back()));
    return std::nullopt;
  }

  const std::string &Where;
  std::string_view Text;
  std::size_t At = 0;
  std::size_t LineNumber = 0;
  bool HasFormat = false;
  PlyHeader Result;
};

/// The property of \p Element that \p Name names; it is a number of a type that
/// \p Fits, which messages call \p TypeName.
template <typename Predicate>
Expected<const PlyProperty *>
need(const std::string &Where, const PlyElement &Element,
     const std::string &Name, std::string_view TypeName, Predicate Fits) {
  const PlyProperty *P = Element.find(Name);
  if (!P)
    return Error{Where, fmt::format("property {} of element {} is missing, "
                                    "expected a {}",
                                    Name, Element.Name, TypeName)};
  if (P->CountType || !Fits(P->Type))
    return Error{Where, fmt::format("property {} of element {} has another "
                                    "type, expected {}",
                                    Name, Element.Name, TypeName)};
  return P;
}

} // namespace

std::size_t sizeOf(PlyType Type) {
  return ScalarTypes[static_cast<std::size_t>(Type)].Size;
}

bool PlyElement::add(PlyProperty Property) {
  if (!Places.emplace(Property.Name, Properties.size()).second)
    return false;
  if (Property.CountType) {
    HasLists = true;
  } else {
    Property.Offset = Stride;
    Stride += sizeOf(Property.Type);
  }
  Properties.push_back(std::move(Property));
  return true;
}

const PlyProperty *PlyElement::find(std::string_view Property) const {
  const auto It = Places.find(Property);
  return It == Places.end() ? nullptr : &Properties[It->second];
}

Expected<std::vector<std::size_t>>
PlyElement::offsets(const std::string &Where,
                    const std::vector<std::string> &Names, PlyType Type) const {
  const std::string_view TypeName =
      ScalarTypes[static_cast<std::size_t>(Type)].Name;
  std::vector<std::size_t> Offsets;
  for (const std::string &Property : Names) {
    const auto P = need(Where, *this, Property, TypeName,
                        [&](PlyType Found) { return Found == Type; });
    if (!P)
      return P.error();
    Offsets.push_back((*P)->Offset);
  }
  return Offsets;
}

Expected<std::vector<PlyReal>>
PlyElement::reals(const std::string &Where,
                  const std::vector<std::string> &Names) const {
  std::vector<PlyReal> Reals;
  for (const std::string &Property : Names) {
    const auto P = need(Where, *this, Property, "float or double",
                        [](PlyType Found) { return !isInteger(Found); });
    if (!P)
      return P.error();
    Reals.push_back({(*P)->Offset, (*P)->Type == PlyType::Double});
  }
  return Reals;
}

PlyElement *PlyHeader::add(std::string_view Element) {
  if (!Places.emplace(Element, Elements.size()).second)
    return nullptr;
  PlyElement &E = Elements.emplace_back();
  E.Name = Element;
  return &E;
}

const PlyElement *PlyHeader::find(std::string_view Element) const {
  const auto It = Places.find(Element);
  return It == Places.end() ? nullptr : &Elements[It->second];
}

Expected<PlyHeader> readPlyHeader(const std::string &Where, Bytes File) {
  return HeaderReader(Where, asText(File)).read();
}

} // namespace vorion::splat
