#include "observe/CodeText.h"

#include "core/Isa.h"

#include <algorithm>
#include <cstring>

namespace vorion::isasim {

uint32_t firstCode(const Image &Program) {
  uint32_t Low = UINT32_MAX;
  for (const Image::Segment &S : Program.segments())
    if (S.Executable)
      Low = std::min(Low, S.Address);
  return Low;
}

std::string instructionText(uint32_t Word, uint32_t Pc) {
  std::string Text = disassemble(Word, Pc);
  std::ranges::replace(Text, '\t', ' ');
  return Text;
}

uint32_t instructionWord(const Image &Program, uint32_t Pc) {
  uint32_t Word = 0;
  if (const auto Bytes = Program.bytesAt(Pc, sizeof(Word)); !Bytes.empty())
    std::memcpy(&Word, Bytes.data(), sizeof(Word));
  return Word;
}

std::string instructionText(const Image &Program, uint32_t Pc) {
  return instructionText(instructionWord(Program, Pc), Pc);
}

} // namespace vorion::isasim
