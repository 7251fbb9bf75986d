/// A program for the device: what it is linked from beside its own objects, and
/// what is written into it afterwards.
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::link {

/// What lld calls itself in its messages, its first argument.
inline constexpr const char *LinkerName = "ld.lld-19";

/// What lld is called with to link a program of \p Given, objects and options:
/// start-up code, linker script and library come from the folder lib/vorion
/// beside the folder of this executable. Errors: one of them is missing.
Expected<std::vector<std::string>>
programArguments(const std::vector<std::string> &Given);

/// Completes the kernel table of a linked \p Program, and prints a warning of
/// \p Tool for each stack that no machine provides. \p File is used in
/// messages only; empty if the program is in none.
Expected<Success> completeProgram(std::span<std::byte> Program,
                                  std::string_view Tool,
                                  const std::string &File);

} // namespace vorion::link
