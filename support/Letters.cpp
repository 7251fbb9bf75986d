#include "vorion/support/Letters.h"

#include <algorithm>
#include <cctype>

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

} // namespace vorion
