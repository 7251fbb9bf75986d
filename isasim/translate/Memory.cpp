// Loads and stores. Neighbouring lanes at neighbouring places, all lanes at one
// place (loads alone), lanes anywhere in one region, and the lanes' own stacks,
// in this order, unless Guess.cpp says which is likely; Stack.cpp has those of
// stacks. The rest, and all that is wrong, is the
// interpreter's.

#include "translate/Places.h"
#include "translate/Value.h"

#include <bit>

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

/// The first active lane's word of \p From in every lane of \p To, and in eax.
void Emitter::spreadFirst(const Zmm &To, const Zmm &From) {
  if (!isFull() && !isWide()) {
    tzcnt(eax, dword[rdi + VORION_PLACE(Mask)]);
    return spreadLane(To, From, eax);
  }
  if (isFull())
    vpbroadcastd(To, Xmm(From.getIdx()));
  else
    vpermd(To, Zmm(FirstLaneZmm), From);
  vmovd(eax, Xmm(To.getIdx()));
}

/// The same where \p From has the addresses of \p I less the lanes' numbers
/// times \p Bytes. With AVX2, where some lanes are active, the word comes from
/// where the base register lies, which takes less time than from \p From.
/// Overwrites rdx there.
void Emitter::spreadFirstAddress(const Insn *I, int Bytes, const Zmm &To,
                                 const Zmm &From) {
  if (isFull() || isWide())
    return spreadFirst(To, From);
  tzcnt(edx, dword[rdi + VORION_PLACE(Mask)]);
  mov(eax, dword[rdi + rdx * 4 + I->Rs1]);
  if (I->Imm != 0)
    add(eax, I->Imm);
  if (Bytes > 1)
    shl(edx, std::countr_zero(static_cast<unsigned>(Bytes)));
  if (Bytes != 0)
    sub(eax, edx);
  vpbroadcastd(To, eax);
}

/// Goes to \p Apart if active lanes of \p All have another word than the first
/// one, which \p Spread and eax have afterwards.
void Emitter::jumpIfApart(const Zmm &All, const Zmm &Spread, Label &Apart) {
  spreadFirst(Spread, All);
  jumpIfDiffer(All, Spread, isFull(), Apart);
}

/// rcx becomes where \p Count elements of \p Size bytes from guest address eax
/// on lie.
void Emitter::locate(int Size, unsigned Count, bool IsStore, Label &Wrong) {
  const int Bytes = Size * static_cast<int>(Count);
  Label Elsewhere, Found;
  if (Size > 1) {
    test(al, Size - 1);
    jnz(Wrong);
  }
  mov(ecx, eax);
  sub(ecx, r13d);
  cmp(ecx, r14d);
  ja(Elsewhere);
  add(rcx, r15);
  L(Found);
  outOfLine([=, this, &Wrong]() mutable {
    Label NotLocal;
    L(Elsewhere);
    mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
    mov(ecx, eax);
    sub(ecx, dword[rsi + InLocal + RegionLo]);
    mov(edx, dword[rsi + InLocal + RegionBytes]);
    sub(edx, Bytes);
    cmp(ecx, edx);
    ja(NotLocal);
    add(rcx, ptr[rsi + InLocal + RegionHost]);
    jmp(Found);
    L(NotLocal);
    mov(edx, Bytes);
    call(IsStore ? FindWritable : FindReadable);
    test(rcx, rcx);
    jz(Wrong);
    sub(eax, dword[rcx + RegionLo]);
    mov(rcx, ptr[rcx + RegionHost]);
    add(rcx, rax);
    jmp(Found);
  });
}

/// The same for elements of \p Bytes bytes at the \p Addresses of \p I, if
/// these are neighbours; else goes to \p Apart. Overwrites \p Bases and \p
/// Spread.
void Emitter::locateNeighbours(const Insn *I, const Zmm &Addresses, int Bytes,
                               bool IsStore, const Zmm &Bases,
                               const Zmm &Spread, Label &Apart, Label &Wrong) {
  vpsubd(Bases, Addresses, laneNumbers(static_cast<uint32_t>(Bytes)));
  spreadFirstAddress(I, Bytes, Spread, Bases);
  jumpIfDiffer(Bases, Spread, isFull(), Apart);
  locate(Bytes, MaxLanes, IsStore, Wrong);
}

/// Functions of a mode. rcx becomes the Region that holds edx bytes at eax, or
/// 0: any but the stacks; for stores not the image, which is writable in parts.
void Emitter::writeFinders() {
  for (const bool IsStore : {false, true}) {
    Label Found;
    L(IsStore ? FindWritable : FindReadable);
    mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
    constexpr int Next = sizeof(isasim::Region);
    const std::vector<int> Where =
        IsStore ? std::vector{InGlobal, InLocal, InHigh, InRest, InRest + Next}
                : std::vector{InGlobal, InLocal, InHigh,
                              InImage,  InWhole, InWhole + Next};
    for (const int In : Where) {
      lea(rcx, ptr[rsi + In]);
      mov(r11d, eax);
      sub(r11d, dword[rcx + RegionLo]);
      push(rax);
      mov(eax, dword[rcx + RegionBytes]);
      sub(eax, edx);
      cmp(r11d, eax);
      pop(rax);
      jbe(Found);
    }
    xor_(ecx, ecx);
    L(Found);
    ret();
  }
}

/// For active lanes at aligned \p Addresses of \p I in one region: \p Offsets
/// from rcx. \p Wrong is one of Lasting.
void Emitter::locateEach(const Insn *I, const Zmm &Addresses, int Bytes,
                         bool IsStore, const Zmm &Offsets, Label &Wrong) {
  Label Found, NotGlobal;
  // Of aligned places in a region of whole words. k2 has those elsewhere.
  const auto Try = [=, this](const RegExp &In) {
    vpsubd(Offsets, Addresses, ptr_b[In + RegionLo]);
    vpcmpud(active(k2), Offsets, ptr_b[In + RegionBytes], Relation::NotLess);
    if (Bytes > 1)
      kortestw(k2, k3);
    else
      kortestw(k2, k2);
  };
  if (Bytes > 1)
    vptestmd(active(k3), Addresses, constant(static_cast<uint32_t>(Bytes - 1)));
  mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
  Try(rsi + InGlobal);
  jnz(NotGlobal);
  mov(rcx, r15);
  L(Found);
  isFull() ? setAll(k2) : copy(k2, k1);
  outOfLine([=, this, &Wrong]() mutable {
    Label NotLocal;
    L(NotGlobal);
    Try(rsi + InLocal);
    jnz(NotLocal);
    mov(rcx, ptr[rsi + InLocal + RegionHost]);
    jmp(Found);
    L(NotLocal);
    spreadFirstAddress(I, 0, Offsets, Addresses);
    mov(edx, Bytes);
    call(IsStore ? FindWritable : FindReadable);
    test(rcx, rcx);
    jz(Wrong);
    Try(rcx);
    jnz(Wrong);
    mov(rcx, ptr[rcx + RegionHost]);
    jmp(Found);
  });
}

Zmm Emitter::addressesOf(const Insn *I) {
  const Zmm Base = inZmm(guest(I->Rs1));
  if (I->Imm == 0)
    return Base;
  const Zmm To = scratch();
  vpaddd(To, Base, constant(static_cast<uint32_t>(I->Imm)));
  return To;
}

void Emitter::load(const GuestInsn &G) {
  const Insn *I = G.I;
  const int Bytes = elementOf(G.Opcode).Bytes;
  const bool IsSigned = elementOf(G.Opcode).IsSigned;
  Label &Wrong = toInterpreter();
  ++Pending.Loads;
  if (isOnStack(G))
    return loadFromStack(G, Wrong);
  if (I->Rs1 == StackPointer && !KeepsStackLine)
    return jmp(Wrong);
  const Zmm Addresses = addressesOf(I);
  const Zmm Bases = scratch(), Spread = scratch();
  if (I->Rs1 == StackPointer)
    return loadFromOwnStacks(G, Addresses, Bytes, IsSigned, Bases, Spread,
                             Wrong);
  // One of the ways below is taken, so they share what else they need.
  const int Taken = Scratches;
  const auto FromOne = [=, this, &Wrong](Label &Differ) {
    Scratches = Taken;
    spreadFirstAddress(I, 0, Spread, Addresses);
    jumpIfDiffer(Addresses, Spread, isFull(), Differ);
    locate(Bytes, 1, false, Wrong);
    if (Bytes == 2)
      IsSigned ? movsx(ecx, word[rcx]) : movzx(ecx, word[rcx]);
    else if (Bytes == 1)
      IsSigned ? movsx(ecx, byte[rcx]) : movzx(ecx, byte[rcx]);
    result(I->Rd, [&](const Zmm &To) {
      Bytes == 4 ? vpbroadcastd(To, dword[rcx]) : vpbroadcastd(To, ecx);
    });
  };
  const auto FromNeighbours = [=, this, &Wrong](Label &Apart) {
    Scratches = Taken;
    locateNeighbours(I, Addresses, Bytes, false, Bases, Spread, Apart, Wrong);
    result(I->Rd, [&](const Zmm &To) {
      if (Bytes == 4)
        vmovdqu32(To, ptr[rcx]);
      else if (Bytes == 2)
        IsSigned ? vpmovsxwd(To, ptr[rcx]) : vpmovzxwd(To, ptr[rcx]);
      else
        IsSigned ? vpmovsxbd(To, ptr[rcx]) : vpmovzxbd(To, ptr[rcx]);
    });
  };
  const auto FromEach = [=, this](Label &Elsewhere) {
    Scratches = Taken;
    locateEach(I, Addresses, Bytes, false, Bases, Elsewhere);
    if (Bytes == 4)
      return result(I->Rd,
                    [&](const Zmm &To) { gather(Zmm(To.getIdx()), Bases); });
    gather(Spread, Bases);
    const auto Shift = static_cast<uint8_t>(32 - 8 * Bytes);
    vpslld(Spread, Spread, Shift);
    IsSigned ? vpsrad(Spread, Spread, Shift) : vpsrld(Spread, Spread, Shift);
    result(I->Rd, [&](const Zmm &To) { vmovdqa32(To, Spread); });
  };
  Label Other, Done;
  const bool StacksFirst = G.IsInStacks && KeepsStackLine;
  if (G.IsScattered && !StacksFirst) {
    Label &Elsewhere = Lasting.emplace_back();
    FromEach(Elsewhere);
    L(Done);
    return outOfLine([=, this, &G, &Wrong, &Elsewhere]() mutable {
      L(Elsewhere);
      if (!KeepsStackLine)
        return jmp(Wrong);
      Scratches = Taken;
      loadFromOwnStacks(G, Addresses, Bytes, IsSigned, Bases, Spread, Wrong);
      jmp(Done);
    });
  }
  if (StacksFirst)
    loadFromOwnStacks(G, Addresses, Bytes, IsSigned, Bases, Spread, Other);
  else
    G.HasOneAddress ? FromOne(Other) : FromNeighbours(Other);
  L(Done);
  outOfLine([=, this, &G, &Wrong]() mutable {
    Label Apart, Scattered, &Elsewhere = Lasting.emplace_back();
    L(Other);
    if (StacksFirst) {
      G.HasOneAddress ? FromOne(Apart) : FromNeighbours(Apart);
      jmp(Done);
      L(Apart);
    }
    G.HasOneAddress ? FromNeighbours(Scattered) : FromOne(Scattered);
    jmp(Done);
    L(Scattered);
    FromEach(Elsewhere);
    jmp(Done);
    L(Elsewhere);
    if (StacksFirst || !KeepsStackLine)
      return jmp(Wrong);
    Scratches = Taken;
    loadFromOwnStacks(G, Addresses, Bytes, IsSigned, Bases, Spread, Wrong);
    jmp(Done);
  });
}

void Emitter::store(const GuestInsn &G) {
  const Insn *I = G.I;
  const int Bytes = elementOf(G.Opcode).Bytes;
  Label &Wrong = toInterpreter();
  ++Pending.Stores;
  if (isOnStack(G))
    return storeToStack(G, Wrong);
  if (I->Rs1 == StackPointer && !KeepsStackLine)
    return jmp(Wrong);
  const Zmm Addresses = addressesOf(I);
  const Zmm Values = inZmm(guest(I->Rs2));
  const Zmm Bases = scratch(), Spread = scratch();
  if (I->Rs1 == StackPointer)
    return storeToOwnStacks(Addresses, Bytes, Values, Bases, Spread, Wrong);
  const auto ToNeighbours = [=, this, &Wrong](Label &Apart) {
    locateNeighbours(I, Addresses, Bytes, true, Bases, Spread, Apart, Wrong);
    if (Bytes == 4)
      vmovdqu32(isFull() ? ptr[rcx] : ptr[rcx] | k1, Values);
    else
      storeNarrow(Bytes, Values, isFull());
  };
  const auto ToEach = [=, this](Label &Elsewhere) {
    locateEach(I, Addresses, Bytes, true, Bases, Elsewhere);
    // In the order of the lanes, as the guest's.
    if (Bytes == 4)
      scatter(Bases, Values, isFull());
    else
      scatterNarrow(Bytes, Bases, Values, isFull());
  };
  Label Other, Done;
  const bool StacksFirst = G.IsInStacks && KeepsStackLine;
  if (G.IsScattered && !StacksFirst) {
    Label &Elsewhere = Lasting.emplace_back();
    ToEach(Elsewhere);
    L(Done);
    return outOfLine([=, this, &Wrong, &Elsewhere]() mutable {
      L(Elsewhere);
      if (!KeepsStackLine)
        return jmp(Wrong);
      storeToOwnStacks(Addresses, Bytes, Values, Bases, Spread, Wrong);
      jmp(Done);
    });
  }
  if (StacksFirst)
    storeToOwnStacks(Addresses, Bytes, Values, Bases, Spread, Other);
  else
    ToNeighbours(Other);
  L(Done);
  outOfLine([=, this, &Wrong]() mutable {
    Label Apart, &Elsewhere = Lasting.emplace_back();
    L(Other);
    if (StacksFirst) {
      ToNeighbours(Apart);
      jmp(Done);
      L(Apart);
    }
    ToEach(Elsewhere);
    jmp(Done);
    L(Elsewhere);
    if (StacksFirst || !KeepsStackLine)
      return jmp(Wrong);
    storeToOwnStacks(Addresses, Bytes, Values, Bases, Spread, Wrong);
    jmp(Done);
  });
}

} // namespace vorion::isasim::translate
