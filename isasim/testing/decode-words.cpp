/// Disassembles the hexadecimal words of its standard input, one a line, as if
/// they lay at addresses 0, 4, 8, ...: for comparison with another
/// disassembler.

#include "core/Isa.h"

#include <cstdio>
#include <fmt/format.h>

int main() {
  uint32_t Pc = 0;
  unsigned Word = 0;
  while (std::scanf("%x", &Word) == 1) {
    fmt::print("{}\n", vorion::isasim::disassemble(Word, Pc));
    Pc += 4;
  }
  return 0;
}
