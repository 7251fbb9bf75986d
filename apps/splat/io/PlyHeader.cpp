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

constexpr ScalarType ScalarTypes[] = {{"char", "int8", 1, PlyType::Other},
                                      {"uchar", "uint8", 1, PlyType::UChar},
                                      {"short", "int16", 2, PlyType::Other},
                                      {"ushort", "uint16", 2, PlyType::Other},
                                      {"int", "int32", 4, PlyType::Other},
                                      {"uint", "uint32", 4, PlyType::UInt},
                                      {"float", "float32", 4, PlyType::Float},
                                      {"double", "float64", 8, PlyType::Other}};

const ScalarType *scalarType(std::string_view Name) {
  const auto *It = std::find_if(std::begin(ScalarTypes), std::end(ScalarTypes),
                                [&](const ScalarType &T) {
                                  return T.Name == Name || T.OtherName == Name;
                                });
  return It == std::end(ScalarTypes) ? nullptr : It;
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
        return error("header ends early, expected `end_header`");
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
    return std::move(Result);
  }

  /// Bytes of what was read.
  std::size_t size() const { return At; }

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
    if (W.size() != 3 || W[1] != "binary_little_endian" || W[2] != "1.0")
      return fmt::format("format is `{}`, expected `binary_little_endian 1.0`",
                         W.size() > 1 ? printable(W[1]) : "");
    HasFormat = true;
    return std::nullopt;
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
      return fmt::format("{} count `{}` is no number, expected 0 or more",
                         printable(W[1]), printable(W[2]));
    return std::nullopt;
  }

  std::optional<std::string>
  declareProperty(const std::vector<std::string_view> &W) {
    if (Result.Elements.empty())
      return "property before the first element, expected `element <name> "
             "<count>`";
    const ScalarType *T = W.size() == 3 ? scalarType(W[1]) : nullptr;
    if (!T)
      return "expected `property <scalar type> <name>`";
    if (!Result.Elements.back().add(W[2], T->Type, T->Size))
      return fmt::format("property {} appears twice", printable(W[2]));
    return std::nullopt;
  }

  const std::string &Where;
  std::string_view Text;
  std::size_t At = 0;
  int LineNumber = 0;
  bool HasFormat = false;
  PlyHeader Result;
};

} // namespace

bool PlyElement::add(std::string_view Property, PlyType Type,
                     std::size_t Size) {
  if (!Places.emplace(Property, Properties.size()).second)
    return false;
  Properties.push_back({std::string(Property), Stride, Type});
  Stride += Size;
  return true;
}

const PlyProperty *PlyElement::find(std::string_view Property) const {
  const auto It = Places.find(Property);
  return It == Places.end() ? nullptr : &Properties[It->second];
}

Expected<std::vector<std::size_t>>
PlyElement::offsets(const std::string &Where,
                    const std::vector<std::string> &Names, PlyType Type) const {
  const std::string_view TypeName = Type == PlyType::Float   ? "float"
                                    : Type == PlyType::UInt  ? "uint"
                                    : Type == PlyType::UChar ? "uchar"
                                                             : "scalar";
  std::vector<std::size_t> Offsets;
  for (const std::string &Property : Names) {
    const PlyProperty *P = find(Property);
    if (!P)
      return Error{Where, fmt::format("property {} of element {} is missing, "
                                      "expected a {}",
                                      Property, Name, TypeName)};
    if (P->Type != Type)
      return Error{Where, fmt::format("property {} of element {} has another "
                                      "type, expected {}",
                                      Property, Name, TypeName)};
    Offsets.push_back(P->Offset);
  }
  return Offsets;
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
  HeaderReader Reader(Where, asText(File));
  auto H = Reader.read();
  if (!H)
    return H.error();
  std::size_t At = Reader.size();
  for (PlyElement &E : H->Elements) {
    E.Start = At;
    const std::size_t Left = File.size() - At;
    // Division, since an absurd count times the stride need not fit.
    if (E.Stride == 0 || Left / E.Stride < E.Count)
      return Error{Where,
                   fmt::format("{} bytes left for element {}, expected "
                               "{} rows of {} bytes",
                               Left, printable(E.Name), E.Count, E.Stride)};
    At += E.Count * E.Stride;
  }
  if (At != File.size())
    return Error{Where, fmt::format("{} bytes after the last element, expected "
                                    "the file's end",
                                    File.size() - At)};
  return std::move(*H);
}

} // namespace vorion::splat
