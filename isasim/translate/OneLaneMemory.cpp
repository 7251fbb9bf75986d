// Loads, stores and atomics of one lane. An access is looked for in the region
// that the last one was in and in the stack of the stack pointer, in the order
// that Guess.cpp says; then anywhere.

#include "translate/AtomicWord.h"
#include "translate/OneLaneWriter.h"

#include <bit>

namespace vorion::isasim::translate::lane {

using namespace Xbyak;
using namespace Xbyak::util;

namespace {

constexpr int WordBytes = 4, LineBytes = WordBytes * StackGroup;

/// The region that loads or stores were in last: where it begins, and the
/// greatest distance of an element of each size, in elements.
struct LastRegion {
  uint32_t Lo, Reach[3];
};

/// The stack that the stack pointer was in last: its last byte, its size, and
/// where its top word lies on the host.
struct LastStack {
  uint32_t Top, Bytes;
  std::byte *Host;
};

/// Where the LastRegion of loads, or of stores, lies. No version of a region
/// for several lanes runs meanwhile, whose vectors these are.
int lastRegion(bool IsStore) {
  return VORION_PLACE(HostSpare) + (IsStore ? sizeof(LastRegion) : 0);
}
int lastStack() { return VORION_PLACE(HostSpare) + 2 * sizeof(LastRegion); }

} // namespace

void Writer::addressOf(const Insn *I, const Reg32 &To) {
  const Word Base = guest(I->Rs1);
  if (Base.In == Word::Register)
    return lea(To, ptr[Reg64(static_cast<int>(Base.Bits)) + I->Imm]);
  load(To, Base);
  if (I->Imm != 0)
    add(To, I->Imm);
}

/// The access itself, of \p Bytes bytes.
void Writer::move(const GuestInsn &G, const RegExp &At, int Bytes) {
  const Insn *I = G.I;
  if (G.Is == Kind::Store) {
    if (heldFloat(I->Rs2) >= 0)
      return vmovss(dword[At], Xmm(heldFloat(I->Rs2)));
    Given = 0;
    const Reg32 From = inRegister(guest(I->Rs2));
    if (Bytes == 1)
      mov(byte[At], From.cvt8());
    else if (Bytes == 2)
      mov(word[At], From.cvt16());
    else
      mov(dword[At], From);
    return;
  }
  if (isSink(I->Rd))
    return;
  if (heldFloat(I->Rd) >= 0)
    return vmovss(Xmm(heldFloat(I->Rd)), dword[At]);
  const Reg32 To = heldWord(I->Rd) >= 0 ? Reg32(heldWord(I->Rd)) : eax;
  const bool IsSigned = elementOf(G.Opcode).IsSigned;
  if (Bytes == 1)
    IsSigned ? movsx(To, byte[At]) : movzx(To, byte[At]);
  else if (Bytes == 2)
    IsSigned ? movsx(To, word[At]) : movzx(To, word[At]);
  else
    mov(To, dword[At]);
  if (heldWord(I->Rd) < 0)
    mov(place(I->Rd), eax);
}

/// On at \p Elsewhere unless the access is in the LastStack, and at \p Wrong
/// unless it is aligned.
void Writer::accessOnStack(const GuestInsn &G, Label &Elsewhere, Label &Wrong) {
  const int Bytes = elementOf(G.Opcode).Bytes;
  addressOf(G.I, eax);
  mov(ecx, dword[rdi + lastStack() + offsetof(LastStack, Top)]);
  sub(ecx, eax);
  cmp(ecx, dword[rdi + lastStack() + offsetof(LastStack, Bytes)]);
  jae(Elsewhere);
  if (Bytes > 1) {
    test(al, Bytes - 1);
    jnz(Wrong);
  }
  // MemoryView::stackOffset
  shr(ecx, 2);
  shl(rcx, 6);
  static_assert(LineBytes == 1 << 6);
  if (Bytes < WordBytes) {
    and_(eax, WordBytes - 1);
    add(rcx, rax);
  }
  add(rcx, ptr[rdi + lastStack() + offsetof(LastStack, Host)]);
  move(G, rcx, Bytes);
}

/// On at \p Elsewhere unless the access is in the LastRegion.
void Writer::accessInRegion(const GuestInsn &G, Label &Elsewhere) {
  const bool IsStore = G.Is == Kind::Store;
  const int Bytes = elementOf(G.Opcode).Bytes;
  const int Size = std::countr_zero(static_cast<unsigned>(Bytes));
  const int Last = lastRegion(IsStore);
  addressOf(G.I, ecx);
  sub(ecx, dword[rdi + Last + offsetof(LastRegion, Lo)]);
  // What is not aligned goes beyond the reach of any region.
  if (Size != 0)
    ror(ecx, Size);
  cmp(ecx, dword[rdi + Last + offsetof(LastRegion, Reach) +
                 Size * static_cast<int>(sizeof(uint32_t))]);
  ja(Elsewhere);
  move(G, (IsStore ? r14 : r15) + rcx * Bytes, Bytes);
}

void Writer::access(const GuestInsn &G) {
  const Insn *I = G.I;
  const bool IsStore = G.Is == Kind::Store;
  const int Bytes = elementOf(G.Opcode).Bytes;
  Label &Wrong = toInterpreter();
  ++(IsStore ? Pending.Stores : Pending.Loads);
  Label Elsewhere, Done;
  if (I->Rs1 == StackPointer) {
    if (!KeepsStackPointer || I->Imm % Bytes != 0)
      return accessOnStack(G, Wrong, Wrong);
    // The stack grows downwards, and so do the lines of its words.
    const int32_t Byte = I->Imm & (WordBytes - 1);
    test(r12, r12);
    jz(Elsewhere);
    move(G, r12 + (Byte - (I->Imm - Byte) / WordBytes * LineBytes), Bytes);
    L(Done);
    return outOfLine([=, this, &G, &Wrong]() mutable {
      L(Elsewhere);
      accessOnStack(G, Wrong, Wrong);
      jmp(Done);
    });
  }
  G.IsInStacks ? accessOnStack(G, Elsewhere, Wrong)
               : accessInRegion(G, Elsewhere);
  L(Done);
  outOfLine([=, this, &G, &Wrong]() mutable {
    Label Others, Found;
    L(Elsewhere);
    G.IsInStacks ? accessInRegion(G, Others) : accessOnStack(G, Others, Wrong);
    jmp(Done);
    L(Others);
    addressOf(I, eax);
    if (Bytes > 1) {
      test(al, Bytes - 1);
      jnz(Wrong);
    }
    call(FindOnStack);
    test(rcx, rcx);
    jnz(Found);
    addressOf(I, eax);
    mov(edx, Bytes);
    call(IsStore ? FindStore : FindLoad);
    test(rcx, rcx);
    jz(Wrong);
    L(Found);
    move(G, rcx, Bytes);
    jmp(Done);
  });
}

/// As Atomics.cpp has them: in local memory, and additions without a result in
/// global memory.
void Writer::atomic(const GuestInsn &G) {
  const Insn *I = G.I;
  const Amo Kind = atomicOf(G.Opcode);
  Label &Wrong = toInterpreter();
  Label Elsewhere, Done;
  // rcx becomes where the word at eax lies.
  const auto Locate = [this, &Wrong](int In, Label &NotThere) {
    mov(ecx, eax);
    sub(ecx, dword[rsi + In + RegionLo]);
    mov(edx, dword[rsi + In + RegionBytes]);
    sub(edx, WordBytes);
    cmp(ecx, edx);
    ja(NotThere);
    test(al, WordBytes - 1);
    jnz(Wrong);
    add(rcx, ptr[rsi + In + RegionHost]);
  };
  load(eax, guest(I->Rs1));
  mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
  Locate(InLocal, Elsewhere);
  load(edx, guest(I->Rs2));
  mov(eax, dword[rcx]);
  applyAtomic(*this, Kind, edx, eax);
  mov(dword[rcx], edx);
  xor_(esi, esi);
  cmp(eax, edx);
  setne(sil);
  add(ptr[rdi + VORION_PLACE(Count.Changes)], rsi);
  result(I->Rd, made(eax));
  L(Done);
  inc(qword[rdi + VORION_PLACE(Count.Atomics)]);
  const bool Commutes = Kind == Amo::Add && isSink(I->Rd);
  outOfLine([=, this, &Wrong]() mutable {
    Label High, Found;
    L(Elsewhere);
    if (!Commutes)
      return jmp(Wrong);
    Locate(InGlobal, High);
    L(Found);
    load(edx, guest(I->Rs2));
    lock();
    add(dword[rcx], edx);
    xor_(esi, esi);
    test(edx, edx);
    setne(sil);
    add(ptr[rdi + VORION_PLACE(Count.Changes)], rsi);
    jmp(Done);
    L(High);
    Locate(InHigh, Wrong);
    jmp(Found);
  });
}

void Writer::followStackPointer(const GuestInsn &G) {
  if (KeepsStackPointer && G.I->Rd == StackPointer)
    call(FollowStack);
}

void Writer::beginMemory() {
  for (const Label *Find : {&FindLoad, &FindStore}) {
    mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
    mov(eax, dword[rsi + InGlobal + RegionLo]);
    mov(edx, 1);
    call(*Find);
  }
  mov(dword[rdi + lastStack() + offsetof(LastStack, Bytes)], 0);
  call(FollowStack);
}

/// Functions. FindOnStack: rcx becomes where the byte at eax lies on the lane's
/// own stack, or on any where stacks are the program's affair
/// (MemoryView::stackOffset), and edx how far below its stack's top; or rcx 0.
/// FollowStack: sets the LastStack and r12.
void Writer::writeStackFinders() {
  Label Own, Fails, None;
  L(FindOnStack);
  push(r10);
  push(r11);
  mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
  mov(edx, dword[rsi + InStack + RegionLo]);
  add(edx, dword[rsi + InStack + RegionBytes]);
  dec(edx);
  sub(edx, eax);
  cmp(edx, dword[rsi + InStack + RegionBytes]);
  jae(Fails);
  mov(r10d, dword[rsi + InShift]);
  shrx(r11d, edx, r10d); // the stack's number
  cmp(dword[rdi + VORION_PLACE(FirstStack)], WarpState::NoOwnStack);
  je(Own);
  mov(ecx, dword[rdi + VORION_PLACE(LastLane)]);
  add(ecx, dword[rdi + VORION_PLACE(FirstStack)]);
  cmp(ecx, r11d);
  jne(Fails);
  L(Own);
  mov(ecx, ~0U);
  shlx(ecx, ecx, r10d);
  andn(edx, ecx, edx);
  and_(eax, WordBytes - 1);
  mov(ecx, edx);
  shr(ecx, 2);
  shl(rcx, 6);
  static_assert(LineBytes == 1 << 6);
  add(rcx, rax);
  mov(eax, r11d);
  and_(eax, StackGroup - 1);
  lea(rcx, ptr[rcx + rax * WordBytes]);
  and_(r11d, ~(StackGroup - 1));
  shlx(r11, r11, r10);
  add(rcx, r11);
  add(rcx, ptr[rsi + InStack + RegionHost]);
  pop(r11);
  pop(r10);
  ret();
  L(Fails);
  xor_(ecx, ecx);
  pop(r11);
  pop(r10);
  ret();

  Label Known;
  L(FollowStack);
  xor_(r12d, r12d);
  load(eax, guest(StackPointer));
  test(al, WordBytes - 1);
  jnz(None);
  mov(ecx, dword[rdi + lastStack() + offsetof(LastStack, Top)]);
  sub(ecx, eax);
  cmp(ecx, dword[rdi + lastStack() + offsetof(LastStack, Bytes)]);
  jb(Known);
  push(rax);
  call(FindOnStack);
  pop(rax);
  test(rcx, rcx);
  jz(None);
  add(eax, edx);
  mov(dword[rdi + lastStack() + offsetof(LastStack, Top)], eax);
  mov(eax, edx);
  shr(eax, 2);
  shl(rax, 6);
  sub(rcx, rax);
  mov(ptr[rdi + lastStack() + offsetof(LastStack, Host)], rcx);
  mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
  mov(esi, dword[rsi + InShift]);
  mov(eax, 1);
  shlx(eax, eax, esi);
  mov(dword[rdi + lastStack() + offsetof(LastStack, Bytes)], eax);
  mov(ecx, edx);
  L(Known);
  // All immediates stay in the stack.
  cmp(ecx, GreatestOnStack);
  jb(None);
  mov(eax, ecx);
  sub(eax, LeastOnStack);
  cmp(eax, dword[rdi + lastStack() + offsetof(LastStack, Bytes)]);
  jae(None);
  shr(ecx, 2);
  shl(rcx, 6);
  add(rcx, ptr[rdi + lastStack() + offsetof(LastStack, Host)]);
  mov(r12, rcx);
  L(None);
  ret();
}

/// A function: rcx becomes where the edx bytes at eax lie, or 0; the stacks are
/// not looked at. The region becomes the last one of loads or stores.
void Writer::writeFinder(bool IsStore) {
  Label Next, Found, Fails;
  L(IsStore ? FindStore : FindLoad);
  mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
  push(r10);
  // Of a region at rcx.
  const auto Try = [&] {
    mov(r10d, eax);
    sub(r10d, dword[rcx + RegionLo]);
    push(rax);
    mov(eax, dword[rcx + RegionBytes]);
    sub(eax, edx);
    cmp(r10d, eax);
    pop(rax);
    jbe(Found);
  };
  constexpr int Second = sizeof(isasim::Region);
  const std::vector<int> Where =
      IsStore ? std::vector{InGlobal, InLocal, InHigh, InRest, InRest + Second}
              : std::vector{InGlobal, InLocal, InHigh,
                            InImage,  InWhole, InWhole + Second};
  for (const int In : Where) {
    lea(rcx, ptr[rsi + In]);
    Try();
  }
  if (IsStore) {
    // Parts of the image, which may be less than a word.
    mov(rcx, ptr[rsi + InImageWritable]);
    mov(esi, dword[rsi + InNumImageWritable]);
    L(Next);
    dec(esi);
    js(Fails);
    Label TooSmall;
    cmp(dword[rcx + RegionBytes], WordBytes);
    jb(TooSmall);
    Try();
    L(TooSmall);
    add(rcx, Second);
    jmp(Next);
  }
  L(Fails);
  xor_(ecx, ecx);
  pop(r10);
  ret();
  L(Found);
  const int Last = lastRegion(IsStore);
  const Reg64 Host = IsStore ? r14 : r15;
  mov(Host, ptr[rcx + RegionHost]);
  mov(esi, dword[rcx + RegionLo]);
  mov(dword[rdi + Last + offsetof(LastRegion, Lo)], esi);
  for (int Size = 0; Size != 3; ++Size) {
    mov(esi, dword[rcx + RegionBytes]);
    sub(esi, 1 << Size);
    if (Size != 0)
      shr(esi, Size);
    mov(dword[rdi + Last + offsetof(LastRegion, Reach) +
              Size * static_cast<int>(sizeof(uint32_t))],
        esi);
  }
  mov(ecx, r10d);
  add(rcx, Host);
  pop(r10);
  ret();
}

} // namespace vorion::isasim::translate::lane
