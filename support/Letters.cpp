#include "vorion/support/Letters.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace vorion {

std::string upperCase(std::string Text) {
  std::ranges::transform(Text, Text.begin(), [](unsigned char C) {
    return static_cast<char>(std::toupper(C));
  });
  return Text;
}

std::string lowerCase(std::string Text) {
  std::ranges::transform(Text, Text.begin(), [](unsigned char C) {
    return static_cast<char>(std::tolower(C));
  });
  return Text;
}

std::string_view trimmed(std::string_view Text, std::string_view Blanks) {
  const std::size_t First = Text.find_first_not_of(Blanks);
  if (First == std::string_view::npos)
    return {};
  return Text.substr(First, Text.find_last_not_of(Blanks) + 1 - First);
}

std::string counted(uint64_t Count, std::string_view One) {
  return fmt::format("{} {}{}", Count, One, Count == 1 ? "" : "s");
}

} // namespace vorion
