/// A program's instructions as reports show them.
#pragma once

#include "vorion/isasim/Image.h"

#include <cstdint>
#include <string>

namespace vorion::isasim {

/// The address of the instruction that is number 0.
uint32_t firstCode(const Image &Program);

/// "lw a5, 0(a4)".
std::string instructionText(uint32_t Word, uint32_t Pc);
/// Of the one at \p Pc.
std::string instructionText(const Image &Program, uint32_t Pc);

} // namespace vorion::isasim
