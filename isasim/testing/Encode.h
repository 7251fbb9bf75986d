/// Instruction words for tests: the inverse of decode(), written from the
/// specification's format pictures.
#pragma once

#include "core/IsaTables.h"

namespace vorion::isasim::testing {

struct Fields {
  unsigned Rd = 0, Rs1 = 0, Rs2 = 0, Rs3 = 0;
  int32_t Imm = 0; ///< also shift amounts; U: the upper 20 bits
  unsigned Rm = 7;
  unsigned Csr = 0;
};

inline uint32_t encode(Op O, const Fields &F) {
  const InsnInfo &Info = InsnTable[static_cast<unsigned>(O)];
  const auto Imm = static_cast<uint32_t>(F.Imm);
  uint32_t W = Info.Match;
  auto Put = [&](uint32_t Value, unsigned Low, unsigned Width) {
    const uint32_t Field = ((1U << Width) - 1) << Low;
    W |= (Value << Low) & Field & ~Info.Mask;
  };
  if (Info.Rd != File::None)
    Put(F.Rd, 7, 5);
  if (Info.Rs1 != File::None)
    Put(F.Rs1, 15, 5);
  if (Info.Rs2 != File::None)
    Put(F.Rs2, 20, 5);
  if (Info.Rs3 != File::None)
    Put(F.Rs3, 27, 5);
  if (Info.HasRm)
    Put(F.Rm, 12, 3);
  switch (Info.Fmt) {
  case Format::I:
    Put(Imm, 20, 12);
    break;
  case Format::IShift:
    Put(Imm, 20, 5);
    break;
  case Format::S:
    Put(Imm, 7, 5);
    Put(Imm >> 5, 25, 7);
    break;
  case Format::B:
    Put(Imm >> 11, 7, 1);
    Put(Imm >> 1, 8, 4);
    Put(Imm >> 5, 25, 6);
    Put(Imm >> 12, 31, 1);
    break;
  case Format::U:
    Put(Imm, 12, 20);
    break;
  case Format::J:
    Put(Imm >> 12, 12, 8);
    Put(Imm >> 11, 20, 1);
    Put(Imm >> 1, 21, 10);
    Put(Imm >> 20, 31, 1);
    break;
  case Format::ICsr:
    Put(F.Csr, 20, 12);
    break;
  case Format::ICsrImm:
    Put(Imm, 15, 5);
    Put(F.Csr, 20, 12);
    break;
  default:
    break;
  }
  return W;
}

} // namespace vorion::isasim::testing
