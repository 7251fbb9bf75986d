/// Where the instructions go: an annotated source listing.
#include "core/Isa.h"
#include "observe/CycleProfile.h"
#include "observe/ProfileJson.h"
#include "observe/SourceCosts.h"
#include "observe/Tool.h"
#include "timing/trace/LinesOfAccess.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Observer.h"
#include "vorion/support/File.h"

#include <algorithm>
#include <array>
#include <bit>
#include <fmt/format.h>
#include <optional>
#include <string>

namespace vorion::isasim {

class Profile : public Observer {
public:
  void runBegins(const RunStart &R) override {
    Places.select(R.Program);
    InterleavedStacks = R.Shape.Timing.Core.InterleavedStacks != 0;
  }
  void commit(const Commit &C) override;

  /// The listing of all runs so far: for every source file, each line with what
  /// it cost; code without line numbers by function.
  std::string report() const;
  /// The same of every instruction, as JSON.
  std::string json() const;

private:
  /// Of one instruction or of one line.
  struct Cost {
    uint64_t Warp = 0;      ///< warp instructions
    uint64_t Lanes = 0;     ///< the same times active lanes
    uint64_t Splits = 0;    ///< of these, vx_split
    uint64_t Divergent = 0; ///< of these, those that divided the lanes
    uint64_t Accesses = 0;  ///< loads, stores, atomics
    uint64_t Lines = 0;     ///< of memory that they asked for
    bool isNone() const { return Warp == 0; }
    Cost &operator+=(const Cost &Other);
  };
  unsigned linesOf(const Commit &C) const;
  static std::string row(const Cost &C, uint64_t Total);

  SourceCosts<Cost> Places;
  bool InterleavedStacks = true; ///< of the machine that runs
};

namespace {

constexpr std::string_view Heading =
    "       warp      %  lanes    splits  diverg.  accesses  lines/a.\n";

} // namespace

Profile::Cost &Profile::Cost::operator+=(const Cost &Other) {
  Warp += Other.Warp;
  Lanes += Other.Lanes;
  Splits += Other.Splits;
  Divergent += Other.Divergent;
  Accesses += Other.Accesses;
  Lines += Other.Lines;
  return *this;
}

/// As the load/store unit of this machine takes them.
unsigned Profile::linesOf(const Commit &C) const {
  const uint32_t *Addresses = C.Access->Addresses.data();
  const uint32_t First = Addresses[std::countr_zero(C.LaneMask)];
  if (C.State.Mem->Local.holds(First, C.Access->Bytes))
    return 0;
  std::array<uint32_t, MaxLanes> Lines;
  return linesOfAccess(C.State, Addresses, InterleavedStacks, Lines.data());
}

void Profile::commit(const Commit &C) {
  Cost &At = Places.at(C.Pc);
  ++At.Warp;
  At.Lanes += static_cast<unsigned>(std::popcount(C.LaneMask));
  At.Splits += C.Insn.Opcode == Op::VX_SPLIT ||
               C.Insn.Opcode == Op::VX_SPLIT_N ||
               C.Insn.Opcode == Op::VX_PRED || C.Insn.Opcode == Op::VX_PRED_N;
  At.Divergent += C.Diverged;
  if (C.Access) {
    ++At.Accesses;
    At.Lines += linesOf(C);
  }
}

std::string Profile::row(const Cost &C, uint64_t Total) {
  if (C.Warp == 0)
    return fmt::format("{:>65}", "");
  const auto Part = [](uint64_t A, uint64_t B) {
    return B ? fmt::format("{:.1f}",
                           static_cast<double>(A) / static_cast<double>(B))
             : std::string("-");
  };
  const auto Number = [](uint64_t N) {
    return N ? fmt::format("{}", N) : std::string("-");
  };
  return fmt::format(
      "{:>11} {:>5.1f}% {:>6} {:>9} {:>8} {:>9} {:>9}  ", C.Warp,
      100 * static_cast<double>(C.Warp) / static_cast<double>(Total),
      Part(C.Lanes, C.Warp), Number(C.Splits), Number(C.Divergent),
      Number(C.Accesses), Part(C.Lines, C.Accesses));
}

std::string Profile::report() const {
  const Cost All = Places.total();
  std::string Text =
      "# vorion-profile 1\n"
      "# warp: warp instructions; lanes: active on average; "
      "splits: vx_split, vx_pred;\n"
      "# diverg.: those that divided the lanes; accesses: "
      "loads, stores, atomics;\n"
      "# lines/a.: 64-byte lines of memory that each accessed\n\n";
  Text += fmt::format("{}{}total\n", Heading, row(All, All.Warp));
  return Text + Places.listing(std::string(Heading),
                               [&](const Cost &C) { return row(C, All.Warp); });
}

std::string Profile::json() const {
  return profileJson({{"format", "vorion-profile 1"}}, Places,
                     [](const Cost &C) {
                       return nlohmann::ordered_json{
                           {"executed", C.Warp},     {"lanes", C.Lanes},
                           {"splits", C.Splits},     {"divergent", C.Divergent},
                           {"accesses", C.Accesses}, {"lines", C.Lines}};
                     });
}

namespace {

/// Of cycles where the machine has a clock, else of instructions.
class ProfileTool : public Tool {
public:
  ProfileTool(std::string FileIn, const ToolOutput &To)
      : File(std::move(FileIn)), Print(To.Print) {}
  std::vector<Observer *> observers() override {
    return InCycles ? std::vector<Observer *>{}
                    : std::vector<Observer *>{&Costs};
  }
  std::vector<TimeObserver *> timeObservers() override {
    return InCycles ? std::vector<TimeObserver *>{&*InCycles}
                    : std::vector<TimeObserver *>{};
  }
  Expected<Success> attach(Machine &M) override {
    if (M.config().Timing.Enabled)
      InCycles.emplace(M);
    return Success{};
  }
  Expected<Success> runEnded(const std::string &, const RunResult &) override {
    const std::string Report =
        isProfileJson(File) ? (InCycles ? InCycles->json() : Costs.json())
                            : (InCycles ? InCycles->report() : Costs.report());
    if (File != StandardOutput)
      return writeFileAtomically(File, Report);
    Print(Report);
    return Success{};
  }

private:
  std::string File;
  std::function<void(std::string_view)> Print;
  Profile Costs;
  std::optional<CycleProfile> InCycles;
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &To) {
  if (Text == StandardOutput && !To.Print)
    return Error{"", "the profile has no output file, expected a file name",
                 ExitCode::Usage};
  return std::unique_ptr<Tool>(std::make_unique<ProfileTool>(Text, To));
}

std::vector<NamedFile> outputs(const std::string &Text) {
  return Text == StandardOutput ? std::vector<NamedFile>{}
                                : std::vector<NamedFile>{{"--profile", Text}};
}

} // namespace

const ToolKind tools::Profile{.Make = make, .Outputs = outputs};

} // namespace vorion::isasim
