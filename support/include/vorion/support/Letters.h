/// Capital and small letters.
#pragma once

#include <string>

namespace vorion {

/// \p Text with its ASCII letters as capitals.
std::string upperCase(std::string Text);

/// \p Text with its ASCII letters as small ones.
std::string lowerCase(std::string Text);

} // namespace vorion
