#include "fuzz/Targets.h"

#include "core/Isa.h"
#include "testing/Encode.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Observer.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

namespace vorion::isasim::fuzz {

namespace {

using testing::encode;

constexpr uint64_t GlobalBytes = 64 << 10;
constexpr uint64_t MaxInstructions = 6000;
constexpr size_t MaxWords = 1024;
constexpr unsigned Seeded = 13; ///< the register with the input's first word

Config shape() {
  Config C;
  C.Clusters = C.SocketsPerCluster = 1;
  C.CoresPerSocket = 2;
  C.WarpsPerCore = 2;
  C.GlobalBytes = GlobalBytes;
  C.LocalBytes = 8 << 10;
  C.StackBytes = 4 << 10;
  C.Quantum = 1 << 10;
  C.MaxInstructions = MaxInstructions;
  C.HostThreads = 1;
  return C;
}

void loadConstant(std::vector<uint32_t> &To, unsigned Rd, uint32_t Value) {
  To.push_back(
      encode(Op::RV_LUI,
             {.Rd = Rd, .Imm = static_cast<int32_t>((Value + 0x800) >> 12)}));
  To.push_back(encode(
      Op::RV_ADDI,
      {.Rd = Rd, .Rs1 = Rd, .Imm = static_cast<int32_t>(Value << 20) >> 20}));
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
  return Code;
}

struct Outcomes {
  RunResult Result;
  std::string Console;
  std::vector<std::byte> Global;
};

Outcomes run(const std::shared_ptr<const Image> &Program, Observer *Watcher) {
  auto M = Machine::create(shape());
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

void require(bool Holds, const char *What) {
  if (Holds)
    return;
  std::fprintf(stderr, "the observed run differs in its %s\n", What);
  std::abort();
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
  Code.push_back(encode(Op::VX_TMC, {.Rs1 = 0}));

  Image::Segment S;
  S.Address = VX_IMAGE_BASE;
  S.MemBytes = static_cast<uint32_t>(Code.size() * 4);
  const auto Raw = std::as_bytes(std::span(Code));
  S.Bytes.assign(Raw.begin(), Raw.end());
  S.Writable = S.Executable = true;
  const auto Program = Image::raw(std::move(S), "fuzz");

  const Outcomes Plain = run(Program, nullptr);
  Observer Nothing;
  const Outcomes Observed = run(Program, &Nothing);
  require(Plain.Result.End == Observed.Result.End, "outcome");
  require(Plain.Result.Report == Observed.Result.Report, "report");
  require(Plain.Result.ExitCode == Observed.Result.ExitCode, "exit code");
  require(Plain.Result.Total.WarpInstructions ==
                  Observed.Result.Total.WarpInstructions &&
              Plain.Result.Total.LaneInstructions ==
                  Observed.Result.Total.LaneInstructions,
          "counters");
  require(Plain.Console == Observed.Console, "console");
  require(Plain.Global == Observed.Global, "memory");
}

std::vector<std::vector<std::byte>> programSeeds(unsigned Count,
                                                 unsigned Seed) {
  std::mt19937 Random(Seed);
  std::vector<std::vector<std::byte>> Seeds;
  for (unsigned N = 0; N != Count; ++N) {
    std::vector<uint32_t> Words = {static_cast<uint32_t>(Random())};
    for (auto Left = Random() % 40 + 1; Left; --Left) {
      if (Random() % 16 == 0) { // anything
        Words.push_back(static_cast<uint32_t>(Random()));
        continue;
      }
      const Op O = static_cast<Op>(Random() % NumOps);
      testing::Fields F;
      // Mostly registers that the prologue has set, and small immediates.
      F.Rd = Random() % (Random() % 4 ? 20 : 32);
      F.Rs1 = Random() % (Random() % 4 ? 17 : 32);
      F.Rs2 = Random() % (Random() % 4 ? 17 : 32);
      F.Rs3 = Random() % 32;
      F.Imm = static_cast<int32_t>(Random() % 64) * 4 - 64;
      F.Rm = Random() % 4 ? 7 : Random() % 5;
      F.Csr = CsrTable[Random() % NumCsrs].Number;
      Words.push_back(encode(O, F));
    }
    const auto Raw = std::as_bytes(std::span(Words));
    Seeds.emplace_back(Raw.begin(), Raw.end());
  }
  return Seeds;
}

} // namespace vorion::isasim::fuzz
