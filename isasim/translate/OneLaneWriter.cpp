// A program of one lane gains nothing from vectors: each access would look at
// 16 addresses, and each branch at 16 conditions. Here a guest register is the
// word of the only active lane, in a register of the host or where the
// interpreter has it. Instructions are the interpreter's definitions
// (core/insns/), evaluated over words that write host code. As in the other
// versions (Emitter.cpp), what is rare is left to the interpreter's handler
// before anything has changed.

#include "translate/OneLaneWriter.h"

#include <algorithm>
#include <cassert>
#include <ranges>
#include <utility>

namespace vorion::isasim::translate::lane {

using namespace Xbyak;
using namespace Xbyak::util;

namespace {

const Reg32 HeldWords[] = {ebx, ebp, r10d, r11d},
            Temporaries[] = {eax, edx, esi};
constexpr int FirstHeldFloat = 4, NumHostFloats = 16;

/// Far more than a warp executes in a row (Core.cpp).
constexpr int CountBits = 21;

/// What a caller finds as it was.
const Reg64 KeptRegisters[] = {rbx, rbp, r12, r13, r14, r15};

} // namespace

Reg32 Writer::temporary() {
  assert(Given != std::size(Temporaries) && "an instruction needs fewer");
  return Temporaries[Given++];
}

void Writer::load(const Reg32 &To, const Word &W) {
  if (W.In == Word::Number)
    return mov(To, W.Bits);
  with(W, [&](const Operand &From) {
    if (From != To)
      mov(To, From);
  });
}

Reg32 Writer::inRegister(const Word &W) {
  if (W.In == Word::Temporary || W.In == Word::Register)
    return Reg32(static_cast<int>(W.Bits));
  const Reg32 To = temporary();
  load(To, W);
  return To;
}

Reg32 Writer::ownCopy(const Word &W) {
  if (W.In == Word::Temporary)
    return Reg32(static_cast<int>(W.Bits));
  const Reg32 To = temporary();
  load(To, W);
  return To;
}

void Writer::allocate() {
  const RegisterUses Uses = usesOf(Region);
  std::ranges::copy(Uses.Written, Written);
  std::ranges::fill(Words, -1);
  std::ranges::fill(Floats, -1);
  size_t NextWord = 0;
  int NextFloat = FirstHeldFloat;
  for (const unsigned R : Uses.MostUsed)
    if (R >= FBase && NextFloat != NumHostFloats)
      Floats[R] = NextFloat++;
    else if (R < FBase && NextWord != std::size(HeldWords))
      Words[R] = HeldWords[NextWord++].getIdx();
  for (const GuestInsn &G : Region)
    if ((G.Is == Kind::Load || G.Is == Kind::Store) &&
        G.I->Rs1 == StackPointer) {
      KeepsStackPointer = true;
      LeastOnStack = std::min(LeastOnStack,
                              G.I->Imm & -static_cast<int>(sizeof(uint32_t)));
      GreatestOnStack = std::max(GreatestOnStack, G.I->Imm);
    }
  // Others that write the stack pointer may go elsewhere from there.
  if (std::ranges::any_of(Region, [](const GuestInsn &G) {
        return G.I->Rd == StackPointer && G.Is != Kind::Integer &&
               G.Is != Kind::Load && G.Is != Kind::Other;
      }))
    KeepsStackPointer = false;
}

Word Writer::guest(Register R) {
  if (R == XBase)
    return {this, Word::Number, 0};
  if (heldWord(R) >= 0)
    return {this, Word::Register, static_cast<uint32_t>(heldWord(R))};
  if (heldFloat(R) >= 0) {
    const Reg32 To = temporary();
    vmovd(To, Xmm(heldFloat(R)));
    return made(To);
  }
  return {this, Word::Memory, R};
}

void Writer::result(Register R, const Word &W) {
  if (isSink(R))
    return;
  if (heldWord(R) >= 0)
    return load(Reg32(heldWord(R)), W);
  if (heldFloat(R) >= 0) {
    load(ecx, W);
    return vmovd(Xmm(heldFloat(R)), ecx);
  }
  if (W.In == Word::Number)
    return mov(place(R), W.Bits);
  if (W.In == Word::Memory)
    load(ecx, W);
  mov(place(R), W.In == Word::Memory ? ecx : Reg32(static_cast<int>(W.Bits)));
}

Xmm Writer::guestFloat(Register R, int Spare) {
  if (heldFloat(R) >= 0)
    return Xmm(heldFloat(R));
  vmovss(Xmm(Spare), place(R));
  return Xmm(Spare);
}

void Writer::floatResult(Register R, const Xmm &From) {
  if (heldFloat(R) < 0)
    vmovss(place(R), From);
  else if (heldFloat(R) != From.getIdx())
    vmovaps(Xmm(heldFloat(R)), From);
}

//===----------------------------------------------------------------------===//
// Counting, and ways in and out
//===----------------------------------------------------------------------===//

void Writer::addPending() {
  if (Pending.Insns)
    add(r8, Pending.Insns);
  const uint64_t Others = Pending.Loads |
                          uint64_t{Pending.Stores} << CountBits |
                          uint64_t{Pending.Splits} << 2 * CountBits;
  if (Others > INT32_MAX) {
    mov(rcx, Others);
    add(r13, rcx);
  } else if (Others) {
    add(r13, static_cast<uint32_t>(Others));
  }
}

/// The same with the present instruction, on one way out of several.
void Writer::addPresent() {
  const auto Before = Pending;
  ++Pending.Insns;
  addPending();
  Pending = Before;
}

Label &Writer::toInterpreter() {
  if (!ToInterpreter)
    ToInterpreter = &ToInterpreters.emplace_back();
  return *ToInterpreter;
}

void Writer::stopIfEnough(const Insn *Next) {
  Label Enough;
  cmp(r8, qword[rdi + VORION_PLACE(RetireLimit)]);
  jae(Enough);
  outOfLine([this, Enough, Next]() mutable {
    L(Enough);
    mov(rsi, reinterpret_cast<uint64_t>(Next));
    jmp(Return);
  });
}

/// On at \p To, in the region or by the handler that it has at present.
void Writer::resumeAt(const Insn *To) {
  if (const auto At = Labels.find(To); At != Labels.end())
    return jmp(At->second);
  mov(rsi, reinterpret_cast<uint64_t>(To));
  mov(rax, ptr[rsi]);
  jmp(Leave);
}

void Writer::writeEntries() {
  for (const GuestInsn &G : Region) {
    if (!G.Enters)
      continue;
    Result.Entries[G.I] = getCurr();
    lea(rcx, ptr[rip + Labels[G.I]]);
    jmp(Prologue);
  }
  L(Prologue);
  for (const Reg64 &Kept : KeptRegisters)
    push(Kept);
  // The straight line up to here.
  static_assert(sizeof(Insn) == 32);
  sub(rsi, rdx);
  sar(rsi, 5);
  mov(r8, ptr[rdi + VORION_PLACE(Count.WarpInstructions)]);
  add(r8, rsi);
  xor_(r13d, r13d);
  mov(eax, dword[rdi + VORION_PLACE(LastLane)]);
  lea(r9, ptr[rdi + rax * 4]);
  push(rcx);
  for (unsigned R = 0; R != NumRegisters; ++R) {
    const auto In = static_cast<Register>(R * sizeof(LaneWords));
    if (Words[R] >= 0)
      mov(Reg32(Words[R]), place(In));
    if (Floats[R] >= 0)
      vmovss(Xmm(Floats[R]), place(In));
  }
  beginMemory();
  pop(rcx);
  jmp(rcx);
}

void Writer::writeExits() {
  const auto Store = [this] {
    for (unsigned R = 0; R != NumRegisters; ++R) {
      const auto In = static_cast<Register>(R * sizeof(LaneWords));
      if (Words[R] >= 0 && Written[R])
        mov(place(In), Reg32(Words[R]));
      if (Floats[R] >= 0 && Written[R])
        vmovss(place(In), Xmm(Floats[R]));
    }
    mov(rcx, r8);
    sub(rcx, ptr[rdi + VORION_PLACE(Count.WarpInstructions)]);
    mov(ptr[rdi + VORION_PLACE(Count.WarpInstructions)], r8);
    add(ptr[rdi + VORION_PLACE(Count.LaneInstructions)], rcx);
    for (const int Count :
         {VORION_PLACE(Count.Loads), VORION_PLACE(Count.Stores),
          VORION_PLACE(Count.Splits)}) {
      mov(ecx, r13d);
      and_(ecx, (1U << CountBits) - 1);
      add(ptr[rdi + Count], rcx);
      shr(r13, CountBits);
    }
    for (const Reg64 &Kept : KeptRegisters | std::views::reverse)
      pop(Kept);
  };
  // To the handler rax with the instruction rsi, from which on is counted.
  L(Leave);
  Store();
  mov(rdx, rsi);
  jmp(rax);
  // The warp stops in front of rsi.
  L(Return);
  Store();
  mov(ptr[rdi + VORION_PLACE(Next)], rsi);
  ret();
}

/// Offsets from \p Labels' table on; 0 for what has no label.
void Writer::writeTable() {
  align(4);
  L(Table);
  const uint8_t *From = Table.getAddress();
  for (const Insn *I = Region.front().I; I <= Region.back().I; ++I) {
    const auto At = Labels.find(I);
    dd(At == Labels.end()
           ? 0
           : static_cast<uint32_t>(At->second.getAddress() - From));
  }
}

//===----------------------------------------------------------------------===//
// Jumps and lanes
//===----------------------------------------------------------------------===//

/// The destination of a call becomes the place behind it.
void Writer::returnAddress(const Insn *I) {
  const auto Number = static_cast<uint32_t>(I - Code.begin());
  result(I->Rd, Word(Code.low() + 4 * (Number + 1)));
}

void Writer::jump(const GuestInsn &G) {
  returnAddress(G.I);
  ++Pending.Insns;
  countPending();
  const Insn *To = G.I + (G.I->Imm >> 2);
  stopIfEnough(To);
  resumeAt(To);
}

void Writer::indirect(const GuestInsn &G) {
  Label &Wrong = toInterpreter();
  addressOf(G.I, eax);
  test(al, 2);
  jnz(Wrong);
  sub(eax, Code.low());
  shr(eax, 2);
  cmp(eax, Code.count());
  jae(Wrong);
  returnAddress(G.I);
  addPresent();
  mov(ecx, eax);
  shl(rcx, 5);
  static_assert(sizeof(Insn) == 1 << 5);
  mov(rsi, reinterpret_cast<uint64_t>(Code.begin()));
  add(rsi, rcx);
  cmp(r8, qword[rdi + VORION_PLACE(RetireLimit)]);
  jae(Return);
  // In the region, if the table says so.
  Label Outside;
  const auto First = static_cast<uint32_t>(Region.front().I - Code.begin());
  const auto Last = static_cast<uint32_t>(Region.back().I - Code.begin());
  sub(eax, First);
  cmp(eax, Last - First);
  ja(Outside);
  lea(rdx, ptr[rip + Table]);
  movsxd(rax, dword[rdx + rax * 4]);
  test(rax, rax);
  jz(Outside);
  add(rax, rdx);
  jmp(rax);
  L(Outside);
  mov(rax, ptr[rsi]);
  jmp(Leave);
}

/// One lane never disagrees with itself: splits are uniform. Joins and
/// predicates that activate others are the interpreter's.
void Writer::lanes(const GuestInsn &G) {
  const Insn *I = G.I;
  switch (G.Opcode) {
  case Op::VX_JOIN:
    load(eax, guest(I->Rs1));
    cmp(eax, dword[rdi + VORION_PLACE(StackDepth)]);
    jne(toInterpreter());
    return;
  case Op::VX_SPLIT:
  case Op::VX_SPLIT_N:
    mov(ecx, dword[rdi + VORION_PLACE(StackDepth)]);
    result(I->Rd, made(ecx));
    break;
  default: {
    Label Stays;
    load(eax, guest(I->Rs1));
    test(al, 1);
    G.Opcode == Op::VX_PRED_N ? jz(Stays) : jnz(Stays);
    // No lane is left, and those that come back are this one.
    load(eax, guest(I->Rs2));
    and_(eax, dword[rdi + VORION_PLACE(AllLanes)]);
    cmp(eax, dword[rdi + VORION_PLACE(Mask)]);
    jne(toInterpreter());
    L(Stays);
    break;
  }
  }
  ++Pending.Splits;
}

void Writer::vote(const GuestInsn &G) {
  if (G.Opcode == Op::VX_VOTE_UNI)
    return result(G.I->Rd, Word(1));
  load(eax, guest(G.I->Rs1));
  mov(ecx, 0);
  if (G.Opcode == Op::VX_VOTE_BALLOT)
    mov(edx, dword[rdi + VORION_PLACE(Mask)]);
  else
    mov(edx, 1);
  test(eax, eax);
  cmovnz(ecx, edx);
  result(G.I->Rd, made(ecx));
}

//===----------------------------------------------------------------------===//
// The region
//===----------------------------------------------------------------------===//

/// What is left to the interpreter whatever its operands.
static bool isLeft(const GuestInsn &G) {
  switch (G.Is) {
  case Kind::Shuffle:
  case Kind::Barrier:
  case Kind::Other:
    return true;
  default:
    break;
  }
  switch (G.Opcode) {
  case Op::RV_FCLASS_S:
    return true;
  case Op::RV_FCVT_S_W:
  case Op::RV_FCVT_S_WU:
    return G.I->Imm != Rne && G.I->Imm != DynamicRm;
  default:
    return false;
  }
}

void Writer::writeInsn(const GuestInsn &G) {
  Given = 0;
  ToInterpreter = nullptr;
  const auto Before = Pending;
  if (isLeft(G)) {
    jmp(toInterpreter());
  } else {
    switch (G.Is) {
    case Kind::Integer:
      integer(G);
      break;
    case Kind::Float:
      floating(G);
      break;
    case Kind::Load:
    case Kind::Store:
      access(G);
      break;
    case Kind::Atomic:
      atomic(G);
      break;
    case Kind::Branch:
      branch(G);
      break;
    case Kind::Lanes:
      lanes(G);
      break;
    case Kind::Vote:
      vote(G);
      break;
    case Kind::Jump:
      return jump(G);
    case Kind::Indirect:
      indirect(G);
      break;
    default: // a fence, which the host keeps without a word
      break;
    }
    if (G.Is != Kind::Indirect)
      followStackPointer(G);
  }
  ++Pending.Insns;
  if (ToInterpreter)
    outOfLine([this, &G, Before, At = ToInterpreter] {
      L(*At);
      Pending = Before;
      countPending();
      mov(rsi, reinterpret_cast<uint64_t>(G.I));
      mov(rax, reinterpret_cast<uint64_t>(
                   Exec.Handlers[static_cast<unsigned>(G.Opcode)][0]));
      jmp(Leave);
    });
}

OneLaneCode Writer::write() {
  setDefaultJmpNEAR(true);
  allocate();
  for (const GuestInsn &G : Region)
    if (G.Leads)
      Labels.emplace(G.I, Label());
  writeEntries();
  for (size_t N = 0; N != Region.size(); ++N) {
    const GuestInsn &G = Region[N];
    if (G.Leads) {
      countPending();
      L(Labels[G.I]);
    }
    writeInsn(G);
    const bool Falls = N + 1 != Region.size() && Region[N + 1].I == G.I + 1;
    const bool Goes = isLeft(G) || G.Is == Kind::Jump || G.Is == Kind::Indirect;
    if (!Falls && !Goes) {
      countPending();
      resumeAt(G.I + 1);
    }
    if (!Falls || Goes)
      Pending = {};
  }
  // What is out of line may have more of it.
  for (size_t N = 0; N != Later.size(); ++N) {
    const std::function<void()> Write = Later[N];
    Write();
  }
  writeExits();
  writeStackFinders();
  writeFinder(false);
  writeFinder(true);
  writeTable();
  ready();
  Result.Bytes = getSize();
  return std::move(Result);
}

} // namespace vorion::isasim::translate::lane

namespace vorion::isasim::translate {

OneLaneCode writeForOneLane(const ExecTable &Exec, const CodeTable &Code,
                            const std::vector<GuestInsn> &Region,
                            std::span<uint8_t> Buffer) {
  return lane::Writer(Exec, Code, Region, Buffer).write();
}

} // namespace vorion::isasim::translate
