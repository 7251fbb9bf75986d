/// How HostVectors writes an operation of 16 lanes for AVX2: once for each half
/// of the lanes.
#pragma once

#include "translate/HeldVectors.h"
#include "translate/HostVectors.h"
#include "translate/Places.h"

namespace vorion::isasim::translate {

/// Vectors that lie in two registers of the host each, from ymm0 on, and the
/// mask k2 behind them.
inline constexpr int NumPairs = HeldVectors::Count;
inline constexpr int MaskPair = 2 * NumPairs;
inline constexpr int HalfBytes = 32;
inline constexpr uint8_t WordBits = 32;
inline constexpr uint32_t OneBits = 0x3F800000; ///< the float 1

/// vpermq: the lanes of two halves that were packed into one, which the host
/// packs a quarter at a time.
inline constexpr uint8_t QuartersInOrder = 0b11'01'10'00;

/// What an operation computes in, its mask, and two more.
inline const Xbyak::Ymm Out(12), MaskHalf(13), First(14), Second(15);

/// Masks by number.
inline constexpr int ActiveMask = 1, PairMask = 2;

/// What WarpState::HostSpare has, one behind the other: zmm5 to zmm7, k3 and
/// k4, and vectors for one instruction of HostVectors.
inline constexpr int NumMemoryVectors = 3, NumMemoryMasks = 2, NumSpares = 3;
static_assert(sizeof(WarpState::HostSpare) ==
              (NumMemoryVectors + NumMemoryMasks + NumSpares) *
                  sizeof(LaneWords));

/// Where the vector \p Number of them lies, from WarpState on.
inline int placeInSpare(int Number) {
  return VORION_PLACE(HostSpare) + Number * static_cast<int>(sizeof(LaneWords));
}
/// Where a vector or a mask that has no registers lies.
inline int placeOfVector(int Index) { return placeInSpare(Index - NumPairs); }
inline int placeOfMask(int Mask) {
  return Mask == ActiveMask
             ? VORION_PLACE(MaskWords)
             : placeInSpare(NumMemoryVectors + Mask - PairMask - 1);
}
/// Where the vector number \p Which lies that is for one instruction.
inline int placeOfSpare(int Which = 0) {
  return placeInSpare(NumMemoryVectors + NumMemoryMasks + Which);
}

inline Xbyak::Address halfAt(int Place, int Half) {
  using namespace Xbyak::util;
  return ptr[rdi + (Place + Half * HalfBytes)];
}

/// Half of the 64 bytes at \p A.
inline Xbyak::Address halfOf(const Xbyak::Address &A, int Half) {
  using namespace Xbyak;
  const int Offset = Half * HalfBytes;
  if (A.getMode() == Address::M_rip)
    return {256, false,
            RegRip(static_cast<int64_t>(A.getDisp()) + Offset, A.getLabel())};
  return {256, false, A.getRegExp(false) + Offset};
}

/// Lets \p Use have half of \p A, a vector or memory, as an operand that may
/// lie in memory.
template <typename F>
void HostVectors::withHalf(const Operand &A, int Half, const Ymm &Spare,
                           F Use) {
  if (!A.isMEM()) {
    if (A.getIdx() < NumPairs)
      return Use(Ymm(2 * A.getIdx() + Half));
    return Use(halfAt(placeOfVector(A.getIdx()), Half));
  }
  const Address &In = A.getAddress();
  if (!In.isBroadcast())
    return Use(halfOf(In, Half));
  CodeGenerator::vpbroadcastd(
      Spare, In.getMode() == Address::M_rip
                 ? Xbyak::util::ptr[Xbyak::RegRip(
                       static_cast<int64_t>(In.getDisp()), In.getLabel())]
                 : Xbyak::util::ptr[In.getRegExp()]);
  Use(Spare);
}

/// The same of a mask.
template <typename F> void HostVectors::withMask(int Mask, int Half, F Use) {
  if (Mask == PairMask)
    return Use(Ymm(MaskPair + Half));
  Use(halfAt(placeOfMask(Mask), Half));
}

/// Lets \p Compute(half, register) compute each half of \p To, which may have a
/// mask.
template <typename F> void HostVectors::write(const Zmm &To, F Compute) {
  const int Mask = To.getOpmaskIdx();
  for (int Half = 0; Half != 2; ++Half) {
    const bool HasRegister = To.getIdx() < NumPairs;
    const Ymm Kept = HasRegister ? Ymm(2 * To.getIdx() + Half) : First;
    const auto Store = [&](const Ymm &From) {
      if (!HasRegister)
        CodeGenerator::vmovdqa(halfAt(placeOfVector(To.getIdx()), Half), From);
      else if (From.getIdx() != Kept.getIdx())
        CodeGenerator::vmovdqa(Kept, From);
    };
    if (Mask == 0) {
      const Ymm D = HasRegister ? Kept : Out;
      Compute(Half, D);
      Store(D);
      continue;
    }
    Compute(Half, Out);
    if (To.hasZero()) {
      const Ymm D = HasRegister ? Kept : Out;
      withMask(Mask, Half,
               [&](const Operand &M) { CodeGenerator::vpand(D, Out, M); });
      Store(D);
      continue;
    }
    if (!HasRegister)
      CodeGenerator::vmovdqa(Kept, halfAt(placeOfVector(To.getIdx()), Half));
    CodeGenerator::vblendvps(Kept, Kept, Out, maskInYmm(Mask, Half));
    if (!HasRegister)
      Store(Kept);
  }
}

/// The same for a mask: lanes where \p Compute gives all ones, or 0 if
/// \p IsInverted, among those of its own mask.
template <typename F>
void HostVectors::write(const Opmask &To, bool IsInverted, F Compute) {
  const int Mask = To.getOpmaskIdx(), Index = To.getIdx();
  for (int Half = 0; Half != 2; ++Half) {
    const Ymm D = Index == PairMask ? Ymm(MaskPair + Half) : Out;
    const bool IsPlain = Mask == 0 && !IsInverted;
    Compute(Half, IsPlain ? D : Out);
    if (Mask != 0)
      withMask(Mask, Half, [&](const Operand &M) {
        IsInverted ? CodeGenerator::vpandn(D, Out, M)
                   : CodeGenerator::vpand(D, Out, M);
      });
    else if (IsInverted) {
      CodeGenerator::vpcmpeqd(MaskHalf, MaskHalf, MaskHalf);
      CodeGenerator::vpxor(D, Out, MaskHalf);
    }
    if (Index != PairMask)
      CodeGenerator::vmovdqa(halfAt(placeOfMask(Index), Half), D);
  }
}

/// \p Insn(to, first, second) for each half; the second may lie in memory.
template <typename F>
void HostVectors::ofTwo(const Zmm &To, const Zmm &A, const Operand &B, F Insn) {
  write(To, [&](int Half, const Ymm &D) {
    const Ymm Left = inYmm(A, Half, First);
    withHalf(B, Half, Second,
             [&](const Operand &Right) { Insn(D, Left, Right); });
  });
}

template <typename F>
void HostVectors::ofOne(const Zmm &To, const Zmm &A, F Insn) {
  write(To, [&](int Half, const Ymm &D) { Insn(D, inYmm(A, Half, First)); });
}

} // namespace vorion::isasim::translate
