/// A program's instructions as reports show them.
#pragma once

#include "vorion/isasim/Image.h"

#include <cstdint>
#include <string>

namespace vorion::isasim {

/// The address of the instruction that is number 0.
uint32_t firstCode(const Image &Program);

/// The instruction at \p Pc as it is encoded; 0 of what is not in the file.
uint32_t instructionWord(const Image &Program, uint32_t Pc);

/// "lw a5, 0(a4)".
std::string instructionText(uint32_t Word, uint32_t Pc);
/// Of the one at \p Pc.
std::string instructionText(const Image &Program, uint32_t Pc);

} // namespace vorion::isasim
