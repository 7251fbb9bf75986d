// What lanes have to do with each other. At splits, joins and predicates the
// two versions of a region go over into each other.

#include "translate/Places.h"
#include "translate/Value.h"

#include <algorithm>
#include <cstdlib>

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

namespace {

const int MaskPlace = VORION_PLACE(Mask);
const int DepthPlace = VORION_PLACE(StackDepth);
const int TopMask = offsetof(Divergence, Mask),
          TopOther = offsetof(Divergence, Other),
          TopPc = offsetof(Divergence, Pc);

/// Sides of splits that a join looks for itself.
constexpr size_t MostSides = 8;

} // namespace

/// The last active lane's word of \p From in every lane of \p To, and in eax.
void Emitter::spreadLast(const Zmm &To, const Zmm &From) {
  bsr(eax, dword[rdi + MaskPlace]);
  spreadLane(To, From, eax);
}

/// eax becomes the word of the last active lane.
void Emitter::lastLane(uint16_t Register) {
  if (!isWide() && Register != XBase) {
    bsr(eax, dword[rdi + MaskPlace]);
    return mov(eax, dword[rdi + rax * 4 + Register]);
  }
  const Term From = guest(Register);
  if (From.isNumber())
    return mov(eax, From.Bits);
  const Zmm To = scratch();
  spreadLast(To, Zmm(From.Zmm));
}

/// In the mode of the active lanes eax.
void Emitter::resumeAtEither(const Insn *To) {
  Label NotFull;
  cmp(eax, AllBits);
  jne(NotFull);
  resumeAt(To, 1);
  L(NotFull);
  resumeAt(To, 0);
}

/// Counts up to and with the present instruction; then the lanes of eax, which
/// is not 0, are the active ones. What else the interpreter keeps of them is
/// brought up to date when it goes on. With AVX-512 k2 has them, too, if \p
/// AreInMask. Overwrites rcx and rdx.
void Emitter::changeLanes(bool AreInMask) {
  addPresent();
  countLanes();
  mov(r9, r8);
  mov(dword[rdi + MaskPlace], eax);
  limitStretch();
  keepLanes(AreInMask);
}

/// Keeps the lanes of eax, and the first one, where instructions look for them.
/// Overwrites rdx.
void Emitter::keepLanes(bool AreInMask) {
  isWide() && AreInMask ? copy(k1, k2) : kmovw(k1, eax);
  if (!isWide())
    return;
  bsf(edx, eax);
  vpbroadcastd(Zmm(FirstLaneZmm), edx);
}

/// What setMask() of Warps.h computes from the mask.
void Emitter::storeLanes() {
  mov(ecx, dword[rdi + MaskPlace]);
  popcnt(edx, ecx);
  mov(dword[rdi + VORION_PLACE(LaneCount)], edx);
  bsr(edx, ecx);
  mov(dword[rdi + VORION_PLACE(LastLane)], edx);
  xor_(edx, edx);
  cmp(ecx, AllBits);
  sete(dl);
  mov(dword[rdi + VORION_PLACE(Full)], edx);
  if (!isWide())
    return; // k1 is MaskWords
  kmovw(k1, ecx);
  vpmovm2d(zmm0, k1);
  vmovdqa32(ptr[rdi + VORION_PLACE(MaskWords)], zmm0);
}

/// eax, and with AVX-512 k2, become the active lanes whose predicate is set, in
/// \p Register.
void Emitter::predicateOf(uint16_t Register, bool IsNegated) {
  if (Tested != Register)
    return oddLanes(eax, inZmm(guest(Register)), IsNegated, isFull());
  if (!IsNegated)
    copy(k2, k5);
  else
    isFull() ? knotw(k2, k5) : kandnw(k2, k5, k1);
  kmovw(eax, k2);
}

void Emitter::split(const GuestInsn &G, bool IsNegated) {
  const Insn *I = G.I;
  Label &Wrong = toInterpreter();
  Label Uniform;
  predicateOf(I->Rs1, IsNegated);
  mov(ecx, dword[rdi + MaskPlace]);
  xor_(ecx, eax); // the others
  jz(Uniform);
  test(eax, eax);
  jz(Uniform);
  mov(edx, dword[rdi + DepthPlace]);
  cmp(edx, dword[rdi + VORION_PLACE(StackLimit)]);
  je(Wrong);
  inc(qword[rdi + VORION_PLACE(Count.Splits)]);
  inc(qword[rdi + VORION_PLACE(Count.DivergentSplits)]);
  result(I->Rd, [&](const Zmm &To) { vpbroadcastd(To, edx); });
  static_assert(sizeof(Divergence) == 16);
  shl(rdx, 4);
  add(rdx, ptr[rdi + VORION_PLACE(Stack)]);
  mov(dword[rdx + TopOther], ecx);
  xor_(ecx, eax);
  mov(dword[rdx + TopMask], ecx);
  mov(rcx, reinterpret_cast<uint64_t>(I + 1));
  mov(ptr[rdx + TopPc], rcx);
  inc(dword[rdi + DepthPlace]);
  changeLanes(true);
  resumeAt(I + 1, 0);
  Held.forget();
  L(Uniform);
  inc(qword[rdi + VORION_PLACE(Count.Splits)]);
  result(I->Rd,
         [&](const Zmm &To) { vpbroadcastd(To, dword[rdi + DepthPlace]); });
}

void Emitter::join(const GuestInsn &G) {
  const Insn *I = G.I;
  Label &Wrong = toInterpreter();
  Label Uniform, Both;
  lastLane(I->Rs1);
  mov(edx, dword[rdi + DepthPlace]);
  cmp(eax, edx);
  je(Uniform);
  test(edx, edx);
  jz(Wrong);
  dec(edx);
  shl(rdx, 4);
  add(rdx, ptr[rdi + VORION_PLACE(Stack)]);
  mov(rsi, rdx);
  mov(eax, dword[rsi + TopOther]);
  test(eax, eax);
  jz(Both);
  // The other side's turn.
  mov(dword[rsi + TopOther], 0);
  mov(r11, ptr[rsi + TopPc]);
  changeLanes();
  mov(rsi, r11);
  cmp(r8, r10);
  jae(*Return);
  std::vector<const Insn *> Sides;
  for (const GuestInsn &Other : Region)
    if (Other.Opcode == Op::VX_SPLIT || Other.Opcode == Op::VX_SPLIT_N)
      Sides.push_back(Other.I + 1);
  std::ranges::sort(Sides, {},
                    [I](const Insn *Side) { return std::abs(Side - I); });
  Sides.resize(std::min(Sides.size(), MostSides));
  for (const Insn *Side : Sides)
    if (const auto At = Labels[0].find(Side); At != Labels[0].end()) {
      mov(rax, reinterpret_cast<uint64_t>(Side));
      cmp(rsi, rax);
      je(At->second);
    }
  mov(rax, ptr[rsi]);
  jmp(*Leave);
  L(Both);
  mov(eax, dword[rsi + TopMask]);
  dec(dword[rdi + DepthPlace]);
  changeLanes();
  resumeAtEither(I + 1);
  L(Uniform);
}

void Emitter::predicate(const GuestInsn &G, bool IsNegated) {
  const Insn *I = G.I;
  Label &Wrong = toInterpreter();
  Label None, Fewer;
  predicateOf(I->Rs1, IsNegated);
  test(eax, eax);
  jz(None);
  isFull() ? cmp(eax, AllBits) : cmp(eax, dword[rdi + MaskPlace]);
  jne(Fewer);
  inc(qword[rdi + VORION_PLACE(Count.Splits)]);
  outOfLine([=, this, &Wrong, Before = Pending]() mutable {
    Label Others;
    Pending = Before;
    // Some lanes stay.
    L(Fewer);
    inc(qword[rdi + VORION_PLACE(Count.Splits)]);
    inc(qword[rdi + VORION_PLACE(Count.DivergentSplits)]);
    changeLanes(true);
    resumeAt(I + 1, 0);
    L(None);
    lastLane(I->Rs2);
    and_(eax, dword[rdi + VORION_PLACE(AllLanes)]);
    jz(Wrong);
    inc(qword[rdi + VORION_PLACE(Count.Splits)]);
    mov(ecx, dword[rdi + MaskPlace]);
    cmp(eax, ecx);
    je(Others);
    not_(ecx);
    test(eax, ecx);
    jnz(Others);
    inc(qword[rdi + VORION_PLACE(Count.DivergentSplits)]);
    L(Others);
    changeLanes();
    resumeAtEither(I + 1);
  });
}

void Emitter::vote(const GuestInsn &G) {
  const Insn *I = G.I;
  if (isSink(I->Rd))
    return;
  const Zmm A = inZmm(guest(I->Rs1));
  if (G.Opcode == Op::VX_VOTE_UNI) {
    const Zmm Last = scratch();
    spreadLast(Last, A);
    vpcmpeqd(active(k2), A, Last);
  } else
    vptestmd(active(k2), A, A);
  kmovw(eax, k2);
  if (G.Opcode != Op::VX_VOTE_BALLOT) {
    xor_(ecx, ecx);
    if (G.Opcode == Op::VX_VOTE_ANY) {
      test(eax, eax);
      setnz(cl);
    } else {
      cmp(eax, dword[rdi + MaskPlace]);
      sete(cl);
    }
    mov(eax, ecx);
  }
  result(I->Rd, [this](const Zmm &To) { vpbroadcastd(To, eax); });
}

/// As SHUFFLE of core/insns/Simt.inc.
void Emitter::shuffle(const GuestInsn &G) {
  const Insn *I = G.I;
  if (isSink(I->Rd))
    return;
  constexpr uint32_t Field = 63;
  constexpr uint8_t FieldBits = 6;
  const Zmm Values = inZmm(guest(I->Rs1)), Control = inZmm(guest(I->Rs2));
  const Zmm Segment = scratch(), Low = scratch(), High = scratch(),
            From = scratch();
  vpsrld(Segment, Control, 2 * FieldBits);
  vpandd(Segment, Segment, constant(Field));
  vpandd(Low, Segment, laneNumbers(1));
  vpandd(From, Control, constant(Field));
  switch (G.Opcode) {
  case Op::VX_SHFL_UP:
    vmovdqa32(High, laneNumbers(1));
    vpsubd(From, High, From);
    break;
  case Op::VX_SHFL_DOWN:
    vpaddd(From, From, laneNumbers(1));
    break;
  case Op::VX_SHFL_BFLY:
    vpxord(From, From, laneNumbers(1));
    break;
  default:
    vpandnd(From, Segment, From);
    vpord(From, From, Low);
    break;
  }
  if (G.Opcode == Op::VX_SHFL_UP)
    vpcmpd(k2, From, Low, Relation::NotLess);
  else {
    vpsrld(High, Control, FieldBits);
    vpandd(High, High, constant(Field));
    vpandnd(High, Segment, High);
    vpord(High, High, Low);
    vpcmpd(k2, From, High, Relation::LessEqual);
  }
  vpcmpd(k2 | k2, From, constant(MaxLanes), Relation::Less);
  // A lane that is not active gives nothing.
  if (!isFull()) {
    vpmovm2d(High, k1);
    vpermd(High, From, High);
    vptestmd(k2 | k2, High, High);
  }
  vmovdqa32(Low, Values);
  vpermd(Low | k2, From, Values);
  result(I->Rd, [&](const Zmm &To) { vmovdqa32(To, Low); });
}

/// Barrier 0 of a group that is one warp. All others are the interpreter's.
void Emitter::barrier(const GuestInsn &G) {
  constexpr uint32_t NumberBits = (1U << 31) - 1;
  Label &Wrong = toInterpreter();
  lastLane(G.I->Rs2);
  cmp(eax, 1);
  ja(Wrong);
  lastLane(G.I->Rs1);
  test(eax, NumberBits);
  jnz(Wrong);
  mov(eax, dword[rdi + MaskPlace]);
  cmp(eax, dword[rdi + VORION_PLACE(WholeMask)]);
  jne(Wrong);
}

void Emitter::lanes(const GuestInsn &G) {
  switch (G.Opcode) {
  case Op::VX_JOIN:
    return join(G);
  case Op::VX_SPLIT:
  case Op::VX_SPLIT_N:
    return split(G, G.Opcode == Op::VX_SPLIT_N);
  default:
    return predicate(G, G.Opcode == Op::VX_PRED_N);
  }
}

} // namespace vorion::isasim::translate
