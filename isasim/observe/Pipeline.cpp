/// `--pipeline`: the instructions of a core one by one, for Konata
/// (docs/debugging.md).

#include "mem/SourceLines.h"
#include "observe/CodeText.h"
#include "observe/SettingsOnce.h"
#include "observe/Tool.h"
#include "timing/common/TimeObserver.h"
#include "vorion/isasim/Machine.h"
#include "vorion/support/File.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <utility>

namespace vorion::isasim {

namespace {

/// Which instructions go to which file.
struct PipelineOptions {
  std::string File;
  unsigned Core = 0;
  /// Of those that the core issues in all runs: the number of the first.
  uint64_t First = 0;
  uint64_t Count = 10000;
  static constexpr uint64_t MostCount = 1'000'000;

  static Expected<PipelineOptions> parse(std::string_view Text);

private:
  bool set(std::string_view Name, std::string_view Value);
};

bool PipelineOptions::set(std::string_view Name, std::string_view Value) {
  const auto Read = [&](auto &To) {
    const auto R = std::from_chars(Value.begin(), Value.end(), To);
    return R.ec == std::errc() && R.ptr == Value.end();
  };
  if (Name == "file") {
    File = Value;
    return !File.empty();
  }
  if (Name == "core")
    return Read(Core);
  if (Name == "first")
    return Read(First);
  return Name == "count" && Read(Count) && Count != 0 && Count <= MostCount;
}

Expected<PipelineOptions> PipelineOptions::parse(std::string_view Text) {
  PipelineOptions O;
  const auto Bad = [](std::string_view Setting) {
    return Error{"",
                 fmt::format("pipeline setting '{}', expected file=FILE, and "
                             "core=N, first=N, count=N, 1 to {}",
                             Setting, MostCount),
                 ExitCode::Usage};
  };
  SettingsOnce Given;
  for (;;) {
    const std::string_view Setting = Text.substr(0, Text.find(','));
    if (!Given.isNew(Setting))
      return SettingsOnce::twice("pipeline", Setting);
    const size_t Equal = std::min(Setting.find('='), Setting.size());
    if (!O.set(Setting.substr(0, Equal),
               Setting.substr(std::min(Equal + 1, Setting.size()))))
      return Bad(Setting);
    if (Setting.size() == Text.size())
      break;
    Text.remove_prefix(Setting.size() + 1);
  }
  return O.File.empty() ? Expected<PipelineOptions>(Bad(Text)) : O;
}

class PipelineTool : public Tool, public TimeObserver {
public:
  explicit PipelineTool(PipelineOptions OptionsIn)
      : Options(std::move(OptionsIn)) {}

  std::vector<TimeObserver *> timeObservers() override { return {this}; }
  Expected<Success> attach(Machine &M) override;
  Expected<Success> runEnded(const std::string &, const RunResult &) override {
    HasRun = true;
    return writeFileAtomically(Options.File, log());
  }
  Expected<Success> finished() const override;

  void timeBegins(uint64_t) override;
  void coreSpent(const CoreSpent &S) override;
  void coreIssued(const CoreIssued &I) override;
  void loadDone(unsigned Core, uint64_t Serial, uint64_t ResultAt) override;

private:
  struct Instruction {
    unsigned Warp;
    uint64_t IssuedAt, ResultAt;
    std::string Text, Place;
    std::vector<CoreSpent> Stages; ///< the last of which is its issue
  };
  bool isWatched(unsigned Core) const {
    return Core == Options.Core && Issued < Options.First + Options.Count;
  }
  std::string log() const;

  const PipelineOptions Options;
  const Machine *Device = nullptr;
  std::shared_ptr<const Image> Program;
  std::unique_ptr<SourceLines> Source;
  uint32_t Low = 0;
  bool HasRun = false;
  uint64_t Issued = 0;           ///< by the core, in all runs
  std::vector<CoreSpent> Stages; ///< of what has not issued
  std::vector<Instruction> Instructions;
  std::map<uint64_t, size_t> Waiting; ///< for memory: places by serial number
};

Expected<Success> PipelineTool::attach(Machine &M) {
  Device = &M;
  if (const unsigned Cores = M.config().cores(); Options.Core >= Cores)
    return Error{"",
                 fmt::format("pipeline: core={}: the machine has {} cores, "
                             "expected 0 to {}",
                             Options.Core, Cores, Cores - 1),
                 ExitCode::Usage};
  return Success{};
}

Expected<Success> PipelineTool::finished() const {
  if (!HasRun || !Instructions.empty())
    return Success{};
  return Error{"",
               fmt::format("pipeline: first={} was not reached, core {} issued "
                           "{} instructions with timing on",
                           Options.First, Options.Core, Issued),
               ExitCode::Usage};
}

void PipelineTool::timeBegins(uint64_t) {
  Waiting.clear();
  Stages.clear();
  if (Program == Device->image())
    return;
  Program = Device->image();
  Source = std::make_unique<SourceLines>(Program);
  Low = firstCode(*Program);
}

void PipelineTool::coreSpent(const CoreSpent &S) {
  if (isWatched(S.Core) && S.Instruction != CoreSpent::NoInstruction)
    Stages.push_back(S);
}

void PipelineTool::coreIssued(const CoreIssued &I) {
  if (!isWatched(I.Core))
    return;
  // Another warp's may have waited in between.
  const auto Others = std::ranges::partition(
      Stages, [&](uint32_t Which) { return Which != I.Instruction; },
      &CoreSpent::Instruction);
  const std::vector<CoreSpent> Own(Others.begin(), Others.end());
  Stages.erase(Others.begin(), Others.end());
  if (Issued++ < Options.First)
    return;
  const uint32_t Pc = Low + 4 * I.Instruction;
  const bool IsKnown = I.ResultAt != CoreIssued::Unknown;
  if (!IsKnown)
    Waiting[I.Serial] = Instructions.size();
  Instructions.push_back(
      {I.Warp, I.At, IsKnown ? I.ResultAt : I.At + 1,
       fmt::format("{:08x} {}", Pc, instructionText(*Program, Pc)),
       Source->describe(Pc), Own});
}

void PipelineTool::loadDone(unsigned Core, uint64_t Serial, uint64_t ResultAt) {
  if (Core != Options.Core)
    return;
  if (const auto Found = Waiting.find(Serial); Found != Waiting.end()) {
    Instructions[Found->second].ResultAt = ResultAt;
    Waiting.erase(Found);
  }
}

/// The log's lines stand in the order of time, those of a cycle in the order of
/// instructions.
std::string PipelineTool::log() const {
  std::vector<std::pair<uint64_t, std::string>> Lines;
  std::vector<std::pair<uint64_t, size_t>> Ends;
  for (size_t Id = 0; Id != Instructions.size(); ++Id) {
    const Instruction &I = Instructions[Id];
    const auto Add = [&](uint64_t At, const std::string &Line) {
      Lines.emplace_back(At, Line);
    };
    const auto AddStage = [&](std::string_view Name, CycleSpan When) {
      Add(When.From, fmt::format("S\t{}\t0\t{}\n", Id, Name));
      Add(When.Until, fmt::format("E\t{}\t0\t{}\n", Id, Name));
    };
    const uint64_t Begin = I.Stages.front().When.From;
    Add(Begin, fmt::format("I\t{}\t{}\t{}\n", Id, Options.First + Id, I.Warp));
    Add(Begin, fmt::format("L\t{}\t0\t{}\n", Id, I.Text));
    Add(Begin, fmt::format("L\t{}\t1\t{}\n", Id, I.Place));
    for (const CoreSpent &S : I.Stages)
      AddStage(name(S.What), S.When);
    const uint64_t End = std::max(I.ResultAt, I.IssuedAt + 1);
    if (End > I.IssuedAt + 1)
      AddStage("execute", {I.IssuedAt + 1, End});
    Ends.emplace_back(End, Id);
  }
  std::ranges::sort(Ends);
  for (size_t N = 0; N != Ends.size(); ++N)
    Lines.emplace_back(Ends[N].first,
                       fmt::format("R\t{}\t{}\t0\n", Ends[N].second, N));
  std::vector<size_t> Order(Lines.size());
  for (size_t N = 0; N != Order.size(); ++N)
    Order[N] = N;
  std::ranges::sort(Order, {},
                    [&](size_t N) { return std::pair(Lines[N].first, N); });

  std::string Text = "Kanata\t0004\n";
  uint64_t Now = 0;
  for (const size_t N : Order) {
    const auto &[At, Line] = Lines[N];
    if (N == Order.front())
      Text += fmt::format("C=\t{}\n", At);
    else if (At != Now)
      Text += fmt::format("C\t{}\n", At - Now);
    Now = At;
    Text += Line;
  }
  return Text;
}

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &) {
  Expected<PipelineOptions> O = PipelineOptions::parse(Text);
  if (!O)
    return O.error();
  return std::unique_ptr<Tool>(std::make_unique<PipelineTool>(std::move(*O)));
}

std::vector<NamedFile> outputs(const std::string &Text) {
  const Expected<PipelineOptions> O = PipelineOptions::parse(Text);
  return O ? std::vector<NamedFile>{{"--pipeline", O->File}}
           : std::vector<NamedFile>{};
}

} // namespace

const ToolKind tools::Pipeline{
    .Make = make, .Outputs = outputs, .NeedsClock = true};

} // namespace vorion::isasim
