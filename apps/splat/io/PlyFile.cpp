#include "io/PlyFile.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <charconv>
#include <concepts>
#include <fmt/format.h>
#include <optional>
#include <variant>

namespace vorion::splat {
namespace {

/// A zero of each type, in the order of PlyType.
constexpr std::variant<int8_t, uint8_t, int16_t, uint16_t, int32_t, uint32_t,
                       float, double>
    Zeros[] = {int8_t(),  uint8_t(),  int16_t(), uint16_t(),
               int32_t(), uint32_t(), 0.0F,      0.0};

/// Calls \p Do with a zero of the type that \p Type stands for.
template <typename Action> auto withNumber(PlyType Type, Action Do) {
  return std::visit(Do, Zeros[static_cast<std::size_t>(Type)]);
}

} // namespace

double loadNumber(Bytes Row, std::size_t At, PlyType Type) {
  return withNumber(Type, [&](auto Zero) {
    return static_cast<double>(load<decltype(Zero)>(Row, At));
  });
}

void PlyListRows::next(const PlyProperty &Property, std::vector<double> *To) {
  double Left = 1;
  if (Property.CountType) {
    Left = loadNumber(Rows, At, *Property.CountType);
    At += sizeOf(*Property.CountType);
  }
  for (; Left > 0; --Left, At += sizeOf(Property.Type))
    if (To)
      To->push_back(loadNumber(Rows, At, Property.Type));
}

namespace {

/// The number that the word \p Word is. A float that is too small or too large
/// for its type becomes 0 or an infinity, which is what a double rounds to.
template <typename Number> std::optional<Number> parse(std::string_view Word) {
  if (Word.starts_with('+'))
    Word.remove_prefix(1);
  Number Value{};
  const auto [End, Status] = std::from_chars(Word.begin(), Word.end(), Value);
  if constexpr (std::same_as<Number, float>)
    if (Status == std::errc::result_out_of_range)
      if (const auto Double = parse<double>(Word))
        return static_cast<float>(*Double);
  if (Status != std::errc() || End != Word.end())
    return std::nullopt;
  return Value;
}

/// Finds the rows of a binary file, and turns them round where they are
/// big-endian.
class BinaryRows {
public:
  BinaryRows(const std::string &Where, Bytes File, PlyHeader &Header)
      : Where(Where), File(File), Header(Header), At(Header.Size) {}

  Expected<Success> locate() {
    for (PlyElement &E : Header.Elements) {
      E.Start = At;
      if (auto Passed = E.HasLists ? passLists(E) : passRows(E); !Passed)
        return Passed;
    }
    if (At != File.size())
      return Error{
          Where,
          fmt::format("{} after the last element, expected the end of the file",
                      counted(File.size() - At, "byte"))};
    return Success{};
  }

  /// The file with all its numbers turned round.
  std::vector<std::byte> turned() const {
    std::vector<std::byte> Result(File.begin(), File.end());
    std::size_t Next = Header.Size;
    const auto Turn = [&](PlyType Type) {
      const std::size_t First = Next;
      Next += sizeOf(Type);
      std::reverse(&Result[First], &Result[First] + sizeOf(Type));
      return First;
    };
    for (const PlyElement &E : Header.Elements)
      for (std::size_t I = 0; I < E.Count; ++I)
        for (const PlyProperty &P : E.Properties) {
          auto Left = P.CountType
                          ? static_cast<std::size_t>(loadNumber(
                                Result, Turn(*P.CountType), *P.CountType))
                          : 1;
          while (Left-- != 0)
            Turn(P.Type);
        }
    return Result;
  }

private:
  Expected<Success> passRows(const PlyElement &E) {
    const std::size_t Left = File.size() - At;
    // Division, since an absurd count times the stride need not fit.
    if (E.Stride == 0 || Left / E.Stride < E.Count)
      return Error{Where,
                   fmt::format("truncated: {} bytes left for element {}, "
                               "expected {} rows of {} bytes",
                               Left, printable(E.Name), E.Count, E.Stride)};
    At += E.Count * E.Stride;
    return Success{};
  }

  Expected<Success> passLists(const PlyElement &E) {
    for (std::size_t I = 0; I < E.Count; ++I)
      for (const PlyProperty &P : E.Properties) {
        const auto Numbers = P.CountType ? count(*P.CountType) : 1;
        if (!Numbers || (File.size() - At) / sizeOf(P.Type) < *Numbers)
          return Error{
              Where,
              fmt::format("truncated in row {} of element {}, expected {} rows",
                          I, printable(E.Name), E.Count)};
        At += *Numbers * sizeOf(P.Type);
      }
    return Success{};
  }

  /// The count before a list; nothing if the file ends or it is negative.
  std::optional<std::size_t> count(PlyType Type) {
    const std::size_t Size = sizeOf(Type);
    if (File.size() - At < Size)
      return std::nullopt;
    std::vector<std::byte> Number(File.begin() + At, File.begin() + At + Size);
    if (Header.Encoding == PlyEncoding::BigEndian)
      std::ranges::reverse(Number);
    At += Size;
    return withNumber(Type, [&](auto Zero) -> std::optional<std::size_t> {
      const auto Value = load<decltype(Zero)>(Number, 0);
      if (Value < 0)
        return std::nullopt;
      return static_cast<std::size_t>(Value);
    });
  }

  const std::string &Where;
  Bytes File;
  PlyHeader &Header;
  std::size_t At;
};

/// Turns rows of text into binary ones. Numbers are separated by any blanks and
/// ends of lines.
class TextRows {
public:
  TextRows(const std::string &Where, Bytes File, PlyHeader &Header)
      : Where(Where), Text(asText(File).substr(Header.Size)), Header(Header),
        LineNumber(Header.LineNumber + 1) {}

  Expected<std::vector<std::byte>> read() {
    for (PlyElement &E : Header.Elements) {
      E.Start = Result.size();
      if (E.Properties.empty())
        return error(
            fmt::format("element {} has no property, expected at least one",
                        printable(E.Name)));
      for (std::size_t I = 0; I < E.Count; ++I)
        for (const PlyProperty &P : E.Properties)
          if (auto Taken = take(E, I, P); !Taken)
            return Taken.error();
    }
    if (const auto Word = next(); !Word.empty())
      return error(fmt::format(
          "`{}` after the last element, expected the end of the file",
          printable(Word)));
    return std::move(Result);
  }

private:
  Error error(std::string What) const {
    return Error{fmt::format("{}:{}", Where, LineNumber), std::move(What)};
  }

  /// The next word; empty at the end.
  std::string_view next() {
    constexpr std::string_view Blanks = " \t\r\n";
    while (At < Text.size() && Blanks.find(Text[At]) != Blanks.npos)
      LineNumber += Text[At++] == '\n';
    const std::size_t End =
        std::min(Text.find_first_of(Blanks, At), Text.size());
    const std::string_view Word = Text.substr(At, End - At);
    At = End;
    return Word;
  }

  /// Takes the number or the list of a row.
  Expected<Success> take(const PlyElement &E, std::size_t I,
                         const PlyProperty &P) {
    double Numbers = 1;
    if (P.CountType) {
      const std::string_view Word = next();
      const auto Count = append(Word, *P.CountType);
      if (!Count || *Count < 0)
        return notANumber(Word, E, I, "a list's count");
      Numbers = *Count;
    }
    for (double K = 0; K < Numbers; ++K) {
      const std::string_view Word = next();
      if (!append(Word, P.Type))
        return notANumber(Word, E, I, "property " + printable(P.Name));
    }
    return Success{};
  }

  /// Appends the number that the word \p Word is.
  std::optional<double> append(std::string_view Word, PlyType Type) {
    return withNumber(Type, [&](auto Zero) -> std::optional<double> {
      const auto Value = parse<decltype(Zero)>(Word);
      if (!Value)
        return std::nullopt;
      const auto *First = reinterpret_cast<const std::byte *>(&*Value);
      Result.insert(Result.end(), First, First + sizeof(*Value));
      return static_cast<double>(*Value);
    });
  }

  Error notANumber(std::string_view Word, const PlyElement &E, std::size_t I,
                   std::string_view What) const {
    if (Word.empty())
      return error(
          fmt::format("truncated in row {} of element {}, expected {} rows", I,
                      printable(E.Name), E.Count));
    return error(fmt::format(
        "`{}` in row {} of element {}, expected {}, the type in the header",
        printable(Word), I, printable(E.Name), What));
  }

  const std::string &Where;
  std::string_view Text;
  PlyHeader &Header;
  std::size_t LineNumber;
  std::size_t At = 0;
  std::vector<std::byte> Result;
};

} // namespace

Expected<PlyFile> readPly(const std::string &Where, Bytes File) {
  auto Header = readPlyHeader(Where, File);
  if (!Header)
    return Header.error();
  if (Header->Encoding == PlyEncoding::Text) {
    auto Rows = TextRows(Where, File, *Header).read();
    if (!Rows)
      return Rows.error();
    return PlyFile(std::move(*Header), std::move(*Rows));
  }
  BinaryRows Rows(Where, File, *Header);
  if (auto Located = Rows.locate(); !Located)
    return Located.error();
  if (Header->Encoding == PlyEncoding::LittleEndian)
    return PlyFile(std::move(*Header), File);
  auto Turned = Rows.turned();
  return PlyFile(std::move(*Header), std::move(Turned));
}

} // namespace vorion::splat
