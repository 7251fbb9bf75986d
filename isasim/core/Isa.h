/// Decoding and disassembly from the tables generated out of intrinsics/.
#pragma once

#include "core/IsaTables.h"
#include "core/RoundingMode.h"

#include <optional>
#include <string>

namespace vorion::isasim {

/// The fields of one instruction word. Registers that the instruction does not
/// have are 0.
struct Decoded {
  Op Opcode = Op::RV_LUI;
  uint8_t Rd = 0, Rs1 = 0, Rs2 = 0, Rs3 = 0;
  /// Sign-extended immediate; the shift amount; the zero-extended immediate of
  /// csrrwi and its like. lui and auipc: already shifted left by 12.
  int32_t Imm = 0;
  uint8_t Rm = DynamicRm;
  uint16_t Csr = 0;

  const InsnInfo &info() const {
    return InsnTable[static_cast<unsigned>(Opcode)];
  }
};

/// nullopt for a word that is no instruction of the machine, reserved static
/// rounding modes included.
std::optional<Decoded> decode(uint32_t Word);

/// Assembly text without aliases, ABI register names, branch targets as
/// addresses; ".word 0x..." for what does not decode.
std::string disassemble(uint32_t Word, uint32_t Pc);

} // namespace vorion::isasim
