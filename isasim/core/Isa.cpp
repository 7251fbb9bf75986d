#include "core/Isa.h"

#include <array>
#include <cstring>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace vorion::isasim {

namespace {

constexpr uint32_t bits(uint32_t Word, unsigned Low, unsigned Width) {
  return Word >> Low & ((1U << Width) - 1);
}

constexpr int32_t signExtend(uint32_t Value, unsigned Width) {
  const unsigned Shift = 32 - Width;
  return static_cast<int32_t>(Value << Shift) >> Shift;
}

// RISC-V unprivileged specification, "Immediate encoding variants".
int32_t immediate(Format F, uint32_t W) {
  switch (F) {
  case Format::I:
    return signExtend(bits(W, 20, 12), 12);
  case Format::S:
    return signExtend(bits(W, 25, 7) << 5 | bits(W, 7, 5), 12);
  case Format::B:
    return signExtend(bits(W, 31, 1) << 12 | bits(W, 7, 1) << 11 |
                          bits(W, 25, 6) << 5 | bits(W, 8, 4) << 1,
                      13);
  case Format::U:
    return static_cast<int32_t>(W & 0xFFFFF000);
  case Format::J:
    return signExtend(bits(W, 31, 1) << 20 | bits(W, 12, 8) << 12 |
                          bits(W, 20, 1) << 11 | bits(W, 21, 10) << 1,
                      21);
  case Format::IShift:
    return static_cast<int32_t>(bits(W, 20, 5));
  case Format::ICsrImm:
    return static_cast<int32_t>(bits(W, 15, 5));
  case Format::R:
  case Format::R4:
  case Format::ICsr:
  case Format::Plain:
    return 0;
  }
  return 0;
}

// Instructions by major opcode, so that decoding looks at a few records only.
class Buckets {
public:
  Buckets() {
    for (unsigned I = 0; I != NumOps; ++I)
      ByOpcode[InsnTable[I].Match & 0x7F].push_back(static_cast<Op>(I));
  }
  const std::vector<Op> &of(uint32_t Word) const {
    return ByOpcode[Word & 0x7F];
  }

private:
  std::array<std::vector<Op>, 128> ByOpcode;
};

constexpr const char *XNames[32] = {
    "zero", "ra", "sp", "gp", "tp",  "t0",  "t1", "t2", "s0", "s1", "a0",
    "a1",   "a2", "a3", "a4", "a5",  "a6",  "a7", "s2", "s3", "s4", "s5",
    "s6",   "s7", "s8", "s9", "s10", "s11", "t3", "t4", "t5", "t6"};
constexpr const char *FNames[32] = {
    "ft0", "ft1", "ft2",  "ft3",  "ft4", "ft5", "ft6",  "ft7",
    "fs0", "fs1", "fa0",  "fa1",  "fa2", "fa3", "fa4",  "fa5",
    "fa6", "fa7", "fs2",  "fs3",  "fs4", "fs5", "fs6",  "fs7",
    "fs8", "fs9", "fs10", "fs11", "ft8", "ft9", "ft10", "ft11"};
constexpr const char *RmNames[8] = {"rne", "rtz", "rdn", "rup",
                                    "rmm", "?",   "?",   "dyn"};

std::string fenceOperands(uint32_t Word) {
  auto Set = [](uint32_t Bits) {
    std::string Text;
    for (unsigned I = 0; I != 4; ++I)
      if (Bits >> (3 - I) & 1)
        Text += "iorw"[I];
    return Text.empty() ? std::string("0") : Text;
  };
  return Set(bits(Word, 24, 4)) + ", " + Set(bits(Word, 20, 4));
}

std::string operand(std::string_view Token, const Decoded &D, uint32_t Word,
                    uint32_t Pc) {
  const bool IsF = Token.size() > 1 && Token[0] == 'f' && Token[1] == 'r';
  const char *const *Names = IsF ? FNames : XNames;
  const std::string_view Name = IsF ? Token.substr(1) : Token;
  if (Name == "rd")
    return Names[D.Rd];
  if (Name == "rs1")
    return Names[D.Rs1];
  if (Name == "rs2")
    return Names[D.Rs2];
  if (Name == "rs3")
    return Names[D.Rs3];
  if (Name == "rm")
    return RmNames[D.Rm];
  if (Name == "uimm20")
    return fmt::format("{}", static_cast<uint32_t>(D.Imm) >> 12);
  if (Name == "target")
    return fmt::format("0x{:x}", Pc + static_cast<uint32_t>(D.Imm));
  if (Name == "fence")
    return fenceOperands(Word);
  if (Name == "csr") {
    const CsrInfo *Info = findCsrInfo(D.Csr);
    return Info ? Info->Name : fmt::format("0x{:x}", D.Csr);
  }
  return fmt::format("{}", D.Imm); // imm, uimm, shamt
}

} // namespace

std::optional<Decoded> decode(uint32_t Word) {
  // Never destroyed: a program's static objects may outlast ours, and run code.
  static const Buckets &Table = *new Buckets;
  for (const Op O : Table.of(Word)) {
    const InsnInfo &Info = InsnTable[static_cast<unsigned>(O)];
    if ((Word & Info.Mask) != Info.Match)
      continue;
    Decoded D;
    D.Opcode = O;
    D.Rd = Info.Rd == File::None ? 0 : bits(Word, 7, 5);
    D.Rs1 = Info.Rs1 == File::None ? 0 : bits(Word, 15, 5);
    D.Rs2 = Info.Rs2 == File::None ? 0 : bits(Word, 20, 5);
    D.Rs3 = Info.Rs3 == File::None ? 0 : bits(Word, 27, 5);
    D.Imm = immediate(Info.Fmt, Word);
    if (Info.Fmt == Format::ICsr || Info.Fmt == Format::ICsrImm)
      D.Csr = bits(Word, 20, 12);
    if (Info.HasRm) {
      D.Rm = bits(Word, 12, 3);
      if (D.Rm == 5 || D.Rm == 6)
        return std::nullopt;
    }
    return D;
  }
  return std::nullopt;
}

std::string disassemble(uint32_t Word, uint32_t Pc) {
  const std::optional<Decoded> D = decode(Word);
  if (!D)
    return fmt::format(".word 0x{:08x}", Word);
  std::string Text = D->info().Mnemonic;
  if ((Word & 0x7F) == 0x2F) // AMO: the ordering bits are part of the name
    Text += std::array{"", ".rl", ".aq", ".aqrl"}[bits(Word, 25, 2)];
  std::string_view Syntax = D->info().Syntax;
  // The default rounding mode is left out, with its comma.
  if (D->info().HasRm && D->Rm == DynamicRm)
    Syntax.remove_suffix(std::strlen(", rm"));
  if (!Syntax.empty())
    Text += '\t';
  while (!Syntax.empty()) {
    const size_t Length = std::min(Syntax.find_first_of(",() "), Syntax.size());
    if (Length == 0) {
      Text += Syntax[0];
      Syntax.remove_prefix(1);
      continue;
    }
    Text += operand(Syntax.substr(0, Length), *D, Word, Pc);
    Syntax.remove_prefix(Length);
  }
  return Text;
}

} // namespace vorion::isasim
