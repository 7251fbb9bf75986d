// Atomics that need not wait for other cores, lane by lane, as core/Atomics.cpp
// has them: those in local memory, and additions without a result in global
// memory. All others are the interpreter's.

#include "translate/AtomicWord.h"
#include "translate/Places.h"
#include "translate/Value.h"

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

namespace {

// What a function of writeAtomic() takes, and where it leaves the results.
const Zmm Addresses = zmm0, Operands = zmm1;
constexpr int NumFunctionZmms = 4; // with two of its own

} // namespace

/// The vectors of writeAtomic(), before anything else has them.
void Emitter::takeForFunction() {
  for (int N = 0; N != NumFunctionZmms; ++N)
    if (isWide())
      scratch();
    else
      Held.use(N);
}

void Emitter::atomic(const GuestInsn &G) {
  const Insn *I = G.I;
  takeForFunction();
  const auto Move = [this](const Zmm &To, Term From) {
    if (From.isNumber())
      vpxord(To, To, To); // x0
    else
      vmovdqa32(To, Zmm(From.Zmm));
  };
  Move(Addresses, guest(I->Rs1));
  Move(Operands, guest(I->Rs2));
  call(Atomics[{atomicOf(G.Opcode), !isSink(I->Rd)}]);
  test(rcx, rcx);
  jz(toInterpreter());
  inc(qword[rdi + VORION_PLACE(Count.Atomics)]);
  if (!isSink(I->Rd))
    result(I->Rd, [this](const Zmm &To) { vmovdqa32(To, Operands); });
}

void Emitter::writeAtomics() {
  for (auto &[Of, Begin] : Atomics)
    writeAtomic(Of.first, Of.second, Begin);
  Atomics.clear();
}

/// Goes to \p Elsewhere unless all active lanes have aligned addresses in the
/// region that lies \p In the memory view rsi. Else rcx becomes where it lies
/// on the host, and \p Offsets the lanes' places in it.
void Emitter::locateWords(int In, const Zmm &Offsets, const Zmm &Spare,
                          Label &Elsewhere) {
  constexpr int Bytes = 4;
  vpsubd(Offsets, Addresses, ptr_b[rsi + In + RegionLo]);
  mov(eax, dword[rsi + In + RegionBytes]);
  sub(eax, Bytes);
  vpbroadcastd(Spare, eax);
  vpcmpud(active(k2), Offsets, Spare, Relation::Greater);
  vptestmd(active(k3), Addresses, constant(Bytes - 1));
  kortestw(k2, k3);
  jnz(Elsewhere);
  mov(rcx, ptr[rsi + In + RegionHost]);
}

/// Lets \p Update do the operation of one active lane after the other, whose
/// word lies at rcx + rdx, and then returns. It may overwrite eax and r11d,
/// which is the operand and may become the result. \p Offsets are the lanes'
/// places.
void Emitter::forLanes(const Zmm &Offsets, bool HasResult,
                       const std::function<void(const Address &)> &Update) {
  constexpr int Bytes = 4, OperandsAt = sizeof(LaneWords);
  sub(rsp, 2 * OperandsAt);
  vmovdqu32(ptr[rsp], Offsets);
  vmovdqu32(ptr[rsp + OperandsAt], Operands);
  const auto DoLane = [&](const RegExp &Lane) {
    const Address Operand = dword[Lane + OperandsAt];
    mov(edx, dword[Lane]);
    mov(r11d, Operand);
    Update(Operand);
  };
  if (isFull())
    for (int L = 0; L != MaxLanes; ++L)
      DoLane(rsp + L * Bytes);
  else {
    Label Next;
    push(r12);
    push(r13);
    constexpr int Pushed = 16;
    kmovw(r12d, k1);
    L(Next);
    tzcnt(r13d, r12d);
    DoLane(rsp + r13 * Bytes + Pushed);
    blsr(r12d, r12d);
    jnz(Next);
    pop(r13);
    pop(r12);
  }
  if (HasResult)
    vmovdqu32(Operands, ptr[rsp + OperandsAt]);
  add(rsp, 2 * OperandsAt);
  add(qword[rdi + VORION_PLACE(Count.Changes)], rsi);
  ret();
}

/// A function: rcx becomes 0, and nothing has been done, unless the atomic need
/// not wait for other cores. Else the old words become Operands if
/// \p HasResult.
void Emitter::writeAtomic(Amo Kind, bool HasResult, Label &Begin) {
  const Zmm Offsets = zmm2, Spare = zmm3;
  // rsi counts the words that change.
  const auto CountChanges = [&] {
    if (Kind == Amo::Add) {
      vptestmd(active(k2), Operands, Operands);
      kmovw(esi, k2);
      popcnt(esi, esi);
    } else
      xor_(esi, esi);
  };
  Label NotLocal, Wrong;
  L(Begin);
  mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
  locateWords(InLocal, Offsets, Spare, NotLocal);
  CountChanges();
  forLanes(Offsets, HasResult, [&](const Address &Operand) {
    const Address Word = dword[rcx + rdx];
    if (Kind == Amo::Add && !HasResult)
      return add(Word, r11d);
    mov(eax, Word);
    if (HasResult)
      mov(Operand, eax);
    applyAtomic(*this, Kind, r11d, eax);
    mov(Word, r11d);
    if (Kind == Amo::Add)
      return;
    xor_(eax, r11d);
    neg(eax);
    adc(rsi, 0);
  });
  L(NotLocal);
  // Additions commute (amoOrPark()).
  if (Kind == Amo::Add && !HasResult) {
    Label NotGlobal, Add;
    locateWords(InGlobal, Offsets, Spare, NotGlobal);
    L(Add);
    CountChanges();
    forLanes(Offsets, HasResult, [&](const Address &) {
      lock();
      add(dword[rcx + rdx], r11d);
    });
    L(NotGlobal);
    locateWords(InHigh, Offsets, Spare, Wrong);
    jmp(Add);
  }
  L(Wrong);
  xor_(ecx, ecx);
  ret();
}

} // namespace vorion::isasim::translate
