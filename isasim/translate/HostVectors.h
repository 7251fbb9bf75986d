/// The host's instructions over 16 lanes. What the translator writes is named
/// after AVX-512: a Zmm is a vector of 16 lanes, an Opmask a bit for each of
/// them. With AVX-512 each is one instruction. A host that has AVX2 alone gets
/// several that do the same.
#pragma once

#include "core/State.h"
#include "translate/VectorUnit.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <xbyak/xbyak.h>

namespace vorion::isasim::translate {

/// The encoding of vpcmpd and vpcmpud.
enum class Relation : uint8_t {
  Equal = 0,
  Less = 1,
  LessEqual = 2,
  NotEqual = 4,
  NotLess = 5,
  Greater = 6,
};

/// vcmpps: a NaN among the operands.
inline constexpr uint8_t Unordered = 3;

/// A bit for each lane.
inline constexpr uint32_t AllBits = (1U << MaxLanes) - 1;

/// Words of the lanes, as constants of the code.
using LaneConstants = std::array<uint32_t, MaxLanes>;

/// With AVX2, vectors 0 to 4 are two of the host's registers each, and so is
/// the mask k2. The others lie in WarpState::HostSpare; k1, which has the
/// active lanes, is WarpState::MaskWords. ymm12 to ymm15 are for one
/// instruction. A float operation whose destination has the mask k1 raises no
/// flags for other lanes: they compute with 0, or are divided by 1.
///
/// Functions that are named as the host's instructions do what these do, but
/// for flags of the host that nobody asks for.
class HostVectors : public Xbyak::CodeGenerator {
public:
  using Zmm = Xbyak::Zmm;
  using Xmm = Xbyak::Xmm;
  using Ymm = Xbyak::Ymm;
  using Opmask = Xbyak::Opmask;
  using Operand = Xbyak::Operand;
  using Address = Xbyak::Address;
  using Reg32 = Xbyak::Reg32;

  HostVectors(VectorUnit Unit, std::span<uint8_t> Buffer);
  bool isWide() const { return Unit == VectorUnit::Avx512; }

  /// \name Constants
  /// @{
  /// \p Bits in each lane, as an operand that is read from memory.
  Address constant(uint32_t Bits);
  /// The same as one word.
  Address number(uint32_t Bits);
  /// Numbers of the lanes times \p Factor.
  Address laneNumbers(uint32_t Factor);
  Address vectorOf(const LaneConstants &Words);
  void writeConstants();
  /// @}

  /// \name Moves
  /// @{
  void vmovdqa32(const Zmm &To, const Operand &From);
  void vmovdqa32(const Address &To, const Zmm &From);
  void vmovdqu32(const Zmm &To, const Operand &From);
  void vmovdqu32(const Address &To, const Zmm &From);
  void vmovaps(const Zmm &To, const Zmm &From);
  void vmovd(const Reg32 &To, const Xmm &From);
  void vmovd(const Xmm &To, const Address &From);
  void vpbroadcastd(const Zmm &To, const Operand &From);
  void vpbroadcastd(const Zmm &To, const Reg32 &From);
  void vpmovsxwd(const Zmm &To, const Address &From);
  void vpmovzxwd(const Zmm &To, const Address &From);
  void vpmovsxbd(const Zmm &To, const Address &From);
  void vpmovzxbd(const Zmm &To, const Address &From);
  void vpblendmd(const Zmm &To, const Zmm &Else, const Operand &Then);
  void vpermd(const Zmm &To, const Zmm &Index, const Zmm &From);
  /// Lane \p Index of \p From in every lane of \p To, and in \p Index.
  void spreadLane(const Zmm &To, const Zmm &From, const Reg32 &Index);
  /// Words at rcx + \p Offsets, in the lanes of k2, which is lost.
  void gather(const Zmm &To, const Zmm &Offsets);
  /// Active lanes' \p Values to rcx + \p Offsets, in the order of the lanes.
  /// k2 has the active lanes, and is lost. May overwrite rax, rdx and r11.
  void scatter(const Zmm &Offsets, const Zmm &Values, bool AreAllActive);
  /// The same for their lowest \p Bytes bytes (1 or 2).
  void scatterNarrow(int Bytes, const Zmm &Offsets, const Zmm &Values,
                     bool AreAllActive);
  /// The lowest \p Bytes bytes (1 or 2) of active lanes' \p Values side by side
  /// to rcx. May overwrite rax, rdx and r11.
  void storeNarrow(int Bytes, const Zmm &Values, bool AreAllActive);
  /// @}

  /// \name Integers
  /// @{
  void vpaddd(const Zmm &To, const Zmm &A, const Operand &B);
  void vpsubd(const Zmm &To, const Zmm &A, const Operand &B);
  void vpmulld(const Zmm &To, const Zmm &A, const Operand &B);
  void vpmuldq(const Zmm &To, const Zmm &A, const Operand &B);
  void vpmuludq(const Zmm &To, const Zmm &A, const Operand &B);
  void vpandd(const Zmm &To, const Zmm &A, const Operand &B);
  void vpandnd(const Zmm &To, const Zmm &A, const Operand &B);
  void vpord(const Zmm &To, const Zmm &A, const Operand &B);
  void vpxord(const Zmm &To, const Zmm &A, const Operand &B);
  void vpshufb(const Zmm &To, const Zmm &A, const Operand &B);
  void vpslld(const Zmm &To, const Zmm &A, uint8_t Count);
  void vpslld(const Zmm &To, const Zmm &A, const Xmm &Count);
  void vpsrld(const Zmm &To, const Zmm &A, uint8_t Count);
  void vpsrad(const Zmm &To, const Zmm &A, uint8_t Count);
  void vpsrlq(const Zmm &To, const Zmm &A, uint8_t Count);
  void vprold(const Zmm &To, const Zmm &A, uint8_t Count);
  void vpsllvd(const Zmm &To, const Zmm &A, const Operand &B);
  void vpsrlvd(const Zmm &To, const Zmm &A, const Operand &B);
  void vpsravd(const Zmm &To, const Zmm &A, const Operand &B);
  void vprolvd(const Zmm &To, const Zmm &A, const Operand &B);
  void vplzcntd(const Zmm &To, const Zmm &A);
  void vpopcntd(const Zmm &To, const Zmm &A);
  /// All ones for each byte that is not 0. May overwrite k2.
  void markBytes(const Zmm &To, const Zmm &A);
  /// Rounded towards zero; all ones where \p B is 0. No two vectors are the
  /// same, except perhaps \p A and \p B. May overwrite k2.
  void quotient(const Zmm &To, const Zmm &A, const Zmm &B, bool AreSigned,
                const Zmm &Spare, const Zmm &OtherSpare);
  /// @}

  /// \name Masks
  /// @{
  void vpcmpeqd(const Opmask &To, const Zmm &A, const Operand &B);
  void vpcmpd(const Opmask &To, const Zmm &A, const Operand &B, Relation Of);
  void vpcmpud(const Opmask &To, const Zmm &A, const Operand &B, Relation Of);
  void vptestmd(const Opmask &To, const Zmm &A, const Operand &B);
  void vptestnmd(const Opmask &To, const Zmm &A, const Operand &B);
  void vpmovd2m(const Opmask &To, const Zmm &From);
  void vpmovm2d(const Zmm &To, const Opmask &From);
  void kmovw(const Reg32 &To, const Opmask &From);
  void kmovw(const Opmask &To, const Reg32 &From);
  /// All lanes.
  void setAll(const Opmask &To);
  void copy(const Opmask &To, const Opmask &From);
  /// Sets the host's zero flag if neither has a lane.
  void kortestw(const Opmask &A, const Opmask &B);
  /// A bit for each active lane whose word is odd, or even. May overwrite ecx
  /// and k2.
  void oddLanes(const Reg32 &To, const Zmm &A, bool AreEven, bool AreAllActive);
  /// With AVX2: a bit for each active lane where \p Of holds. Overwrites ecx.
  void lanesWhere(const Reg32 &To, const Zmm &A, const Operand &B, Relation Of,
                  bool AreSigned, bool AreAllActive);
  /// Goes to \p To if active lanes of \p A and \p B differ. May overwrite k2.
  void jumpIfDiffer(const Zmm &A, const Zmm &B, bool AreAllActive,
                    Xbyak::Label &To);
  /// @}

  /// \name Floats, rounded to nearest
  /// @{
  void vaddps(const Zmm &To, const Zmm &A, const Zmm &B);
  void vsubps(const Zmm &To, const Zmm &A, const Zmm &B);
  void vmulps(const Zmm &To, const Zmm &A, const Zmm &B);
  void vdivps(const Zmm &To, const Zmm &A, const Zmm &B);
  void vsqrtps(const Zmm &To, const Zmm &A);
  void vfmadd231ps(const Zmm &To, const Zmm &A, const Zmm &B);
  void vfmsub231ps(const Zmm &To, const Zmm &A, const Zmm &B);
  void vfnmadd231ps(const Zmm &To, const Zmm &A, const Zmm &B);
  void vfnmsub231ps(const Zmm &To, const Zmm &A, const Zmm &B);
  void vcmpps(const Opmask &To, const Zmm &A, const Zmm &B, uint8_t Of);
  /// The lesser or the greater, with its own sign; of numbers.
  void least(const Zmm &To, const Zmm &A, const Zmm &B);
  void greatest(const Zmm &To, const Zmm &A, const Zmm &B);
  /// Goes to \p To if active lanes of \p A or \p B are NaNs. May overwrite k2.
  void jumpIfNan(const Zmm &A, const Zmm &B, bool AreAllActive,
                 Xbyak::Label &To);
  /// Rounded by \p Mode, any but ties away from zero. Goes to \p Wrong if lanes
  /// of it do not fit, with flags that these lanes raise. Lanes that are not
  /// active become anything. May overwrite k2.
  void toInt(const Zmm &To, const Zmm &A, uint32_t Mode, bool IsSigned,
             const Zmm &Spare, Xbyak::Label &Wrong);
  /// Rounded by \p Mode: to nearest, or with AVX-512 any but ties away from
  /// zero.
  void fromInt(const Zmm &To, const Zmm &A, uint32_t Mode, bool IsSigned,
               const Zmm &Spare);
  /// @}

private:
  // Narrow.h: with AVX2.
  template <typename F>
  void withHalf(const Operand &A, int Half, const Ymm &Spare, F Use);
  template <typename F> void withMask(int Mask, int Half, F Use);
  template <typename F> void write(const Zmm &To, F Compute);
  template <typename F>
  void write(const Opmask &To, bool IsInverted, F Compute);
  Ymm inYmm(const Operand &A, int Half, const Ymm &Spare);
  Ymm maskInYmm(int Mask, int Half);
  void loadOld(const Zmm &To, int Half, const Ymm &D);
  void forActiveLanes(const Zmm &Values, const Zmm *Offsets, int Bytes,
                      bool AreAllActive,
                      const std::function<void(const Xbyak::RegExp &)> &Store);
  std::function<void(const Xbyak::RegExp &)> narrowStore(int Bytes);
  void compareHalf(const Ymm &D, int Half, const Zmm &A, const Operand &B,
                   Relation Of, bool AreSigned);
  void compare(const Opmask &To, const Zmm &A, const Operand &B, Relation Of,
               bool AreSigned);
  template <typename F>
  void signs(const Reg32 &To, bool IsInverted, bool AreAllActive, F Compute);
  void testBits(const Opmask &To, const Zmm &A, const Operand &B, bool AreZero);

  template <typename F>
  void ofTwo(const Zmm &To, const Zmm &A, const Operand &B, F Insn);
  template <typename F> void ofOne(const Zmm &To, const Zmm &A, F Insn);
  void countBits(const Ymm &D, int Half);
  void wideQuotient(const Zmm &To, const Zmm &A, const Zmm &B, bool AreSigned,
                    const Zmm &Divisor, const Zmm &High);
  void loadActive(int Half);
  void activeHalf(const Ymm &To, const Operand &A, int Half, uint32_t Idle);
  Ymm inputHalf(const Operand &To, const Zmm &A, int Half, const Ymm &Spare);
  template <typename F>
  void rounded(const Zmm &To, const Zmm &A, const Zmm &B, uint32_t Idle,
               F Insn);
  template <typename F>
  void ofThree(const Zmm &To, const Zmm &A, const Zmm &B, F Insn);
  void leastOrGreatest(const Zmm &To, const Zmm &A, const Zmm &B, bool IsLeast);
  void jumpIfAnyIs(const Zmm &A, uint32_t Bits, Xbyak::Label &To);
  void wideToInt(const Zmm &To, const Zmm &A, uint32_t Mode, bool IsSigned,
                 const Zmm &Spare, Xbyak::Label &Wrong);
  void narrowToInt(const Ymm &D, uint32_t Mode);

  VectorUnit Unit;
  std::map<uint32_t, Xbyak::Label> Numbers;
  std::map<LaneConstants, Xbyak::Label> Vectors;
};

} // namespace vorion::isasim::translate
