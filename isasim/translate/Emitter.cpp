//===- Emitter.cpp - a region as host code --------------------------------===//
//
// A region is written twice, for all lanes active and for some of them, with
// the same guest registers in the same host registers, and once more for one
// lane where a warp of one was found or a loop may leave one of several
// (OneLane.h). It is entered as the
// interpreter's handlers are (core/State.h, Handler), and ends in a tail call
// of one. What it does not do itself, or finds out of the ordinary, it leaves
// to the interpreter's handler of that instruction before it has changed
// anything: so traps, parking and slow paths exist once.
//
//===----------------------------------------------------------------------===//

#include "translate/Emitter.h"

#include "translate/Places.h"

#include <algorithm>
#include <cassert>
#include <ranges>

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

namespace {

[[maybe_unused]] constexpr int NumScratches = Emitter::SpareZmm;
constexpr int FirstGuestZmm = 9;
constexpr int NumZmms = 32;

/// What a caller finds as it was.
constexpr Reg64 KeptRegisters[] = {rbx, rbp, r12, r13, r14, r15};

} // namespace

Emitter::Emitter(VectorUnit Unit, const ExecTable &ExecIn,
                 const CodeTable &CodeIn,
                 const std::vector<GuestInsn> &RegionIn,
                 const OneLaneCode &OneLaneIn, std::span<uint8_t> Buffer)
    : HostVectors(Unit, Buffer), Exec(ExecIn), Code(CodeIn), Region(RegionIn),
      OneLane(OneLaneIn) {
  setDefaultJmpNEAR(true);
  allocate();
  findStackUses();
}

void Emitter::allocate() {
  const RegisterUses Uses = usesOf(Region);
  std::ranges::copy(Uses.Written, Written);
  Rounds = std::ranges::any_of(
      Region, [](const GuestInsn &G) { return G.Is == Kind::Float; });
  std::ranges::fill(Zmms, -1);
  if (!isWide())
    return;
  int Next = FirstGuestZmm;
  for (const unsigned R : Uses.MostUsed)
    if (Next != NumZmms)
      Zmms[R] = Next++;
}

int Emitter::zmmOf(uint16_t Register) const { return Zmms[numberOf(Register)]; }

Term Emitter::guest(uint16_t Register) {
  if (Register == XBase)
    return {};
  if (const int Z = zmmOf(Register); Z >= 0)
    return {Z};
  if (const int Kept = Held.find(Register); Kept >= 0) {
    Held.use(Kept);
    return {Kept};
  }
  const Zmm To = scratch();
  vmovdqa32(To, ptr[rdi + Register]);
  if (!isWide())
    Held.hold(To.getIdx(), Register);
  return {To.getIdx()};
}

Zmm Emitter::scratch() {
  // Out of line, what is held must be there when the code beside it goes on.
  if (!isWide())
    if (const int Pair = Held.take(IsOutOfLine); Pair >= 0)
      return Zmm(Pair);
  assert(Scratches != NumScratches && "an instruction needs fewer");
  return Zmm(Scratches++);
}

Zmm Emitter::inZmm(Term T) {
  if (!T.isNumber())
    return Zmm(T.Zmm);
  const Zmm To = scratch();
  if (T.Bits == 0)
    vpxord(To, To, To);
  else
    vpbroadcastd(To, number(T.Bits));
  return To;
}

Zmm Emitter::active(const Zmm &Z) const { return Full ? Z : Z | k1; }
Opmask Emitter::active(const Opmask &K) const { return Full ? K : K | k1; }

void Emitter::result(uint16_t Register,
                     const std::function<void(const Zmm &)> &Write) {
  if (const int Z = zmmOf(Register); Z >= 0)
    return Write(active(Zmm(Z)));
  const int Kept = Held.find(Register);
  if (Kept >= 0)
    Held.use(Kept);
  const Zmm To = Kept >= 0 ? Zmm(Kept) : scratch();
  if (isSink(Register))
    return Write(active(To));
  // The host lets a load wait for a store with a mask in front of it until the
  // cache has that. So the other lanes' words are stored, too. Out of line, a
  // vector may hold Register for code that has not been executed.
  const Address Word = ptr[rdi + Register];
  if (!Full && (Kept < 0 || IsOutOfLine))
    vmovdqa32(To, Word);
  Write(active(To));
  vmovdqa32(Word, To);
  if (!isWide())
    Held.hold(To.getIdx(), Register);
}

/// Out of line: loads what \p Was holds, which the code beside it goes on with.
void Emitter::holdAgain(const HeldVectors &Was) {
  Held = Was;
  for (int N = 0; N != HeldVectors::Count; ++N)
    if (const std::optional<uint16_t> Register = Was.registerOf(N))
      vmovdqa32(Zmm(N), ptr[rdi + *Register]);
}

Label &Emitter::toInterpreter() {
  if (!ToInterpreter)
    ToInterpreter = &Lasting.emplace_back();
  return *ToInterpreter;
}

void Emitter::outOfLine(std::function<void()> Write) {
  Later.push_back(
      [this, Used = Scratches, Was = Held, Write = std::move(Write)] {
        Scratches = Used;
        Held = Was;
        Write();
      });
}

Handler Emitter::original(const Insn *I, Op O) const {
  if (I == Code.begin() + Code.count())
    return Exec.NoFetch[Full];
  return Exec.Handlers[static_cast<unsigned>(O)][Full];
}

//===----------------------------------------------------------------------===//
// Counting
//===----------------------------------------------------------------------===//

void Emitter::addPending() {
  if (Pending.Insns)
    add(r8, Pending.Insns);
  if (Pending.Loads)
    add(rbx, Pending.Loads);
  if (Pending.Stores)
    add(rbp, Pending.Stores);
}

void Emitter::countPending() {
  addPending();
  Pending = {};
}

/// The same with the present instruction, on one way out of several.
void Emitter::addPresent() {
  const auto Before = Pending;
  ++Pending.Insns;
  addPending();
  Pending = Before;
}

/// What r8 has more than r9 was executed by the lanes of now.
void Emitter::countLanes() {
  mov(rcx, r8);
  sub(rcx, r9);
  popcnt(edx, dword[rdi + VORION_PLACE(Mask)]);
  imul(rcx, rdx);
  add(qword[rdi + VORION_PLACE(Count.LaneInstructions)], rcx);
}

//===----------------------------------------------------------------------===//
// Ways in and out
//===----------------------------------------------------------------------===//

void Emitter::writeEntries() {
  for (const GuestInsn &G : Region) {
    if (!G.Enters)
      continue;
    align(16);
    Entries.push_back({G.I, Full, getSize()});
    if (Rounds) {
      Label Nearest;
      cmp(dword[rdi + VORION_PLACE(Frm)], 0);
      je(Nearest);
      mov(rax, reinterpret_cast<uint64_t>(original(G.I, G.Opcode)));
      jmp(rax);
      L(Nearest);
    }
    if (const auto At = OneLane.Entries.find(G.I);
        !Full && At != OneLane.Entries.end()) {
      cmp(dword[rdi + VORION_PLACE(LaneCount)], 1);
      je(At->second);
    }
    lea(rcx, ptr[rip + Labels[Full][G.I]]);
    jmp(*Prologue);
  }
  L(*Prologue);
  mov(r9, ptr[rdi + VORION_PLACE(Count.WarpInstructions)]);
  mov(r10, ptr[rdi + VORION_PLACE(RetireLimit)]);
  for (const Reg64 &Kept : KeptRegisters)
    push(Kept);
  xor_(ebx, ebx);
  xor_(ebp, ebp);
  // The straight line up to here.
  static_assert(sizeof(Insn) == 32);
  sub(rsi, rdx);
  sar(rsi, 5);
  lea(r8, ptr[r9 + rsi]);
  if (!Full && isWide()) { // else k1 is MaskWords, which is there
    mov(eax, dword[rdi + VORION_PLACE(Mask)]);
    keepLanes();
  }
  for (unsigned R = 0; R != NumRegisters; ++R)
    if (Zmms[R] >= 0)
      vmovdqa32(Zmm(Zmms[R]), ptr[rdi + R * sizeof(LaneWords)]);
  mov(rsi, ptr[rdi + VORION_PLACE(Mem)]);
  mov(r13d, dword[rsi + InGlobal + RegionLo]);
  mov(r14d, dword[rsi + InGlobal + RegionBytes]);
  sub(r14d, static_cast<uint32_t>(sizeof(LaneWords)));
  mov(r15, ptr[rsi + InGlobal + RegionHost]);
  if (KeepsStackLine) {
    push(rcx);
    call(FindOwnStack);
    pop(rcx);
  }
  jmp(rcx);
}

void Emitter::storeRegisters() {
  for (unsigned R = 0; R != NumRegisters; ++R)
    if (Zmms[R] >= 0 && Written[R])
      vmovdqa32(ptr[rdi + R * sizeof(LaneWords)], Zmm(Zmms[R]));
  mov(ptr[rdi + VORION_PLACE(Count.WarpInstructions)], r8);
  countLanes();
  storeLanes();
  add(qword[rdi + VORION_PLACE(Count.Loads)], rbx);
  add(qword[rdi + VORION_PLACE(Count.Stores)], rbp);
  // Older hosts take long for code without AVX while upper halves are in use.
  vzeroupper();
  for (const Reg64 &Kept : KeptRegisters | std::views::reverse)
    pop(Kept);
}

void Emitter::writeExits() {
  // To the handler rax with the instruction rsi, from which on is counted.
  L(*Leave);
  storeRegisters();
  mov(rdx, rsi);
  jmp(rax);
  // The warp stops in front of rsi.
  L(*Return);
  storeRegisters();
  mov(ptr[rdi + VORION_PLACE(Next)], rsi);
  ret();
}

/// On at \p To with WarpState::Full of \p Mode, in the region or by the handler
/// that it has at present.
void Emitter::resumeAt(const Insn *To, unsigned Mode) {
  if (const auto At = Labels[Mode].find(To); At != Labels[Mode].end())
    return jmp(At->second);
  mov(rsi, reinterpret_cast<uint64_t>(To));
  mov(rax, ptr[rsi + (Mode ? sizeof(Handler) : 0)]);
  jmp(*Leave);
}

//===----------------------------------------------------------------------===//
// Instructions
//===----------------------------------------------------------------------===//

namespace {

/// Whether vectors hold behind it what they hold in front: what it has out of
/// line sees to that.
bool keepsVectors(Kind Is) {
  switch (Is) {
  case Kind::Integer:
  case Kind::Float:
  case Kind::Load:
  case Kind::Store:
  case Kind::Branch:
  case Kind::Fence:
    return true;
  default:
    return false;
  }
}

} // namespace

/// Keeps in k5 what \p G, a comparison, has in k2, if a split or predicate of
/// its result is near: hosts take several cycles to make words of a mask and a
/// mask of words, and the jumps there wait for it.
void Emitter::keepTest(const GuestInsn &G) {
  constexpr size_t Near = 4;
  const GuestInsn *End = Region.data() + Region.size();
  for (const GuestInsn *At = &G + 1; At != End && !At->Leads; ++At) {
    if (At->I != G.I + (At - &G) || static_cast<size_t>(At - &G) > Near)
      return;
    if (At->Is == Kind::Lanes && At->Opcode != Op::VX_JOIN &&
        At->I->Rs1 == G.I->Rd) {
      copy(k5, k2);
      Tested = G.I->Rd;
      return;
    }
    if (!keepsVectors(At->Is) || At->I->Rd == G.I->Rd)
      return;
  }
}

void Emitter::writeInsn(const GuestInsn &G) {
  Scratches = isWide() ? 0 : HeldVectors::Count;
  Held.endInstruction();
  if (!keepsVectors(G.Is))
    Held.forget();
  ToInterpreter = nullptr;
  const auto Before = Pending;
  switch (G.Is) {
  case Kind::Integer:
    integer(G);
    break;
  case Kind::Float:
    floating(G);
    break;
  case Kind::Load:
    load(G);
    break;
  case Kind::Store:
    store(G);
    break;
  case Kind::Atomic:
    atomic(G);
    break;
  case Kind::Branch:
    writeBranch(G);
    break;
  case Kind::Lanes:
    lanes(G);
    break;
  case Kind::Vote:
    vote(G);
    break;
  case Kind::Shuffle:
    shuffle(G);
    break;
  case Kind::Barrier:
    barrier(G);
    break;
  case Kind::Fence: // what the host keeps in order without a word
    break;
  case Kind::Jump:
    writeJump(G);
    return;
  case Kind::Indirect:
    writeIndirect(G);
    break;
  case Kind::Other:
    jmp(toInterpreter());
    break;
  }
  if (!keepsVectors(G.Is)) {
    Held.forget();
    Tested.reset();
  }
  followStackPointer(G);
  ++Pending.Insns;
  if (ToInterpreter)
    outOfLine([this, &G, Before, At = ToInterpreter] {
      L(*At);
      Pending = Before;
      countPending();
      mov(rsi, reinterpret_cast<uint64_t>(G.I));
      mov(rax, reinterpret_cast<uint64_t>(original(G.I, G.Opcode)));
      jmp(*Leave);
    });
  if (G.Is == Kind::Other || G.Is == Kind::Indirect)
    Pending = {};
}

void Emitter::writeMode(unsigned Mode) {
  Full = Mode != 0;
  Pending = {};
  Leave.emplace();
  Return.emplace();
  Prologue.emplace();
  writeEntries();
  for (size_t N = 0; N != Region.size(); ++N) {
    const GuestInsn &G = Region[N];
    if (G.Leads) {
      countPending();
      L(Labels[Full][G.I]);
      Held.forget();
      Tested.reset();
    }
    writeInsn(G);
    const bool Falls = N + 1 != Region.size() && Region[N + 1].I == G.I + 1;
    const bool Goes =
        G.Is == Kind::Other || G.Is == Kind::Jump || G.Is == Kind::Indirect;
    if (!Falls && !Goes) {
      countPending();
      resumeAt(G.I + 1, Full);
    }
    if (!Falls || Goes)
      Pending = {};
  }
  // What is out of line may have more of it.
  IsOutOfLine = true;
  for (size_t N = 0; N != Later.size(); ++N) {
    const std::function<void()> Write = Later[N];
    Write();
  }
  IsOutOfLine = false;
  Later.clear();
  Held.forget();
  writeAtomics();
  writeAtLimit();
  writeExits();
}

void Emitter::write() {
  for (auto &OfMode : Labels)
    for (const GuestInsn &G : Region)
      if (G.Leads)
        OfMode.emplace(G.I, Label());
  for (const unsigned Mode : {1U, 0U})
    writeMode(Mode);
  writeFinders();
  writeStackFinders();
  writeTables();
  writeConstants();
}

} // namespace vorion::isasim::translate
