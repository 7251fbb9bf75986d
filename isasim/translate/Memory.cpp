// Loads and stores. Neighbouring lanes at neighbouring places, all lanes at one
// place, and lanes anywhere in one region, in this order; by the stack pointer,
// the same place of all lanes' stacks. The rest, and all that is wrong, is the
// interpreter's.

#include "translate/Places.h"
#include "translate/Value.h"

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

namespace {

constexpr uint16_t StackPointer = 2 * sizeof(LaneWords);
constexpr auto NotEqual = static_cast<uint8_t>(Relation::NotEqual);
constexpr auto Above = static_cast<uint8_t>(Relation::Greater);

struct Element {
  int Bytes;
  bool IsSigned;
};

Element elementOf(Op O) {
  switch (O) {
#define LOAD(OP, T)                                                            \
  case Op::OP:                                                                 \
    return {sizeof(T), static_cast<T>(-1) < 0};
#define STORE(OP, T) LOAD(OP, T)
#define AMO(OP, KIND)
#include "core/insns/memory.def"
#undef LOAD
#undef STORE
#undef AMO
  default:
    return {};
  }
}

} // namespace

/// The first active lane's word of \p From in every lane of \p To, and in eax.
void Emitter::spreadFirst(const Zmm &To, const Zmm &From) {
  if (isFull())
    vpbroadcastd(To, Xmm(From.getIdx()));
  else
    vpermd(To, Zmm(FirstLaneZmm), From);
  vmovd(eax, Xmm(To.getIdx()));
}

/// Goes to \p Differ if active lanes of \p All have another word than the first
/// one, which \p Spread and eax have afterwards.
void Emitter::jumpIfDiffer(const Zmm &All, const Zmm &Spread, Label &Differ) {
  spreadFirst(Spread, All);
  vpcmpud(active(k2), All, Spread, NotEqual);
  kortestw(k2, k2);
  jnz(Differ);
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
  mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
  mov(ecx, eax);
  sub(ecx, dword[rsi + InGlobal + RegionLo]);
  mov(edx, dword[rsi + InGlobal + RegionBytes]);
  sub(edx, Bytes);
  cmp(ecx, edx);
  ja(Elsewhere);
  add(rcx, ptr[rsi + InGlobal + RegionHost]);
  L(Found);
  outOfLine([=, this, &Wrong]() mutable {
    L(Elsewhere);
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

/// The same for elements of \p Bytes bytes at \p Addresses, if these are
/// neighbours; else goes to \p Apart. Overwrites \p Bases and \p Spread.
void Emitter::locateNeighbours(const Zmm &Addresses, int Bytes, bool IsStore,
                               const Zmm &Bases, const Zmm &Spread,
                               Label &Apart, Label &Wrong) {
  vpsubd(Bases, Addresses, laneNumbers(static_cast<uint32_t>(Bytes)));
  jumpIfDiffer(Bases, Spread, Apart);
  locate(Bytes, MaxLanes, IsStore, Wrong);
}

/// Functions of a mode. rcx becomes the Region that holds edx bytes at eax, or
/// 0: any but the stacks; for stores not the image, which is writable in parts.
void Emitter::writeFinders() {
  for (const bool IsStore : {false, true}) {
    Label Found;
    L(IsStore ? FindWritable : FindReadable);
    mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
    for (const int In : {InGlobal, InLocal, InHigh, InImage}) {
      if (In == InImage && IsStore)
        continue;
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
  // rcx becomes where the word at eax of lane 0's stack lies, if those of the
  // other lanes are its neighbours there (MemoryView::stackOffset), or 0.
  Label Fails;
  L(FindStackLine);
  mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
  test(al, 3);
  jnz(Fails);
  mov(ecx, dword[rsi + InShift]);
  mov(edx, dword[rdi + VORION_PLACE(LastLane)]);
  shl(edx, cl);
  mov(r11d, eax);
  sub(r11d, edx);
  sub(r11d, dword[rsi + InStack + RegionLo]);
  mov(edx, dword[rsi + InStack + RegionBytes]);
  sub(edx, 4);
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
  mov(r11d, ~0U);
  shl(r11d, cl);
  and_(r11d, edx); // of the stacks in front
  sub(edx, r11d);
  shr(edx, 2);
  imul(edx, edx, 4 * StackGroup);
  lea(rcx, ptr[r11 + rdx]);
  add(rcx, ptr[rsi + InStack + RegionHost]);
  ret();
  L(Fails);
  xor_(ecx, ecx);
  ret();
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
  jumpIfDiffer(Back, Spread, Wrong);
  call(FindStackLine);
  test(rcx, rcx);
  jz(Wrong);
}

/// For active lanes at aligned \p Addresses in one region: \p Offsets from rcx.
/// eax has the first one's address, and \p Spare is overwritten.
void Emitter::locateEach(const Zmm &Addresses, int Bytes, bool IsStore,
                         const Zmm &Offsets, const Zmm &Spare, Label &Wrong) {
  mov(edx, Bytes);
  call(IsStore ? FindWritable : FindReadable);
  test(rcx, rcx);
  jz(Wrong);
  vpsubd(Offsets, Addresses, ptr_b[rcx + RegionLo]);
  mov(eax, dword[rcx + RegionBytes]);
  sub(eax, Bytes);
  vpbroadcastd(Spare, eax);
  vpcmpud(active(k2), Offsets, Spare, Above);
  if (Bytes > 1) {
    vptestmd(active(k3), Addresses, constant(static_cast<uint32_t>(Bytes - 1)));
    korw(k2, k2, k3);
  }
  kortestw(k2, k2);
  jnz(Wrong);
  mov(rcx, ptr[rcx + RegionHost]);
  if (isFull())
    kxnorw(k2, k2, k2);
  else
    kmovw(k2, k1);
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
  const Zmm Addresses = addressesOf(I);
  if (I->Rs1 == StackPointer && Bytes == 4) {
    locateOnStack(Addresses, Wrong);
    result(I->Rd, [&](const Zmm &To) { vmovdqu32(To, ptr[rcx]); });
    return;
  }
  const Zmm Bases = scratch(), Spread = scratch();
  Label Apart, Done;
  locateNeighbours(Addresses, Bytes, false, Bases, Spread, Apart, Wrong);
  result(I->Rd, [&](const Zmm &To) {
    if (Bytes == 4)
      vmovdqu32(To, ptr[rcx]);
    else if (Bytes == 2)
      IsSigned ? vpmovsxwd(To, ptr[rcx]) : vpmovzxwd(To, ptr[rcx]);
    else
      IsSigned ? vpmovsxbd(To, ptr[rcx]) : vpmovzxbd(To, ptr[rcx]);
  });
  L(Done);
  outOfLine([=, this, &Wrong]() mutable {
    Label Scattered;
    L(Apart);
    jumpIfDiffer(Addresses, Spread, Scattered);
    locate(Bytes, 1, false, Wrong);
    if (Bytes == 4)
      mov(ecx, dword[rcx]);
    else if (Bytes == 2)
      IsSigned ? movsx(ecx, word[rcx]) : movzx(ecx, word[rcx]);
    else
      IsSigned ? movsx(ecx, byte[rcx]) : movzx(ecx, byte[rcx]);
    result(I->Rd, [&](const Zmm &To) { vpbroadcastd(To, ecx); });
    jmp(Done);
    L(Scattered);
    locateEach(Addresses, Bytes, false, Bases, Spread, Wrong);
    vpgatherdd(Spread | k2, ptr[rcx + Bases]);
    if (const auto Shift = static_cast<uint8_t>(32 - 8 * Bytes)) {
      vpslld(Spread, Spread, Shift);
      IsSigned ? vpsrad(Spread, Spread, Shift) : vpsrld(Spread, Spread, Shift);
    }
    result(I->Rd, [&](const Zmm &To) { vmovdqa32(To, Spread); });
    jmp(Done);
  });
}

void Emitter::store(const GuestInsn &G) {
  const Insn *I = G.I;
  const int Bytes = elementOf(G.Opcode).Bytes;
  Label &Wrong = toInterpreter();
  ++Pending.Stores;
  const Zmm Addresses = addressesOf(I);
  const Zmm Values = inZmm(guest(I->Rs2));
  const Address To = isFull() ? ptr[rcx] : ptr[rcx] | k1;
  if (I->Rs1 == StackPointer && Bytes == 4) {
    locateOnStack(Addresses, Wrong);
    vmovdqu32(To, Values);
    return;
  }
  const Zmm Bases = scratch(), Spread = scratch();
  Label Apart, Done;
  locateNeighbours(Addresses, Bytes, true, Bases, Spread, Apart, Wrong);
  if (Bytes == 4)
    vmovdqu32(To, Values);
  else if (Bytes == 2)
    vpmovdw(To, Values);
  else
    vpmovdb(To, Values);
  L(Done);
  outOfLine([=, this, &Wrong]() mutable {
    L(Apart);
    // The host has no such stores of less than words.
    if (Bytes != 4) {
      jmp(Wrong);
      return;
    }
    spreadFirst(Spread, Addresses);
    locateEach(Addresses, Bytes, true, Bases, Spread, Wrong);
    // In the order of the lanes, as the guest's.
    vpscatterdd(ptr[rcx + Bases] | k2, Values);
    jmp(Done);
  });
}

} // namespace vorion::isasim::translate
