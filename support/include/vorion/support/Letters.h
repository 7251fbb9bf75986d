/// String helpers: case, trimming, plurals.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vorion {

/// \p Text with ASCII letters in upper case.
std::string upperCase(std::string Text);

/// \p Text with ASCII letters in lower case.
std::string lowerCase(std::string Text);

/// \p Text without leading and trailing \p Blanks.
std::string_view trimmed(std::string_view Text,
                         std::string_view Blanks = " \t");

/// "1 place", "2 places": \p Count, and \p One in the singular or with an s.
std::string counted(uint64_t Count, std::string_view One);

} // namespace vorion
