/// Letters, blanks, and words for numbers of things.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vorion {

/// \p Text with its ASCII letters as capitals.
std::string upperCase(std::string Text);

/// \p Text with its ASCII letters as small ones.
std::string lowerCase(std::string Text);

/// \p Text without the \p Blanks around it.
std::string_view trimmed(std::string_view Text,
                         std::string_view Blanks = " \t");

/// "1 place", "2 places": \p Count, and \p One in its singular or with an s.
std::string counted(uint64_t Count, std::string_view One);

} // namespace vorion
