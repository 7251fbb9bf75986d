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

} // namespace vorion
