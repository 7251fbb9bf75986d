// Jumps, calls and returns. A jump compares what has been executed with the end
// of the warp's turn, as the interpreter does.

#include "translate/Emitter.h"
#include "translate/Places.h"

#include <algorithm>

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

namespace {

/// Instructions in front of the return of a function that is written at each of
/// its calls. Those of the mathematical library around one instruction of the
/// machine are meant.
constexpr size_t LongestLeaf = 8;

/// Instructions that one lane has executed alone before it is worth the way to
/// its own code and back, which is some hundred cycles.
constexpr int WorthOneLane = 64;

} // namespace

/// Behind a jump to \p Next that has been counted.
void Emitter::stopIfEnough(const Insn *Next) {
  Label Enough, Back;
  cmp(r8, r10);
  jae(Enough);
  L(Back);
  outOfLine([this, Enough, Back, Next]() mutable {
    L(Enough);
    mov(rsi, reinterpret_cast<uint64_t>(Next));
    if (OneLane.Entries.empty())
      return jmp(*Return);
    lea(rcx, ptr[rip + Back]);
    if (const auto At = OneLane.Entries.find(Next);
        !Full && At != OneLane.Entries.end())
      lea(rax, ptr[rip + At->second]);
    else
      xor_(eax, eax);
    jmp(AtLimit[Full]);
  });
}

/// Where r8 has reached r10 in front of rsi: on at rcx unless the turn has
/// ended, or at rax, the code for one lane, if there is that and one lane alone
/// is active.
void Emitter::writeAtLimit() {
  if (OneLane.Entries.empty())
    return;
  Label Stays;
  L(AtLimit[Full]);
  cmp(r8, ptr[rdi + VORION_PLACE(RetireLimit)]);
  jae(*Return);
  if (!Full) {
    mov(edx, dword[rdi + VORION_PLACE(Mask)]);
    blsr(edx, edx);
    jnz(Stays);
    test(rax, rax);
    jnz(*Leave);
    jmp(rcx);
    L(Stays);
  }
  mov(r10, ptr[rdi + VORION_PLACE(RetireLimit)]);
  jmp(rcx);
}

/// Lets jumps look for the code for one lane after some instructions from here
/// on, where the lanes have changed. Overwrites rcx.
void Emitter::limitStretch() {
  if (OneLane.Entries.empty())
    return;
  mov(r10, ptr[rdi + VORION_PLACE(RetireLimit)]);
  lea(rcx, ptr[r8 + WorthOneLane]);
  cmp(r10, rcx);
  cmova(r10, rcx);
}

/// A jump that has been counted goes to \p To, unless the warp has executed
/// enough.
void Emitter::goTo(const Insn *To) {
  stopIfEnough(To);
  resumeAt(To, Full);
}

/// What \p Call calls up to its return, if that is short and straight, and
/// keeps the place to return to; else nothing.
std::span<const GuestInsn> Emitter::leafOf(const GuestInsn &Call) const {
  const Insn *I = Call.I;
  if (isSink(I->Rd) || I + 1 == Code.begin() + Code.count())
    return {};
  const Insn *Target = I + (I->Imm >> 2);
  const auto First =
      std::ranges::lower_bound(Region, Target, {}, &GuestInsn::I);
  for (auto At = First; At != Region.end(); ++At) {
    const auto Length = static_cast<size_t>(At - First);
    if (At->I != Target + Length)
      return {};
    switch (At->Is) {
    case Kind::Indirect:
      if (!isSink(At->I->Rd) || At->I->Rs1 != I->Rd || At->I->Imm != 0)
        return {};
      return {First, At};
    case Kind::Integer:
    case Kind::Float:
    case Kind::Load:
    case Kind::Store:
      if (At->I->Rd == I->Rd || Length == LongestLeaf)
        return {};
      break;
    default:
      return {};
    }
  }
  return {};
}

void Emitter::writeJump(const GuestInsn &G) {
  const Insn *I = G.I;
  const auto Number = static_cast<uint32_t>(I - Code.begin());
  if (!isSink(I->Rd))
    result(I->Rd, [&](const Zmm &To) {
      vpbroadcastd(To, number(Code.low() + 4 * (Number + 1)));
    });
  ++Pending.Insns;
  countPending();
  const Insn *Target = I + (I->Imm >> 2);
  const std::span<const GuestInsn> Leaf = leafOf(G);
  if (Leaf.empty())
    return goTo(Target);
  stopIfEnough(Target);
  for (const GuestInsn &Inner : Leaf)
    writeInsn(Inner);
  ++Pending.Insns;
  countPending();
  stopIfEnough(I + 1);
  const GuestInsn *Next = &G + 1;
  if (Next == Region.data() + Region.size() || Next->I != I + 1)
    resumeAt(I + 1, Full);
}

void Emitter::writeIndirect(const GuestInsn &G) {
  const Insn *I = G.I;
  Label &Wrong = toInterpreter();
  const Zmm Targets = scratch(), Spread = scratch();
  vpandd(Targets, addressesOf(I), constant(~1U));
  jumpIfApart(Targets, Spread, Wrong);
  test(al, 2);
  jnz(Wrong);
  sub(eax, Code.low());
  shr(eax, 2);
  cmp(eax, Code.count());
  jae(Wrong);
  const auto Number = static_cast<uint32_t>(I - Code.begin());
  if (!isSink(I->Rd))
    result(I->Rd, [&](const Zmm &To) {
      vpbroadcastd(To, number(Code.low() + 4 * (Number + 1)));
    });
  addPresent();
  static_assert(sizeof(Insn) == 32);
  mov(ecx, eax);
  shl(rcx, 5);
  mov(rsi, reinterpret_cast<uint64_t>(Code.begin()));
  add(rsi, rcx);
  Label Goes, Outside;
  cmp(r8, r10);
  jb(Goes);
  cmp(r8, ptr[rdi + VORION_PLACE(RetireLimit)]);
  jae(*Return);
  L(Goes);
  // In the region, if the table says so.
  const auto First = static_cast<uint32_t>(Region.front().I - Code.begin());
  const auto Last = static_cast<uint32_t>(Region.back().I - Code.begin());
  sub(eax, First);
  cmp(eax, Last - First);
  ja(Outside);
  lea(rdx, ptr[rip + Tables[Full]]);
  movsxd(rax, dword[rdx + rax * 4]);
  test(rax, rax);
  jz(Outside);
  add(rax, rdx);
  jmp(rax);
  L(Outside);
  mov(rax, ptr[rsi + (Full ? sizeof(Handler) : 0)]);
  jmp(*Leave);
}

/// Offsets of labels from their table on; 0 for what has none.
void Emitter::writeTables() {
  if (std::ranges::none_of(
          Region, [](const GuestInsn &G) { return G.Is == Kind::Indirect; }))
    return;
  for (const unsigned Mode : {1U, 0U}) {
    align(4);
    L(Tables[Mode]);
    const uint8_t *From = Tables[Mode].getAddress();
    for (const Insn *I = Region.front().I; I <= Region.back().I; ++I) {
      const auto At = Labels[Mode].find(I);
      dd(At == Labels[Mode].end()
             ? 0
             : static_cast<uint32_t>(At->second.getAddress() - From));
    }
  }
}

} // namespace vorion::isasim::translate
