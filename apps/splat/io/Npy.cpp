// The .npy half of Npz.h: one array with its header.
#include "io/NpyFormat.h"
#include "io/Npz.h"
#include "vorion/support/FileKind.h"

#include <bit>
#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <optional>

static_assert(std::endian::native == std::endian::little,
              "elements are copied between file and memory as they are");

namespace vorion::splat {
namespace {

constexpr std::string_view Magic = "\x93NUMPY";

/// NumPy has no more; each costs time for every element.
constexpr std::size_t MostAxes = 64;

/// NumPy itself reads no header of more than 10,000 bytes.
constexpr std::size_t MostHeader = std::size_t{1} << 16;
static_assert(MostHeader < MostNpyStart);

/// Bytes of an element of \p Type; 0 for what is not read.
std::size_t elementSize(std::string_view Type) {
  if (Type == "b1" || Type == "u1")
    return 1;
  if (Type == "i2" || Type == "u2")
    return 2;
  if (Type == "f4" || Type == "i4" || Type == "u4")
    return 4;
  if (Type == "f8" || Type == "i8")
    return 8;
  std::size_t CodePoints = 0;
  if (Type.starts_with('U') &&
      std::from_chars(Type.data() + 1, Type.data() + Type.size(), CodePoints)
              .ptr == Type.data() + Type.size() &&
      Type.size() > 1 && CodePoints < (std::size_t(1) << 30))
    return 4 * CodePoints;
  return 0;
}

template <typename From, typename To>
std::vector<To> convert(const std::vector<std::byte> &Bytes) {
  std::vector<To> Result(Bytes.size() / sizeof(From));
  for (std::size_t I = 0; I < Result.size(); ++I) {
    From Value;
    std::memcpy(&Value, Bytes.data() + I * sizeof(From), sizeof(From));
    Result[I] = static_cast<To>(Value);
  }
  return Result;
}

template <typename To> std::vector<To> convertArray(const NpyArray &A) {
  if (A.Type == "f4")
    return convert<float, To>(A.Bytes);
  if (A.Type == "f8")
    return convert<double, To>(A.Bytes);
  if (A.Type == "i4")
    return convert<int32_t, To>(A.Bytes);
  if (A.Type == "i8")
    return convert<int64_t, To>(A.Bytes);
  if (A.Type == "u4")
    return convert<uint32_t, To>(A.Bytes);
  if (A.Type == "i2")
    return convert<int16_t, To>(A.Bytes);
  if (A.Type == "u2")
    return convert<uint16_t, To>(A.Bytes);
  if (A.Type == "u1" || A.Type == "b1")
    return convert<uint8_t, To>(A.Bytes);
  return {};
}

template <typename T>
NpyArray arrayOf(const char *Type, std::vector<std::size_t> Shape,
                 const std::vector<T> &Values) {
  NpyArray A{Type, std::move(Shape), {}};
  A.Bytes.resize(Values.size() * sizeof(T));
  if (!Values.empty())
    std::memcpy(A.Bytes.data(), Values.data(), A.Bytes.size());
  return A;
}

/// The text after `'Key':` in a header, blanks skipped.
std::optional<std::string_view> valueOf(std::string_view Header,
                                        std::string_view Key) {
  const std::size_t At = Header.find(fmt::format("'{}':", Key));
  if (At == std::string_view::npos)
    return std::nullopt;
  Header.remove_prefix(At + Key.size() + 3);
  Header.remove_prefix(std::min(Header.find_first_not_of(' '), Header.size()));
  return Header;
}

/// Parses `(2, 3)`, `(2,)` and `()`; nothing where it is something else.
std::optional<std::vector<std::size_t>> parseShape(std::string_view Text) {
  const std::size_t End = Text.find(')');
  if (!Text.starts_with('(') || End == std::string_view::npos)
    return std::nullopt;
  std::vector<std::size_t> Shape;
  const char *At = Text.data() + 1;
  const char *Last = Text.data() + End;
  while (At != Last) {
    if (*At == ' ' || *At == ',') {
      ++At;
      continue;
    }
    std::size_t Extent = 0;
    const auto [Next, Status] = std::from_chars(At, Last, Extent);
    if (Status != std::errc())
      return std::nullopt;
    Shape.push_back(Extent);
    At = Next;
  }
  return Shape;
}

/// The product of \p Shape and \p Size, or nothing if it does not fit.
std::optional<std::size_t> bytesOf(const std::vector<std::size_t> &Shape,
                                   std::size_t Size) {
  std::size_t Bytes = Size;
  for (const std::size_t Extent : Shape)
    if (__builtin_mul_overflow(Bytes, Extent, &Bytes))
      return std::nullopt;
  return Bytes;
}

/// Reorders elements that lie first index fastest.
void toCOrder(NpyArray &A) {
  const std::size_t Size = elementSize(A.Type);
  std::vector<std::byte> Sorted(A.Bytes.size());
  std::vector<std::size_t> Index(A.Shape.size(), 0);
  for (std::size_t To = 0; To < Sorted.size(); To += Size) {
    std::size_t From = 0;
    for (std::size_t D = A.Shape.size(); D-- > 0;)
      From = From * A.Shape[D] + Index[D];
    std::memcpy(&Sorted[To], &A.Bytes[From * Size], Size);
    for (std::size_t D = A.Shape.size(); D-- > 0;) {
      if (++Index[D] < A.Shape[D])
        break;
      Index[D] = 0;
    }
  }
  A.Bytes = std::move(Sorted);
}

} // namespace

static std::size_t product(const std::vector<std::size_t> &Shape) {
  std::size_t N = 1;
  for (const std::size_t Extent : Shape)
    N *= Extent;
  return N;
}

std::size_t NpyArray::elements() const { return product(Shape); }
std::size_t NpyShape::numbers() const {
  return Type.starts_with('U') ? 0 : product(Shape);
}

std::vector<double> NpyArray::toDoubles() const {
  return convertArray<double>(*this);
}
std::vector<float> NpyArray::toFloats() const {
  return convertArray<float>(*this);
}
std::vector<int64_t> NpyArray::toIntegers() const {
  return Type.starts_with('f') ? std::vector<int64_t>()
                               : convertArray<int64_t>(*this);
}

std::vector<std::string> NpyArray::toTexts() const {
  const std::size_t Each = elementSize(Type) / 4;
  if (!Type.starts_with('U') || Each == 0)
    return {};
  const auto CodePoints = convert<uint32_t, uint32_t>(Bytes);
  std::vector<std::string> Texts(CodePoints.size() / Each);
  for (std::size_t N = 0; N != Texts.size(); ++N)
    for (std::size_t I = N * Each; I != (N + 1) * Each && CodePoints[I]; ++I)
      Texts[N] += CodePoints[I] < 0x80 ? static_cast<char>(CodePoints[I]) : '?';
  return Texts;
}

std::string NpyArray::toText() const {
  const auto Texts = toTexts();
  return Texts.empty() ? std::string() : Texts.front();
}

NpyArray NpyArray::of(std::vector<std::size_t> Shape,
                      const std::vector<float> &Values) {
  return arrayOf("f4", std::move(Shape), Values);
}
NpyArray NpyArray::of(std::vector<std::size_t> Shape,
                      const std::vector<double> &Values) {
  return arrayOf("f8", std::move(Shape), Values);
}
NpyArray NpyArray::of(std::vector<std::size_t> Shape,
                      const std::vector<int32_t> &Values) {
  return arrayOf("i4", std::move(Shape), Values);
}
NpyArray NpyArray::fromBools(std::vector<std::size_t> Shape,
                             const std::vector<uint8_t> &Values) {
  return arrayOf("b1", std::move(Shape), Values);
}

Expected<NpyHeader> parseNpyHeader(const std::string &Where, Bytes Start) {
  const std::string_view All = asText(Start);
  // Magic, two bytes of version, then the header's length: two bytes in
  // version 1, four in 2 and 3.
  if (!All.starts_with(Magic))
    return otherKind(Where, Start, "a .npy array, which NumPy writes",
                     "not a .npy array");
  if (All.size() < 10)
    return Error{
        Where,
        "the .npy array is truncated in its header, expected a complete array"};
  const int Major = static_cast<unsigned char>(All[6]);
  if (Major < 1 || Major > 3)
    return Error{Where, fmt::format(".npy version {}, expected 1 to 3", Major)};
  const std::size_t LengthBytes = Major == 1 ? 2 : 4;
  std::size_t Length = 0;
  if (All.size() >= 8 + LengthBytes)
    std::memcpy(&Length, All.data() + 8, LengthBytes);
  const std::size_t Begin = 8 + LengthBytes;
  if (Length > MostHeader)
    return Error{Where, fmt::format("a .npy header of {} bytes, expected at "
                                    "most {}",
                                    Length, MostHeader)};
  if (All.size() < Begin || All.size() - Begin < Length)
    return Error{Where, "is truncated in the .npy header"};
  const std::string_view Header = All.substr(Begin, Length);

  const auto Descr = valueOf(Header, "descr");
  const auto Fortran = valueOf(Header, "fortran_order");
  const auto ShapeText = valueOf(Header, "shape");
  auto Shape = ShapeText ? parseShape(*ShapeText) : std::nullopt;
  if (!Descr || !Fortran || !Shape)
    return Error{Where, "malformed .npy header, expected descr, fortran_order "
                        "and shape"};
  const std::size_t Quote = Descr->find('\'', 1);
  const std::string_view Type =
      Descr->starts_with('\'') && Quote != std::string_view::npos && Quote > 1
          ? Descr->substr(1, Quote - 1)
          : std::string_view();
  const bool ByteOrder = Type.starts_with('<') || Type.starts_with('|');
  if (!ByteOrder || (elementSize(Type.substr(1)) == 0 && Type != "<U0"))
    return Error{Where, fmt::format("element type `{}`, expected little-endian "
                                    "f4, f8, i2, i4, i8, u1, u2, u4, b1 or "
                                    "text",
                                    Type.substr(0, 40))};
  if (Shape->size() > MostAxes)
    return Error{Where, fmt::format("an array of {} axes, expected at most {}",
                                    Shape->size(), MostAxes)};
  // No file has as many, and the header's bytes can be added to it.
  constexpr std::size_t TooLarge = std::size_t{1} << 62;
  const std::size_t Size =
      std::min(TooLarge,
               bytesOf(*Shape, elementSize(Type.substr(1))).value_or(TooLarge));
  return NpyHeader{std::string(Type.substr(1)), std::move(*Shape),
                   !Fortran->starts_with("False"), Begin + Length, Size};
}

static Error wrongSize(const std::string &Where, const NpyHeader &H,
                       std::size_t Body) {
  return {Where, fmt::format("{} bytes of data, expected <{} of shape ({})",
                             Body, H.Type, fmt::join(H.Shape, ", "))};
}

Expected<NpyArray> parseNpy(const std::string &Where,
                            std::vector<std::byte> Bytes) {
  auto H = parseNpyHeader(Where, Bytes);
  if (!H)
    return H.error();
  const std::size_t Body = Bytes.size() - H->Begin;
  if (H->Size != Body)
    return wrongSize(Where, *H, Body);
  Bytes.erase(Bytes.begin(),
              Bytes.begin() + static_cast<std::ptrdiff_t>(H->Begin));
  NpyArray A{std::move(H->Type), std::move(H->Shape), std::move(Bytes)};
  if (H->IsFortran)
    toCOrder(A);
  return A;
}

std::string formatNpy(const NpyArray &A) {
  std::string Shape;
  for (const std::size_t Extent : A.Shape)
    Shape += fmt::format("{}, ", Extent);
  if (A.Shape.size() > 1)
    Shape.resize(Shape.size() - 2);
  else if (A.Shape.size() == 1)
    Shape.pop_back();
  const bool OneByte = A.Type == "b1" || A.Type == "u1";
  std::string Header = fmt::format(
      "{{'descr': '{}{}', 'fortran_order': False, 'shape': ({}), }}",
      OneByte ? '|' : '<', A.Type, Shape);
  // The format wants the data aligned to 64 bytes and a closing line end.
  constexpr std::size_t Align = 64;
  const std::size_t Fixed = Magic.size() + 4;
  Header.append(Align - (Fixed + Header.size() + 1) % Align, ' ');
  Header += '\n';
  const auto Length = static_cast<uint16_t>(Header.size());
  std::string Out(Magic);
  Out += '\1';
  Out += '\0';
  Out.append(reinterpret_cast<const char *>(&Length), sizeof(Length));
  Out += Header;
  Out.append(reinterpret_cast<const char *>(A.Bytes.data()), A.Bytes.size());
  return Out;
}

} // namespace vorion::splat
