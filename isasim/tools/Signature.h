/// The signature of an architectural test: the memory between two symbols of
/// the program, as text.
#pragma once

#include "vorion/isasim/Machine.h"

#include <string>

namespace vorion::isasim {

/// Writes [begin_signature, end_signature) of the loaded program to \p File as
/// riscv-arch-test and Spike have it: a line for each \p Granularity bytes (1,
/// 2, 4, 8 or 16), hexadecimal, the highest address first; what is missing of
/// the last line is 0. Errors: no such symbols, or not memory; no such file.
Expected<Success> writeSignature(const Machine &M, const std::string &File,
                                 unsigned Granularity);

} // namespace vorion::isasim
