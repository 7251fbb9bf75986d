#include "fuzz/Targets.h"

#include "core/Isa.h"
#include "testing/Instructions.h"
#include "testing/Operations.h"
#include "translate/Translator.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Observer.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

namespace vorion::isasim::fuzz {

namespace {

using testing::encode;
using testing::loadConstant;

constexpr uint64_t GlobalBytes = 64 << 10;
constexpr uint64_t MaxInstructions = 6000;
constexpr size_t MaxWords = 1024;
constexpr unsigned Seeded = 13; ///< the register with the input's first word
/// How often the input is executed, unless it says otherwise itself, so that
/// translations of it are used; and the register that counts.
constexpr unsigned Repetitions = 8, Counter = 31;
/// Where the registers of each core lie at the end, in global memory.
constexpr uint32_t LeftAt = 32 << 10, LeftBytes = 8 << 10;
constexpr unsigned LineBytes = 64;

Config shape() {
  Config C;
  C.Clusters = C.SocketsPerCluster = 1;
  C.CoresPerSocket = 2;
  C.WarpsPerCore = 2;
  C.GlobalBytes = GlobalBytes;
  C.LocalBytes = 8 << 10;
  C.StackBytes = 4 << 10;
  C.Quantum = 1 << 7; // translations are made between two turns
  C.MaxInstructions = MaxInstructions;
  C.HostThreads = 1;
  return C;
}

/// All lanes on, and registers from which instructions reach something: lane
/// and core numbers, pointers by lane into each kind of memory and just before
/// its end, noise, floats.
std::vector<uint32_t> prologue(uint32_t First) {
  std::vector<uint32_t> Code;
  loadConstant(Code, 5, 0xFFFF);
  Code.push_back(encode(Op::VX_TMC, {.Rs1 = 5}));
  loadConstant(Code, 5, 0xFFFF);
  Code.push_back(encode(Op::RV_CSRRS, {.Rd = 6, .Csr = CSR_THREAD_ID}));
  Code.push_back(encode(Op::RV_CSRRS, {.Rd = 7, .Csr = CSR_CORE_ID}));
  const uint32_t StackBytes = shape().StackBytes;
  const uint32_t Pointers[] = {
      VX_GLOBAL_BASE,
      VX_LOCAL_BASE,
      VX_IMAGE_BASE,
      VX_STACK_TOP - 20 * StackBytes,
      static_cast<uint32_t>(VX_GLOBAL_BASE + GlobalBytes) - 56,
  };
  for (unsigned N = 0; N != std::size(Pointers); ++N) {
    loadConstant(Code, 8 + N, Pointers[N]);
    Code.push_back(
        encode(Op::RV_SH2ADD, {.Rd = 8 + N, .Rs1 = 6, .Rs2 = 8 + N}));
  }
  loadConstant(Code, Seeded, First);
  loadConstant(Code, 14, 0x9E3779B9);
  Code.push_back(encode(Op::RV_MUL, {.Rd = 15, .Rs1 = 14, .Rs2 = 6}));
  // The stack of the lane itself.
  Code.push_back(encode(Op::RV_CSRRS, {.Rd = 16, .Csr = CSR_MHARTID}));
  loadConstant(Code, 17, StackBytes);
  Code.push_back(encode(Op::RV_MUL, {.Rd = 16, .Rs1 = 16, .Rs2 = 17}));
  loadConstant(Code, 2, VX_STACK_TOP);
  Code.push_back(encode(Op::RV_SUB, {.Rd = 2, .Rs1 = 2, .Rs2 = 16}));
  for (unsigned N = 0; N != 8; ++N) {
    Code.push_back(encode(Op::RV_FCVT_S_W, {.Rd = N, .Rs1 = 5 + N}));
    Code.push_back(encode(Op::RV_FMV_W_X, {.Rd = 8 + N, .Rs1 = 8 + N}));
  }
  loadConstant(Code, Counter, Repetitions);
  return Code;
}

/// Back to \p Begin as often as it is wanted. Then the registers of active
/// lanes go to memory, all but those that this needs, and all lanes end.
void finish(std::vector<uint32_t> &Code, size_t Begin) {
  constexpr unsigned At = 30, Number = 29, Floats = 32 * LineBytes;
  const auto To = [&Code](size_t Target) {
    return 4 *
           (static_cast<int32_t>(Target) - static_cast<int32_t>(Code.size()));
  };
  Code.push_back(
      encode(Op::RV_ADDI, {.Rd = Counter, .Rs1 = Counter, .Imm = -1}));
  Code.push_back(encode(Op::RV_BEQ, {.Rs1 = Counter, .Imm = 8}));
  Code.push_back(encode(Op::RV_JAL, {.Imm = To(Begin)}));
  Code.push_back(encode(Op::RV_CSRRS, {.Rd = Number, .Csr = CSR_CORE_ID}));
  loadConstant(Code, At, LeftBytes);
  Code.push_back(encode(Op::RV_MUL, {.Rd = Number, .Rs1 = Number, .Rs2 = At}));
  loadConstant(Code, At, VX_GLOBAL_BASE + LeftAt);
  Code.push_back(encode(Op::RV_ADD, {.Rd = At, .Rs1 = At, .Rs2 = Number}));
  Code.push_back(encode(Op::RV_CSRRS, {.Rd = Number, .Csr = CSR_THREAD_ID}));
  Code.push_back(encode(Op::RV_SH2ADD, {.Rd = At, .Rs1 = Number, .Rs2 = At}));
  Code.push_back(encode(Op::RV_CSRRS, {.Rd = Number, .Csr = CSR_FFLAGS}));
  for (unsigned N = 0; N != At; ++N)
    Code.push_back(encode(
        Op::RV_SW,
        {.Rs1 = At, .Rs2 = N, .Imm = static_cast<int32_t>(N * LineBytes)}));
  loadConstant(Code, Number, Floats);
  Code.push_back(encode(Op::RV_ADD, {.Rd = At, .Rs1 = At, .Rs2 = Number}));
  for (unsigned N = 0; N != 32; ++N)
    Code.push_back(encode(
        Op::RV_FSW,
        {.Rs1 = At, .Rs2 = N, .Imm = static_cast<int32_t>(N * LineBytes)}));
  Code.push_back(encode(Op::VX_TMC, {.Rs1 = 0}));
}

struct Outcomes {
  RunResult Result;
  std::string Console;
  std::vector<std::byte> Global;
};

Outcomes run(const std::shared_ptr<const Image> &Program, Engine Runs,
             Observer *Watcher = nullptr) {
  Config C = shape();
  C.Runs = Runs;
  auto M = Machine::create(C);
  if (!M) // the host has no memory for it
    std::abort();
  Outcomes O;
  (*M)->setConsole([&](std::string_view Text) { O.Console += Text; });
  if (Watcher)
    (*M)->setObservers({Watcher});
  (*M)->load(Program);
  O.Result = (*M)->run();
  O.Global.resize(GlobalBytes);
  (*M)->read(VX_GLOBAL_BASE, O.Global);
  return O;
}

void requireSame(const Outcomes &Plain, const Outcomes &Other,
                 const char *Name) {
  const auto Require = [Name](bool Holds, const char *What) {
    if (Holds)
      return;
    std::fprintf(stderr, "the run %s differs in its %s\n", Name, What);
    std::abort();
  };
  Require(Plain.Result.End == Other.Result.End, "outcome");
  Require(Plain.Result.Report == Other.Result.Report, "report");
  Require(Plain.Result.ExitCode == Other.Result.ExitCode, "exit code");
  for (const auto &C : CoreCounterTable)
    Require(Plain.Result.Total.*C.Member == Other.Result.Total.*C.Member,
            C.Name);
  Require(Plain.Console == Other.Console, "console");
  Require(Plain.Global == Other.Global, "memory");
}

} // namespace

void execute(std::span<const std::byte> Bytes) {
  uint32_t First = 0;
  const size_t FirstBytes = std::min(sizeof(First), Bytes.size());
  if (FirstBytes) // an empty input may have no address
    std::memcpy(&First, Bytes.data(), FirstBytes);
  Bytes = Bytes.subspan(FirstBytes);
  std::vector<uint32_t> Code = prologue(First);
  const size_t Words = std::min(Bytes.size() / 4, MaxWords);
  const size_t Begin = Code.size();
  Code.resize(Begin + Words);
  if (Words)
    std::memcpy(Code.data() + Begin, Bytes.data(), Words * 4);
  finish(Code, Begin);

  Image::Segment S;
  S.Address = VX_IMAGE_BASE;
  S.MemBytes = static_cast<uint32_t>(Code.size() * 4);
  const auto Raw = std::as_bytes(std::span(Code));
  S.Bytes.assign(Raw.begin(), Raw.end());
  S.Writable = S.Executable = true;
  const auto Program = Image::raw(std::move(S), "fuzz");

  const Outcomes Plain = run(Program, Engine::Interpreter);
  Observer Nothing;
  requireSame(Plain, run(Program, Engine::Interpreter, &Nothing),
              "with an observer");
  if (!Translator::isThere())
    return;
  requireSame(Plain, run(Program, Engine::Translator), "of the translator");
  requireSame(Plain, run(Program, Engine::TranslatorAvx2),
              "of the translator with AVX2");
}

namespace {

/// Any instruction, mostly of registers that the prologue has set and with
/// small immediates. Most programs of these end in a trap after a few.
uint32_t anyInsn(std::mt19937 &Random) {
  if (Random() % 16 == 0)
    return static_cast<uint32_t>(Random());
  const Op O = static_cast<Op>(Random() % NumOps);
  testing::Fields F;
  F.Rd = Random() % (Random() % 4 ? 20 : 32);
  F.Rs1 = Random() % (Random() % 4 ? 17 : 32);
  F.Rs2 = Random() % (Random() % 4 ? 17 : 32);
  F.Rs3 = Random() % 32;
  F.Imm = static_cast<int32_t>(Random() % 64) * 4 - 64;
  F.Rm = Random() % 4 ? 7 : Random() % 5;
  F.Csr = CsrTable[Random() % NumCsrs].Number;
  return encode(O, F);
}

/// What neither traps nor jumps, so that all of a program is executed.
uint32_t calmInsn(std::mt19937 &Random) {
  static const std::vector<Op> Calm = testing::computations(),
                               Accesses = testing::accesses();
  testing::Fields F;
  // The prologue's pointers and the counter stay.
  do
    F.Rd = Random() % Counter;
  while (F.Rd == 2 || (F.Rd >= 8 && F.Rd <= 12));
  F.Rs2 = Random() % Counter;
  F.Rs3 = Random() % 32;
  if (Random() % 4 == 0) {
    F.Rs1 = 8 + Random() % 2;
    F.Imm = static_cast<int32_t>(Random() % 8) * 4;
    const Op O = Accesses[Random() % Accesses.size()];
    if (O == Op::RV_AMOCAS_D) { // even registers
      F.Rd = 0;
      F.Rs2 &= ~1U;
    }
    return encode(O, F);
  }
  F.Rs1 = Random() % Counter;
  F.Imm = static_cast<int32_t>(Random() % 4096) - 2048;
  F.Rm = Random() % 4 ? 7 : Random() % 5;
  return encode(Calm[Random() % Calm.size()], F);
}

/// Some of it by a part of the lanes, which is split off and joined.
std::vector<uint32_t> calmProgram(std::mt19937 &Random) {
  constexpr unsigned Predicate = 28, Depth = 27;
  std::vector<uint32_t> Words;
  for (auto Left = Random() % 40 + 1; Left; --Left) {
    Words.push_back(calmInsn(Random));
    if (Random() % 8)
      continue;
    const unsigned Length = Random() % 4 + 1;
    Words.push_back(
        encode(Op::RV_ANDI, {.Rd = Predicate,
                             .Rs1 = static_cast<unsigned>(Random() % 27),
                             .Imm = 1}));
    Words.push_back(encode(Op::VX_SPLIT, {.Rd = Depth, .Rs1 = Predicate}));
    Words.push_back(
        encode(Op::RV_BEQ, {.Rs1 = Predicate,
                            .Imm = 4 * static_cast<int32_t>(Length + 1)}));
    for (unsigned N = 0; N != Length;) {
      const uint32_t Word = calmInsn(Random);
      if (decode(Word)->Rd == Depth)
        continue;
      Words.push_back(Word);
      ++N;
    }
    Words.push_back(encode(Op::VX_JOIN, {.Rs1 = Depth}));
  }
  return Words;
}

} // namespace

std::vector<std::vector<std::byte>> programSeeds(unsigned Count,
                                                 unsigned Seed) {
  std::mt19937 Random(Seed);
  std::vector<std::vector<std::byte>> Seeds;
  for (unsigned N = 0; N != Count; ++N) {
    std::vector<uint32_t> Words = {static_cast<uint32_t>(Random())};
    if (N % 2)
      for (const uint32_t Word : calmProgram(Random))
        Words.push_back(Word);
    else
      for (auto Left = Random() % 40 + 1; Left; --Left)
        Words.push_back(anyInsn(Random));
    const auto Raw = std::as_bytes(std::span(Words));
    Seeds.emplace_back(Raw.begin(), Raw.end());
  }
  return Seeds;
}

} // namespace vorion::isasim::fuzz
