/// Instruction words that many tests write, by their mnemonics, in the order of
/// operands of an assembler.
#pragma once

#include "testing/Encode.h"

#include <vector>

namespace vorion::isasim::testing {

inline uint32_t addi(unsigned Rd, unsigned Rs1, int32_t Imm) {
  return encode(Op::RV_ADDI, {.Rd = Rd, .Rs1 = Rs1, .Imm = Imm});
}
/// Of the upper 20 bits of \p Value.
inline uint32_t lui(unsigned Rd, uint32_t Value) {
  return encode(Op::RV_LUI,
                {.Rd = Rd, .Imm = static_cast<int32_t>(Value >> 12)});
}
/// \p Csr: the number, or its name in an enumeration as raster::Csr.
template <typename CsrNumber> uint32_t csrr(unsigned Rd, CsrNumber Csr) {
  return encode(Op::RV_CSRRS,
                {.Rd = Rd, .Rs1 = 0, .Csr = static_cast<unsigned>(Csr)});
}
template <typename CsrNumber> uint32_t csrw(CsrNumber Csr, unsigned Rs1) {
  return encode(Op::RV_CSRRW,
                {.Rd = 0, .Rs1 = Rs1, .Csr = static_cast<unsigned>(Csr)});
}
inline uint32_t lw(unsigned Rd, int32_t Imm, unsigned Rs1) {
  return encode(Op::RV_LW, {.Rd = Rd, .Rs1 = Rs1, .Imm = Imm});
}
inline uint32_t sw(unsigned Rs2, int32_t Imm, unsigned Rs1) {
  return encode(Op::RV_SW, {.Rs1 = Rs1, .Rs2 = Rs2, .Imm = Imm});
}
inline uint32_t bne(unsigned Rs1, unsigned Rs2, int32_t Imm) {
  return encode(Op::RV_BNE, {.Rs1 = Rs1, .Rs2 = Rs2, .Imm = Imm});
}

/// Adds to \p To what puts \p Value into \p Rd.
inline void loadConstant(std::vector<uint32_t> &To, unsigned Rd,
                         uint32_t Value) {
  // addi may take up to 0x800 away again.
  To.push_back(lui(Rd, Value + 0x800));
  To.push_back(addi(Rd, Rd, static_cast<int32_t>(Value << 20) >> 20));
}

} // namespace vorion::isasim::testing
