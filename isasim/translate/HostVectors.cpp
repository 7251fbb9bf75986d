// Constants and moves.

#include "translate/HostVectors.h"

#include "translate/Narrow.h"

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

HostVectors::HostVectors(VectorUnit UnitIn, std::span<uint8_t> Buffer)
    : CodeGenerator(Buffer.size(), Buffer.data()), Unit(UnitIn) {}

//===----------------------------------------------------------------------===//
// Constants
//===----------------------------------------------------------------------===//

Address HostVectors::constant(uint32_t Bits) {
  if (isWide())
    return ptr_b[rip + Numbers[Bits]];
  LaneConstants Words;
  Words.fill(Bits);
  return vectorOf(Words);
}

Address HostVectors::number(uint32_t Bits) { return ptr[rip + Numbers[Bits]]; }

Address HostVectors::vectorOf(const LaneConstants &Words) {
  return ptr[rip + Vectors[Words]];
}

Address HostVectors::laneNumbers(uint32_t Factor) {
  LaneConstants Words{};
  for (uint32_t L = 0; L != MaxLanes; ++L)
    Words[L] = L * Factor;
  return vectorOf(Words);
}

void HostVectors::writeConstants() {
  align(64);
  for (auto &[Words, At] : Vectors) {
    L(At);
    for (const uint32_t Word : Words)
      dd(Word);
  }
  for (auto &[Bits, At] : Numbers) {
    L(At);
    dd(Bits);
  }
}

//===----------------------------------------------------------------------===//
// Moves
//===----------------------------------------------------------------------===//

Ymm HostVectors::inYmm(const Operand &A, int Half, const Ymm &Spare) {
  Ymm In = Spare;
  withHalf(A, Half, Spare, [&](const Operand &From) {
    if (From.isMEM())
      CodeGenerator::vmovdqu(Spare, From);
    else
      In = Ymm(From.getIdx());
  });
  return In;
}

/// A mask's half in a register, MaskHalf if it has none of its own.
Ymm HostVectors::maskInYmm(int Mask, int Half) {
  if (Mask == PairMask)
    return Ymm(MaskPair + Half);
  CodeGenerator::vmovdqa(MaskHalf, halfAt(placeOfMask(Mask), Half));
  return MaskHalf;
}

/// What \p To has of \p Half in \p D, where write() will have its result.
void HostVectors::loadOld(const Zmm &To, int Half, const Ymm &D) {
  withHalf(Zmm(To.getIdx()), Half, D, [&](const Operand &From) {
    if (From.isMEM())
      CodeGenerator::vmovdqa(D, From);
  });
}

void HostVectors::vmovdqu32(const Zmm &To, const Operand &From) {
  if (isWide())
    return CodeGenerator::vmovdqu32(To, From);
  write(To, [&](int Half, const Ymm &D) {
    withHalf(From, Half, D, [&](const Operand &Source) {
      if (Source.isMEM() || Source.getIdx() != D.getIdx())
        CodeGenerator::vmovdqu(D, Source);
    });
  });
}

void HostVectors::vmovdqa32(const Zmm &To, const Operand &From) {
  isWide() ? CodeGenerator::vmovdqa32(To, From) : vmovdqu32(To, From);
}

void HostVectors::vmovaps(const Zmm &To, const Zmm &From) {
  isWide() ? CodeGenerator::vmovaps(To, From) : vmovdqu32(To, From);
}

void HostVectors::vmovdqu32(const Address &To, const Zmm &From) {
  if (isWide())
    return CodeGenerator::vmovdqu32(To, From);
  for (int Half = 0; Half != 2; ++Half) {
    const Ymm Source = inYmm(From, Half, First);
    if (const int Mask = To.getOpmaskIdx(); Mask != 0)
      CodeGenerator::vpmaskmovd(halfOf(To, Half), maskInYmm(Mask, Half),
                                Source);
    else
      CodeGenerator::vmovdqu(halfOf(To, Half), Source);
  }
}

void HostVectors::vmovdqa32(const Address &To, const Zmm &From) {
  isWide() ? CodeGenerator::vmovdqa32(To, From) : vmovdqu32(To, From);
}

void HostVectors::vmovd(const Reg32 &To, const Xmm &From) {
  if (isWide())
    return CodeGenerator::vmovd(To, From);
  if (From.getIdx() < NumPairs)
    return CodeGenerator::vmovd(To, Xmm(2 * From.getIdx()));
  mov(To, dword[rdi + placeOfVector(From.getIdx())]);
}

void HostVectors::vmovd(const Xmm &To, const Address &From) {
  if (isWide())
    return CodeGenerator::vmovd(To, From);
  if (To.getIdx() < NumPairs)
    return CodeGenerator::vmovd(Xmm(2 * To.getIdx()), From);
  CodeGenerator::vmovd(Xmm(Out.getIdx()), From);
  CodeGenerator::vmovdqa(halfAt(placeOfVector(To.getIdx()), 0), Out);
}

void HostVectors::vpbroadcastd(const Zmm &To, const Operand &From) {
  if (isWide())
    return CodeGenerator::vpbroadcastd(To, From);
  if (From.isMEM())
    CodeGenerator::vpbroadcastd(Second, From);
  else if (From.getIdx() < NumPairs)
    CodeGenerator::vpbroadcastd(Second, Xmm(2 * From.getIdx()));
  else
    CodeGenerator::vpbroadcastd(Second,
                                dword[rdi + placeOfVector(From.getIdx())]);
  write(To, [&](int, const Ymm &D) { CodeGenerator::vmovdqa(D, Second); });
}

void HostVectors::vpbroadcastd(const Zmm &To, const Reg32 &From) {
  if (isWide())
    return CodeGenerator::vpbroadcastd(To, From);
  CodeGenerator::vmovd(Xmm(Second.getIdx()), From);
  CodeGenerator::vpbroadcastd(Second, Xmm(Second.getIdx()));
  write(To, [&](int, const Ymm &D) { CodeGenerator::vmovdqa(D, Second); });
}

namespace {

/// What the words of half of the lanes are made of, \p Bytes bytes each.
Address narrowHalfOf(const Address &A, int Half, int Bytes) {
  constexpr int LanesOfHalf = 8;
  return {0, false, A.getRegExp(false) + Half * LanesOfHalf * Bytes};
}

} // namespace

#define VORION_WIDENED(INSN, BYTES)                                            \
  void HostVectors::INSN(const Zmm &To, const Address &From) {                 \
    if (isWide())                                                              \
      return CodeGenerator::INSN(To, From);                                    \
    write(To, [&](int Half, const Ymm &D) {                                    \
      CodeGenerator::INSN(D, narrowHalfOf(From, Half, BYTES));                 \
    });                                                                        \
  }
VORION_WIDENED(vpmovsxwd, 2)
VORION_WIDENED(vpmovzxwd, 2)
VORION_WIDENED(vpmovsxbd, 1)
VORION_WIDENED(vpmovzxbd, 1)
#undef VORION_WIDENED

void HostVectors::vpblendmd(const Zmm &To, const Zmm &Else,
                            const Operand &Then) {
  if (isWide())
    return CodeGenerator::vpblendmd(To, Else, Then);
  // Its mask chooses, and all lanes are written.
  write(Zmm(To.getIdx()), [&](int Half, const Ymm &D) {
    const Ymm Otherwise = inYmm(Else, Half, Second);
    const Ymm Chosen = maskInYmm(To.getOpmaskIdx(), Half);
    withHalf(Then, Half, First, [&](const Operand &Source) {
      CodeGenerator::vblendvps(D, Otherwise, Source, Chosen);
    });
  });
}

void HostVectors::vpermd(const Zmm &To, const Zmm &Index, const Zmm &From) {
  if (isWide())
    return CodeGenerator::vpermd(To, Index, From);
  // From memory, since To may be From: the halves need both halves.
  const int Copy = placeOfSpare();
  vmovdqa32(ptr[rdi + Copy], From);
  constexpr uint8_t WhichHalf = 28; // bit 3 becomes the sign
  write(To, [&](int Half, const Ymm &D) {
    const Ymm In = inYmm(Index, Half, Second);
    CodeGenerator::vpslld(MaskHalf, In, WhichHalf);
    CodeGenerator::vpermd(First, In, halfAt(Copy, 1));
    CodeGenerator::vpermd(D, In, halfAt(Copy, 0));
    CodeGenerator::vblendvps(D, D, First, MaskHalf);
  });
}

void HostVectors::spreadLane(const Zmm &To, const Zmm &From,
                             const Reg32 &Index) {
  if (isWide()) {
    CodeGenerator::vpbroadcastd(To, Index);
    CodeGenerator::vpermd(To, To, From);
    return CodeGenerator::vmovd(Index, Xmm(To.getIdx()));
  }
  const int Copy = placeOfSpare();
  vmovdqa32(ptr[rdi + Copy], From);
  mov(Index, dword[rdi + Index.cvt64() * 4 + Copy]);
  vpbroadcastd(To, Index);
}

void HostVectors::gather(const Zmm &To, const Zmm &Offsets) {
  if (isWide())
    return CodeGenerator::vpgatherdd(To | k2, ptr[rcx + Offsets]);
  write(To, [&](int Half, const Ymm &D) {
    // Not from where they are: qemu 7.2 takes ymm4 for no index at all.
    withHalf(Offsets, Half, Second, [&](const Operand &From) {
      CodeGenerator::vmovdqa(Second, From);
    });
    loadOld(To, Half, D);
    CodeGenerator::vpgatherdd(D, ptr[rcx + Second], Ymm(MaskPair + Half));
  });
}

/// Lets \p Store store edx, which has an active lane's value, at the address
/// that it is given: \p Offsets behind rcx, or without these where the lane's
/// \p Bytes lie if those of all lanes are neighbours from rcx on. One lane
/// after the other.
void HostVectors::forActiveLanes(
    const Zmm &Values, const Zmm *Offsets, int Bytes, bool AreAllActive,
    const std::function<void(const RegExp &)> &Store) {
  const int ValuesAt = placeOfSpare(), OffsetsAt = placeOfSpare(1);
  vmovdqa32(ptr[rdi + ValuesAt], Values);
  if (Offsets)
    vmovdqa32(ptr[rdi + OffsetsAt], *Offsets);
  if (AreAllActive) {
    for (int L = 0; L != static_cast<int>(MaxLanes); ++L) {
      mov(edx, dword[rdi + (ValuesAt + 4 * L)]);
      if (Offsets)
        mov(eax, dword[rdi + (OffsetsAt + 4 * L)]);
      Store(Offsets ? rcx + rax : rcx + L * Bytes);
    }
    return;
  }
  Label Next;
  mov(r11d, dword[rdi + VORION_PLACE(Mask)]);
  L(Next);
  tzcnt(eax, r11d);
  mov(edx, dword[rdi + rax * 4 + ValuesAt]);
  if (Offsets)
    mov(eax, dword[rdi + rax * 4 + OffsetsAt]);
  Store(Offsets ? rcx + rax : rcx + rax * Bytes);
  blsr(r11d, r11d);
  jnz(Next);
}

void HostVectors::scatter(const Zmm &Offsets, const Zmm &Values,
                          bool AreAllActive) {
  if (isWide())
    return CodeGenerator::vpscatterdd(ptr[rcx + Offsets] | k2, Values);
  forActiveLanes(Values, &Offsets, 4, AreAllActive,
                 [this](const RegExp &At) { mov(dword[At], edx); });
}

/// For forActiveLanes().
std::function<void(const RegExp &)> HostVectors::narrowStore(int Bytes) {
  return [this, Bytes](const RegExp &At) {
    Bytes == 2 ? mov(word[At], dx) : mov(byte[At], dl);
  };
}

void HostVectors::scatterNarrow(int Bytes, const Zmm &Offsets,
                                const Zmm &Values, bool AreAllActive) {
  forActiveLanes(Values, &Offsets, Bytes, AreAllActive, narrowStore(Bytes));
}

void HostVectors::storeNarrow(int Bytes, const Zmm &Values, bool AreAllActive) {
  if (isWide()) {
    const Address To = AreAllActive ? ptr[rcx] : ptr[rcx] | k1;
    return Bytes == 2 ? CodeGenerator::vpmovdw(To, Values)
                      : CodeGenerator::vpmovdb(To, Values);
  }
  if (AreAllActive) {
    const Address Low = constant(Bytes == 2 ? 0xFFFFU : 0xFFU);
    for (const int Half : {0, 1})
      CodeGenerator::vpand(Half == 0 ? First : Second, inYmm(Values, Half, Out),
                           halfOf(Low, Half));
    CodeGenerator::vpackusdw(First, First, Second);
    CodeGenerator::vpermq(First, First, QuartersInOrder);
    if (Bytes == 2)
      return CodeGenerator::vmovdqu(ptr[rcx], First);
    CodeGenerator::vextracti128(Xmm(Second.getIdx()), First, 1);
    CodeGenerator::vpackuswb(Xmm(First.getIdx()), Xmm(First.getIdx()),
                             Xmm(Second.getIdx()));
    return CodeGenerator::vmovdqu(ptr[rcx], Xmm(First.getIdx()));
  }
  forActiveLanes(Values, nullptr, Bytes, AreAllActive, narrowStore(Bytes));
}

} // namespace vorion::isasim::translate
