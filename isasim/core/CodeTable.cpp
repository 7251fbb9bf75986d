#include "core/CodeTable.h"

#include "core/Isa.h"

#include <algorithm>
#include <cstring>

namespace vorion::isasim {

namespace {

uint16_t place(File F, unsigned Number) {
  const unsigned Index = (F == File::F ? FBase : XBase) + Number;
  return static_cast<uint16_t>(Index * sizeof(LaneWords));
}

uint16_t destination(File F, unsigned Number) {
  const bool IsSink = F != File::F && Number == 0;
  return IsSink ? static_cast<uint16_t>(SinkRegister * sizeof(LaneWords))
                : place(F, Number);
}

Insn trapping(const Handler (&Run)[2], uint32_t Word) {
  Insn I{};
  I.Run[0] = Run[0];
  I.Run[1] = Run[1];
  I.Word = Word;
  return I;
}

} // namespace

CodeTable::CodeTable(const Image &Program, const ExecTable &Exec) {
  uint32_t Hi = 0;
  Lo = UINT32_MAX;
  for (const Image::Segment &S : Program.segments())
    if (S.Executable) {
      Lo = std::min(Lo, S.Address);
      Hi = std::max(Hi, S.Address + S.MemBytes);
    }
  const uint32_t Count = Hi > Lo ? (Hi - Lo) / 4 : 0;
  Insns.assign(Count + 1, trapping(Exec.NoFetch, 0));
  for (const Image::Segment &S : Program.segments()) {
    if (!S.Executable)
      continue;
    for (uint32_t Offset = 0; Offset + 4 <= S.MemBytes; Offset += 4) {
      uint32_t Word = 0;
      if (Offset + 4 <= S.Bytes.size())
        std::memcpy(&Word, S.Bytes.data() + Offset, 4);
      const uint32_t Pc = S.Address + Offset;
      Insns[(Pc - Lo) / 4] = decodeAt(Pc, Word, Exec);
    }
  }
}

Insn CodeTable::decodeAt(uint32_t Pc, uint32_t Word,
                         const ExecTable &Exec) const {
  const std::optional<Decoded> D = decode(Word);
  if (!D)
    return trapping(Exec.Illegal, Word);
  const InsnInfo &Info = D->info();
  Insn I = trapping(Exec.Handlers[static_cast<unsigned>(D->Opcode)], Word);
  I.Rd = destination(Info.Rd, D->Rd);
  I.Rs1 = place(Info.Rs1, D->Rs1);
  I.Rs2 = place(Info.Rs2, D->Rs2);
  I.Rs3 =
      Info.Fmt == Format::R4 ? place(Info.Rs3, D->Rs3) : place(Info.Rd, D->Rd);
  I.Imm = D->Imm;
  if (Info.HasRm)
    I.Imm = D->Rm;
  if (D->Opcode == Op::RV_AUIPC)
    I.Imm = static_cast<int32_t>(Pc + static_cast<uint32_t>(D->Imm));
  if (Info.Fmt == Format::B || Info.Fmt == Format::J) {
    const uint32_t Target = Pc + static_cast<uint32_t>(D->Imm);
    if (Target % 4 != 0 || (Target - Lo) / 4 >= count())
      I.Imm = BadTarget;
  }
  return I;
}

const Insn *CodeTable::find(uint32_t Pc) const {
  const uint32_t Index = (Pc - Lo) / 4;
  return Insns.data() + (Pc % 4 == 0 && Index < count() ? Index : count());
}

} // namespace vorion::isasim
