/// Values of 16 lanes in the code that is written, so that the definitions of
/// core/insns/ write the code that computes them. An operation is held back
/// until it is known where its result goes.
#pragma once

#include "translate/Emitter.h"

namespace vorion::isasim::translate {

enum class Do : uint8_t {
  Move,
  Add,
  Sub,
  Mul,
  And,
  AndNot, ///< ~X & Y
  Or,
  Xor,
  ShiftLeft,
  ShiftRight,
  ShiftRightSigned,
  RotateLeft,
  One,   ///< 1 where the test of X and Y holds
  Keep,  ///< Then where it holds, else 0
  Choose ///< Then where it holds, else Else
};

struct Test {
  Emitter *E = nullptr;
  Relation Of = Relation::Equal;
  bool IsSigned = false;
  Term X, Y;
  /// Writes the active lanes where it holds.
  void into(const Xbyak::Opmask &K) const;
  /// The same, a bit a lane, with AVX2 (HostVectors::lanesWhere()).
  void into(const Xbyak::Reg32 &Bits) const;
};

struct Value {
  Emitter *E = nullptr;
  Do What = Do::Move;
  Term X, Y;
  Test If = {};
  Term Then, Else;

  Value() = default;
  Value(Emitter *EIn, Term Of) : E(EIn), X(Of) {}
  Value(uint32_t Bits) { X.Bits = Bits; }
  Value(Emitter *EIn, Do WhatIn, Term XIn, Term YIn)
      : E(EIn), What(WhatIn), X(XIn), Y(YIn) {}

  bool isNumber() const { return What == Do::Move && X.isNumber(); }
  /// Where it is once it has been computed.
  Term settle() const;
  /// Computes it into \p To, which may have a mask.
  void into(const Xbyak::Zmm &To) const;
};

/// The same bits with a sign.
struct Signed {
  Value Of;
};
/// All ones where a test holds.
struct Mask {
  Test Of;
};

/// \name The words of core/insns/*.def
/// @{
Value operator+(const Value &A, const Value &B);
Value operator-(const Value &A, const Value &B);
Value operator*(const Value &A, const Value &B);
Value operator&(const Value &A, const Value &B);
Value operator|(const Value &A, const Value &B);
Value operator^(const Value &A, const Value &B);
Value operator<<(const Value &A, const Value &B);
Value operator>>(const Value &A, const Value &B);
Value operator~(const Value &A);
Value operator-(const Value &A);
Value operator&(const Value &A, const Mask &B);
Test operator==(const Value &A, const Value &B);
Test operator!=(const Value &A, const Value &B);
Test operator<(const Value &A, const Value &B);
Test operator>=(const Value &A, const Value &B);
Signed operator>>(const Signed &A, const Signed &B);
Signed operator>>(const Signed &A, unsigned B);
Test operator<(const Signed &A, const Signed &B);
Test operator>=(const Signed &A, const Signed &B);
inline Signed asI(const Value &A) { return {A}; }
inline Value asU(const Signed &A) { return A.Of; }
inline Mask asU(const Test &A) { return {A}; }
Value one(const Test &A);
Value select(const Mask &If, const Value &Then, const Value &Else);
Value shiftLeft(const Value &A, const Value &B);
Value bit(const Value &B);
Value rotateLeft(const Value &A, const Value &B);
Value mulHigh(const Value &A, const Value &B);
Value mulHighSU(const Value &A, const Value &B);
Value mulHighU(const Value &A, const Value &B);
Value divS(const Value &A, const Value &B);
Value divU(const Value &A, const Value &B);
Value remS(const Value &A, const Value &B);
Value remU(const Value &A, const Value &B);
Value countLeading(const Value &A);
Value countTrailing(const Value &A);
Value popCount(const Value &A);
Value orBytes(const Value &A);
Value swapBytes(const Value &A);
Value classify(const Value &A);
/// @}

} // namespace vorion::isasim::translate
