/// Who executes a run shows in nothing but its time: limits, traps, observers
/// and programs that take turns on one machine.

#include "testing/ElfBuilder.h"
#include "testing/Encode.h"
#include "testing/HostMappings.h"
#include "translate/Translator.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Observer.h"

#include <gtest/gtest.h>
#include <vector>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr uint32_t Console = 0x40;
constexpr unsigned Lane = 6, Counter = 7, Sum = 8, Place = 9, Token = 10,
                   Odd = 11, One = 12;

/// With turns that are short enough for the engines to change within them.
Config small(Engine Runs) {
  Config C;
  C.Clusters = C.SocketsPerCluster = 1;
  C.CoresPerSocket = 2;
  C.GlobalBytes = 1 << 20;
  C.HostThreads = 1;
  C.Quantum = 500;
  C.Runs = Runs;
  return C;
}

/// All lanes go through a loop whose sides they take apart, add to a word of
/// each lane in global memory, and write a line to the console behind it.
std::vector<uint32_t> loop(int32_t Times) {
  std::vector<uint32_t> Words = {
      encode(Op::RV_LUI, {.Rd = 5, .Imm = 0x10}),
      encode(Op::RV_ADDI, {.Rd = 5, .Rs1 = 5, .Imm = -1}),
      encode(Op::VX_TMC, {.Rs1 = 5}),
      encode(Op::RV_CSRRS, {.Rd = Lane, .Csr = CSR_THREAD_ID}),
      encode(Op::RV_ADDI, {.Rd = Counter, .Imm = Times}),
      encode(Op::RV_LUI,
             {.Rd = Place, .Imm = static_cast<int32_t>(VX_GLOBAL_BASE >> 12)}),
      encode(Op::RV_SH2ADD, {.Rd = Place, .Rs1 = Lane, .Rs2 = Place}),
      encode(Op::RV_ANDI, {.Rd = Odd, .Rs1 = Lane, .Imm = 1}),
  };
  const size_t Begin = Words.size();
  for (int32_t N = 0; N != 12; ++N)
    Words.push_back(encode(Op::RV_ADDI, {.Rd = Sum, .Rs1 = Sum, .Imm = N}));
  Words.push_back(encode(Op::VX_SPLIT, {.Rd = Token, .Rs1 = Odd}));
  Words.push_back(encode(Op::RV_BEQ, {.Rs1 = Odd, .Imm = 8}));
  Words.push_back(encode(Op::RV_ADD, {.Rd = Sum, .Rs1 = Sum, .Rs2 = Lane}));
  Words.push_back(encode(Op::VX_JOIN, {.Rs1 = Token}));
  Words.push_back(encode(Op::RV_SW, {.Rs1 = Place, .Rs2 = Sum}));
  Words.push_back(
      encode(Op::RV_ADDI, {.Rd = Counter, .Rs1 = Counter, .Imm = -1}));
  Words.push_back(
      encode(Op::RV_BNE, {.Rs1 = Counter,
                          .Imm = 4 * (static_cast<int32_t>(Begin) -
                                      static_cast<int32_t>(Words.size()))}));
  Words.push_back(encode(Op::RV_ADDI, {.Rd = One, .Imm = '\n'}));
  Words.push_back(
      encode(Op::RV_ADDI, {.Rd = Place, .Imm = static_cast<int32_t>(Console)}));
  Words.push_back(encode(Op::RV_SW, {.Rs1 = Place, .Rs2 = One}));
  Words.push_back(encode(Op::VX_TMC, {.Rs1 = 0}));
  return Words;
}

struct Outcomes {
  RunResult Result;
  std::vector<std::byte> Global = std::vector<std::byte>(64);
};

Outcomes runOn(Machine &M, const std::shared_ptr<const Image> &Program) {
  Outcomes O;
  M.fill(VX_GLOBAL_BASE, O.Global.size(), std::byte{0});
  M.load(Program);
  O.Result = M.run();
  M.read(VX_GLOBAL_BASE, O.Global);
  return O;
}

void expectSame(const Outcomes &A, const Outcomes &B) {
  EXPECT_EQ(A.Result.End, B.Result.End);
  EXPECT_EQ(A.Result.Report, B.Result.Report);
  for (const auto &C : CoreCounterTable)
    EXPECT_EQ(A.Result.Total.*C.Member, B.Result.Total.*C.Member);
  EXPECT_EQ(A.Global, B.Global);
}

std::unique_ptr<Machine> machine(const Config &C) {
  auto M = Machine::create(C);
  EXPECT_TRUE(M) << M.error().What;
  (*M)->setConsole([](std::string_view) {});
  return std::move(*M);
}

class Engines : public ::testing::TestWithParam<Engine> {
protected:
  void SetUp() override {
    if (!Translator::isThere())
      GTEST_SKIP() << "the translation needs another host";
  }
};

INSTANTIATE_TEST_SUITE_P(
    All, Engines, ::testing::Values(Engine::Translator, Engine::TranslatorAvx2),
    [](const ::testing::TestParamInfo<Engine> &Of) {
      return Of.param == Engine::Translator ? "Translator" : "TranslatorAvx2";
    });

/// Also where the limit is reached in the middle of a translation: a run of the
/// other engine stops at the same instruction, and says so.
TEST_P(Engines, StopAtTheSameLimit) {
  const auto Program = codeImage(loop(200));
  for (uint64_t Limit = 900; Limit != 1100; ++Limit) {
    Config Slow = small(Engine::Interpreter), Fast = small(GetParam());
    Slow.MaxInstructions = Fast.MaxInstructions = Limit;
    const auto A = machine(Slow), B = machine(Fast);
    // The second run of a machine begins with what the first one translated.
    for (const int Run : {1, 2}) {
      const Outcomes Expected = runOn(*A, Program);
      ASSERT_EQ(Expected.Result.End, Outcome::LimitReached);
      expectSame(Expected, runOn(*B, Program));
      ASSERT_FALSE(HasFailure()) << "limit " << Limit << ", run " << Run;
    }
  }
}

/// A run with an observer is the interpreter's, between two that are not.
TEST_P(Engines, GiveObserversTheSame) {
  if (!Machine::canBeObserved())
    GTEST_SKIP() << "this build has no observers";
  const auto Program = codeImage(loop(1000));
  const auto A = machine(small(Engine::Interpreter)),
             B = machine(small(GetParam()));
  Observer Nothing;
  for (const bool IsObserved : {false, true, false, true}) {
    for (const auto *M : {&A, &B})
      (*M)->setObservers(IsObserved ? std::vector<Observer *>{&Nothing}
                                    : std::vector<Observer *>{});
    expectSame(runOn(*A, Program), runOn(*B, Program));
    ASSERT_FALSE(HasFailure()) << (IsObserved ? "observed" : "not observed");
  }
}

/// Other programs at the same addresses, in turn.
TEST_P(Engines, KeepProgramsApart) {
  std::vector<std::shared_ptr<const Image>> Programs;
  for (const int32_t Times : {300, 700, 1100})
    Programs.push_back(codeImage(loop(Times)));
  const auto M = machine(small(GetParam()));
  for (int Round = 0; Round != 3; ++Round)
    for (const auto &Program : Programs) {
      const auto Fresh = machine(small(Engine::Interpreter));
      expectSame(runOn(*Fresh, Program), runOn(*M, Program));
    }
}

/// Nothing that is executed can be written during a run, and the run has host
/// code of its own by then.
TEST_P(Engines, NeverExecuteWhatCanBeWritten) {
  ASSERT_FALSE(isCodeWritable(hostMappings()));
  const unsigned Before = madeCode(hostMappings());
  const auto M = machine(small(GetParam()));
  unsigned Looks = 0, Made = 0;
  M->setConsole([&](std::string_view) {
    const std::vector<HostMapping> Now = hostMappings();
    EXPECT_FALSE(isCodeWritable(Now));
    Made = madeCode(Now);
    ++Looks;
  });
  const Outcomes O = runOn(*M, codeImage(loop(1000)));
  EXPECT_EQ(O.Result.End, Outcome::Done) << O.Result.Report;
  EXPECT_GT(Looks, 0U);
  EXPECT_GT(Made, Before) << "nothing has been translated";
}

} // namespace
