// The lanes' own stacks. They are interleaved on the host
// (MemoryView::stackOffset), so the same place of all 16 is a line there. Where
// the stack pointers of all lanes name such a place, active or not, r12 has its
// line until the stack pointer is written. All lines of these stacks are the
// core's own, so what they have of lanes that are not active may be written
// again.
//
// Words at the stack pointer are as far away from r12 as the immediates say.
// Without r12 each access looks for the line of the active lanes. Other
// accesses, as those of arrays, go by the distance of their addresses from the
// stack pointer: a line where all active lanes have the same distance, else a
// word of each lane.

#include "translate/Places.h"
#include "translate/Value.h"

#include <algorithm>

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

namespace {

constexpr int32_t WordBytes = 4, LineBytes = WordBytes * StackGroup;

/// From the line of the stack pointer to that of \p Imm: stacks grow downwards,
/// and so do the lines.
int32_t distanceOf(int32_t Imm) { return -Imm / WordBytes * LineBytes; }

} // namespace

bool Emitter::isOnStack(const GuestInsn &G) const {
  switch (G.Opcode) {
  case Op::RV_LW:
  case Op::RV_FLW:
  case Op::RV_SW:
  case Op::RV_FSW:
    return G.I->Rs1 == StackPointer && G.I->Imm % WordBytes == 0;
  default:
    return false;
  }
}

void Emitter::findStackUses() {
  for (const GuestInsn &G : Region) {
    KeepsStackLine |= (G.Is == Kind::Load || G.Is == Kind::Store) &&
                      (G.IsInStacks || G.I->Rs1 == StackPointer);
    if (isOnStack(G)) {
      LeastOnStack = std::min(LeastOnStack, G.I->Imm);
      GreatestOnStack = std::max(GreatestOnStack, G.I->Imm);
    }
  }
  // Others that write the stack pointer may go elsewhere from there.
  for (const GuestInsn &G : Region)
    if (G.I->Rd == StackPointer && G.Is != Kind::Integer &&
        G.Is != Kind::Load && G.Is != Kind::Other)
      KeepsStackLine = false;
}

void Emitter::followStackPointer(const GuestInsn &G) {
  if (!KeepsStackLine || G.I->Rd != StackPointer || G.Is == Kind::Other)
    return;
  call(FindOwnStack);
  Held.forget();
}

/// With the line at r12, if there is one; else at rcx.
void Emitter::atStackLine(const GuestInsn &G, Label &Wrong,
                          const std::function<void(const RegExp &)> &Access) {
  if (!KeepsStackLine) {
    locateOnStack(addressesOf(G.I), Wrong);
    return Access(rcx);
  }
  Label Lost, Done;
  const HeldVectors Before = Held;
  test(r12, r12);
  jz(Lost);
  Access(r12 + distanceOf(G.I->Imm));
  L(Done);
  outOfLine([=, this, &G, &Wrong, Was = Held]() mutable {
    L(Lost);
    Held = Before;
    Held.forgetOthers();
    locateOnStack(addressesOf(G.I), Wrong);
    Access(rcx);
    holdAgain(Was);
    jmp(Done);
  });
}

void Emitter::loadFromStack(const GuestInsn &G, Label &Wrong) {
  atStackLine(G, Wrong, [this, Rd = G.I->Rd](const RegExp &Line) {
    result(Rd, [&](const Zmm &To) { vmovdqu32(To, ptr[Line]); });
  });
}

void Emitter::storeToStack(const GuestInsn &G, Label &Wrong) {
  const Zmm Values = inZmm(guest(G.I->Rs2));
  const Zmm Line = scratch();
  atStackLine(G, Wrong, [=, this](const RegExp &At) {
    if (isFull())
      return vmovdqu32(ptr[At], Values);
    if (At.getBase().getIdx() != r12.getIdx())
      return vmovdqu32(ptr[At] | k1, Values);
    // Not with a mask, for the reason that result() has.
    vmovdqu32(Line, ptr[At]);
    vmovdqa32(Line | k1, Values);
    vmovdqu32(ptr[At], Line);
  });
}

/// rcx becomes the line that \p Bytes bytes at \p Addresses of active lanes lie
/// in, and edx their first bit in its words. Goes to \p Apart with \p Distances
/// from the stack pointer if these differ, and to \p Elsewhere if this is not
/// the lanes' own stacks. Overwrites \p Spread.
void Emitter::locateOwnLine(const Zmm &Addresses, int Bytes,
                            const Zmm &Distances, const Zmm &Spread,
                            Label &Apart, Label &Elsewhere) {
  test(r12, r12);
  jz(Elsewhere);
  if (const int Pointer = zmmOf(StackPointer); Pointer >= 0)
    vpsubd(Distances, Addresses, Zmm(Pointer));
  else
    vpsubd(Distances, Addresses, ptr[rdi + StackPointer]);
  jumpIfApart(Distances, Spread, Apart);
  if (Bytes > 1) {
    test(al, Bytes - 1);
    jnz(Elsewhere);
  }
  mov(edx, dword[rdi + VORION_PLACE(StackPointerDepth)]);
  sub(edx, eax);
  cmp(edx, dword[rdi + VORION_PLACE(StackBytes)]);
  jae(Elsewhere);
  // The stack pointer is a multiple of words.
  movsxd(rcx, eax);
  if (Bytes < WordBytes) {
    mov(edx, eax);
    and_(edx, WordBytes - 1);
    shl(edx, 3);
    and_(rcx, -WordBytes);
  }
  shl(rcx, 4);
  static_assert(LineBytes == WordBytes << 4);
  neg(rcx);
  add(rcx, r12);
}

/// For active lanes at different \p Distances: \p Offsets of their words from
/// rcx, for gather() and scatter(). \p Distances become the bytes from the top
/// of each stack.
void Emitter::locateOwnWords(int Bytes, const Zmm &Distances,
                             const Zmm &Offsets, Label &Elsewhere) {
  mov(edx, dword[rdi + VORION_PLACE(StackPointerDepth)]);
  vpbroadcastd(Offsets, edx);
  vpsubd(Distances, Offsets, Distances);
  vpcmpud(active(k2), Distances, ptr_b[rdi + VORION_PLACE(StackBytes)],
          Relation::NotLess);
  if (Bytes > 1) {
    vpandnd(Offsets, Distances, constant(static_cast<uint32_t>(Bytes - 1)));
    vptestmd(active(k3), Offsets, Offsets);
    kortestw(k2, k3);
  } else {
    kortestw(k2, k2);
  }
  jnz(Elsewhere);
  vpsrld(Offsets, Distances, 2);
  vpslld(Offsets, Offsets, 6);
  static_assert(LineBytes == 1 << 6);
  vpaddd(Offsets, Offsets, laneNumbers(WordBytes));
  // From the line at the top.
  shr(edx, 2);
  shl(rdx, 6);
  mov(rcx, r12);
  sub(rcx, rdx);
  isFull() ? setAll(k2) : copy(k2, k1);
}

/// \p Shifts become the bit offsets, in their words, of bytes that are \p
/// Depths from the tops of their stacks.
void Emitter::firstBits(const Zmm &Shifts, const Zmm &Depths) {
  vpandnd(Shifts, Depths, constant(WordBytes - 1));
  vpslld(Shifts, Shifts, 3);
}

/// A load of the lanes' own stacks, or on at \p Elsewhere. Overwrites \p
/// Distances and \p Spread.
void Emitter::loadFromOwnStacks(const GuestInsn &G, const Zmm &Addresses,
                                int Bytes, bool IsSigned, const Zmm &Distances,
                                const Zmm &Spread, Label &Elsewhere) {
  const Zmm Words = Bytes < WordBytes ? scratch() : Spread;
  const int Taken = Scratches;
  const auto Extend = [=, this] {
    const auto Shift = static_cast<uint8_t>(32 - 8 * Bytes);
    vpsrlvd(Words, Words, Distances);
    vpslld(Words, Words, Shift);
    IsSigned ? vpsrad(Words, Words, Shift) : vpsrld(Words, Words, Shift);
    result(G.I->Rd, [&](const Zmm &To) { vmovdqa32(To, Words); });
  };
  Label Apart, Done;
  locateOwnLine(Addresses, Bytes, Distances, Spread, Apart, Elsewhere);
  if (Bytes == WordBytes) {
    result(G.I->Rd, [&](const Zmm &To) { vmovdqu32(To, ptr[rcx]); });
  } else {
    vmovdqu32(Words, ptr[rcx]);
    vpbroadcastd(Distances, edx);
    Extend();
  }
  L(Done);
  outOfLine([=, this]() mutable {
    Scratches = Taken;
    L(Apart);
    locateOwnWords(Bytes, Distances, Spread, Elsewhere);
    if (Bytes == WordBytes) {
      result(G.I->Rd, [&](const Zmm &To) { gather(Zmm(To.getIdx()), Spread); });
    } else {
      gather(Words, Spread);
      firstBits(Distances, Distances);
      Extend();
    }
    jmp(Done);
  });
}

/// The same for a store.
void Emitter::storeToOwnStacks(const Zmm &Addresses, int Bytes,
                               const Zmm &Values, const Zmm &Distances,
                               const Zmm &Spread, Label &Elsewhere) {
  const Zmm Bits = Bytes < WordBytes ? scratch() : Spread;
  // Inserts the low bytes of Values into Words of active lanes, from the bits
  // Distances on.
  const auto Insert = [=, this](const Zmm &Words) {
    vpbroadcastd(Bits, number((1U << 8 * Bytes) - 1));
    vpsllvd(Bits, Bits, Distances);
    vpsllvd(Distances, Values, Distances);
    vpxord(Distances, Distances, Words);
    vpandd(Distances, Distances, Bits);
    vpxord(active(Words), Words, Distances);
  };
  Label Apart, Done;
  locateOwnLine(Addresses, Bytes, Distances, Spread, Apart, Elsewhere);
  if (Bytes < WordBytes) {
    vmovdqu32(Spread, ptr[rcx]);
    vpbroadcastd(Distances, edx);
    Insert(Spread);
    vmovdqu32(ptr[rcx], Spread);
  } else if (isFull()) {
    vmovdqu32(ptr[rcx], Values);
  } else {
    // Not with a mask, for the reason that result() has.
    vmovdqu32(Spread, ptr[rcx]);
    vmovdqa32(Spread | k1, Values);
    vmovdqu32(ptr[rcx], Spread);
  }
  L(Done);
  outOfLine([=, this]() mutable {
    L(Apart);
    locateOwnWords(Bytes, Distances, Spread, Elsewhere);
    if (Bytes < WordBytes) {
      const Zmm Words(SpareZmm);
      gather(Words, Spread);
      isFull() ? setAll(k2) : copy(k2, k1);
      firstBits(Distances, Distances);
      Insert(Words);
      scatter(Spread, Words, isFull());
    } else {
      scatter(Spread, Values, isFull());
    }
    jmp(Done);
  });
}

/// rcx becomes where lane 0's word lies if \p Addresses are the same place of
/// all lanes' stacks.
void Emitter::locateOnStack(const Zmm &Addresses, Label &Wrong) {
  const Zmm Back = scratch(), Spread = scratch();
  mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
  vmovd(Xmm(Spread.getIdx()), dword[rsi + InShift]);
  vmovdqa32(Back, laneNumbers(1));
  vpslld(Back, Back, Xmm(Spread.getIdx()));
  vpaddd(Back, Back, Addresses);
  jumpIfApart(Back, Spread, Wrong);
  call(FindStackLine);
  test(rcx, rcx);
  jz(Wrong);
}

/// Goes to \p Others unless eax is the number of lane 0's own stack, or stacks
/// are the program's affair.
void Emitter::jumpUnlessOwn(Label &Others) {
  Label Own;
  cmp(eax, dword[rdi + VORION_PLACE(FirstStack)]);
  je(Own);
  cmp(dword[rdi + VORION_PLACE(FirstStack)], WarpState::NoOwnStack);
  jne(Others);
  L(Own);
}

/// Functions of a mode.
void Emitter::writeStackFinders() {
  // rcx becomes where the word at eax of lane 0's stack lies, if those of the
  // other lanes are its neighbours there (MemoryView::stackOffset), or 0.
  Label Fails;
  L(FindStackLine);
  mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
  test(al, WordBytes - 1);
  jnz(Fails);
  mov(ecx, dword[rsi + InShift]);
  bsr(edx, dword[rdi + VORION_PLACE(Mask)]);
  shl(edx, cl);
  mov(r11d, eax);
  sub(r11d, edx);
  sub(r11d, dword[rsi + InStack + RegionLo]);
  mov(edx, dword[rsi + InStack + RegionBytes]);
  sub(edx, WordBytes);
  cmp(r11d, edx);
  ja(Fails);
  mov(edx, dword[rsi + InStack + RegionLo]);
  add(edx, dword[rsi + InStack + RegionBytes]);
  dec(edx);
  sub(edx, eax); // bytes from the top
  cmp(edx, dword[rsi + InStack + RegionBytes]);
  jae(Fails);
  mov(eax, edx);
  shr(eax, cl); // lane 0's hart
  test(eax, StackGroup - 1);
  jnz(Fails);
  jumpUnlessOwn(Fails);
  mov(r11d, ~0U);
  shl(r11d, cl);
  and_(r11d, edx); // of the stacks in front
  sub(edx, r11d);
  shr(edx, 2);
  imul(edx, edx, LineBytes);
  lea(rcx, ptr[r11 + rdx]);
  add(rcx, ptr[rsi + InStack + RegionHost]);
  ret();
  L(Fails);
  xor_(ecx, ecx);
  ret();
  if (KeepsStackLine)
    writeOwnStackFinder();
}

/// Sets r12. The mode and the active lanes do not matter.
void Emitter::writeOwnStackFinder() {
  Label None;
  L(FindOwnStack);
  xor_(r12d, r12d);
  // Cores of fewer lanes share lines.
  cmp(dword[rdi + VORION_PLACE(AllLanes)], AllBits);
  jne(None);
  mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
  const int Kept = zmmOf(StackPointer);
  const Zmm Pointers = Kept < 0 ? zmm0 : Zmm(Kept);
  if (Kept < 0)
    vmovdqa32(Pointers, ptr[rdi + StackPointer]);
  vmovd(xmm1, dword[rsi + InShift]);
  vmovdqa32(zmm2, laneNumbers(1));
  vpslld(zmm2, zmm2, xmm1);
  vpaddd(zmm2, zmm2, Pointers);
  vpbroadcastd(zmm1, xmm2);
  jumpIfDiffer(zmm2, zmm1, true, None);
  vmovd(eax, xmm2);
  test(al, WordBytes - 1);
  jnz(None);
  mov(edx, dword[rsi + InStack + RegionLo]);
  add(edx, dword[rsi + InStack + RegionBytes]);
  dec(edx);
  sub(edx, eax); // bytes from the top
  mov(ecx, dword[rsi + InShift]);
  mov(r11d, MaxLanes - 1);
  shl(r11d, cl);
  add(r11, rdx); // of the last lane
  mov(eax, dword[rsi + InStack + RegionBytes]);
  cmp(r11, rax);
  jae(None);
  mov(eax, edx);
  shr(eax, cl); // lane 0's hart
  test(eax, StackGroup - 1);
  jnz(None);
  jumpUnlessOwn(None);
  mov(r11d, ~0U);
  shl(r11d, cl);
  and_(r11d, edx); // of the stacks in front
  sub(edx, r11d);
  // All immediates stay in the stack.
  cmp(edx, GreatestOnStack);
  jb(None);
  mov(eax, edx);
  sub(eax, LeastOnStack);
  shr(eax, cl);
  jnz(None);
  mov(dword[rdi + VORION_PLACE(StackPointerDepth)], edx);
  mov(eax, 1);
  shl(eax, cl);
  mov(dword[rdi + VORION_PLACE(StackBytes)], eax);
  shr(edx, 2);
  imul(edx, edx, LineBytes);
  lea(r12, ptr[r11 + rdx]);
  add(r12, ptr[rsi + InStack + RegionHost]);
  L(None);
  ret();
}

} // namespace vorion::isasim::translate
