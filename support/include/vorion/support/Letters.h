/// Letters and blanks.
#pragma once

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

} // namespace vorion
