#include "vorion/support/Printable.h"

#include <algorithm>
#include <clocale>
#include <cstddef>
#include <cstdint>
#include <cwchar>
#include <fmt/format.h>

namespace vorion {
namespace {

/// A character of UTF-8 and its bytes; none for what is no UTF-8.
struct Character {
  char32_t Code = 0;
  std::size_t Bytes = 0;
};

Character characterAt(std::string_view Text, std::size_t At) {
  const auto Byte = [&](std::size_t I) {
    return At + I < Text.size() ? static_cast<uint8_t>(Text[At + I]) : 0U;
  };
  const unsigned First = Byte(0);
  if (First < 0x80)
    return {First, 1};
  const std::size_t Bytes = First >= 0xf0 ? 4 : First >= 0xe0 ? 3 : 2;
  // Overlong forms, surrogates and what is above U+10FFFF are no UTF-8.
  constexpr char32_t Least[] = {0, 0, 0x80, 0x800, 0x10000};
  char32_t Code = First & (0xffU >> (Bytes + 1));
  for (std::size_t I = 1; I < Bytes; ++I) {
    if ((Byte(I) & 0xc0) != 0x80)
      return {};
    Code = Code << 6 | (Byte(I) & 0x3f);
  }
  if (First < 0xc0 || First > 0xf4 || Code < Least[Bytes] || Code > 0x10ffff ||
      (Code >= 0xd800 && Code <= 0xdfff))
    return {};
  return {Code, Bytes};
}

bool isControl(char32_t C) {
  return C < 0x20 || (C >= 0x7f && C < 0xa0) // C0, DEL, C1
         || C == 0x200e || C == 0x200f       // marks of direction
         || (C >= 0x2028 && C <= 0x202e)     // lines, embeddings
         || (C >= 0x2066 && C <= 0x2069)     // isolates
         || C == 0xfeff || C == 0x61c;       // nothing to see
}

/// Of a terminal, by Unicode's tables, which the C library has for a locale.
std::size_t columns(char32_t C) {
  if (C < 0x80)
    return 1;
  static const locale_t Unicode =
      ::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
  if (!Unicode)
    return 2; // no character takes more
  const locale_t Had = ::uselocale(Unicode);
  const int Width = ::wcwidth(static_cast<wchar_t>(C));
  ::uselocale(Had);
  return Width < 0 ? 1 : static_cast<std::size_t>(Width);
}

} // namespace

std::string escaped(std::string_view Text) {
  std::string Shown;
  Shown.reserve(Text.size());
  for (std::size_t At = 0; At < Text.size();) {
    const Character C = characterAt(Text, At);
    const std::size_t Bytes = C.Bytes == 0 ? 1 : C.Bytes;
    if (C.Bytes != 0 && !isControl(C.Code))
      Shown += Text.substr(At, Bytes);
    else
      for (std::size_t I = 0; I < Bytes; ++I)
        Shown += fmt::format("\\x{:02x}", static_cast<uint8_t>(Text[At + I]));
    At += Bytes;
  }
  return Shown;
}

std::string escapedLines(std::string_view Text) {
  std::string Shown;
  for (std::size_t End = 0; (End = Text.find('\n')) != std::string_view::npos;
       Text.remove_prefix(End + 1))
    Shown += escaped(Text.substr(0, End)) + '\n';
  return Shown + escaped(Text);
}

std::size_t columns(std::string_view Text) {
  std::size_t Sum = 0;
  for (std::size_t At = 0; At < Text.size();) {
    const Character C = characterAt(Text, At);
    Sum += C.Bytes == 0 ? 1 : columns(C.Code);
    At += std::max<std::size_t>(C.Bytes, 1);
  }
  return Sum;
}

std::string_view firstColumns(std::string_view Text, std::size_t Most) {
  std::size_t At = 0;
  while (At < Text.size()) {
    const Character C = characterAt(Text, At);
    const std::size_t Needed = C.Bytes == 0 ? 1 : columns(C.Code);
    if (Needed > Most)
      break;
    Most -= Needed;
    At += std::max<std::size_t>(C.Bytes, 1);
  }
  return Text.substr(0, At);
}

std::string printable(std::string_view Text, std::size_t Most) {
  return Text.size() <= Most ? escaped(Text)
                             : escaped(Text.substr(0, Most)) + "...";
}

} // namespace vorion
