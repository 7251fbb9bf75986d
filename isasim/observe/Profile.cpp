#include "observe/Profile.h"

#include "core/Isa.h"
#include "observe/Tool.h"
#include "vorion/support/File.h"

#include <algorithm>
#include <array>
#include <bit>
#include <fmt/format.h>
#include <sstream>

namespace vorion::isasim {

namespace {

constexpr std::string_view Heading =
    "       warp      %  lanes    splits  diverg.  accesses  lines/a.\n";

std::vector<std::string> linesOf(const std::string &Path) {
  std::vector<std::string> Lines;
  const Expected<std::vector<std::byte>> Bytes = readFile(Path);
  if (!Bytes)
    return Lines;
  std::istringstream Text(std::string(
      reinterpret_cast<const char *>(Bytes->data()), Bytes->size()));
  for (std::string Line; std::getline(Text, Line);)
    Lines.push_back(Line);
  return Lines;
}

/// Pieces of memory of this many bytes that the active lanes touch.
unsigned piecesTouched(const MemoryAccess &A, uint32_t Mask) {
  constexpr unsigned Shift = 6;
  std::array<uint32_t, 16> Seen{};
  unsigned Count = 0;
  for (uint32_t Left = Mask; Left; Left &= Left - 1) {
    const uint32_t Piece = A.Addresses[std::countr_zero(Left)] >> Shift;
    if (std::find(Seen.begin(), Seen.begin() + Count, Piece) ==
        Seen.begin() + Count)
      Seen[Count++] = Piece;
  }
  return Count;
}

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

void Profile::runBegins(const RunStart &R) {
  const auto Found =
      std::find_if(Programs.begin(), Programs.end(),
                   [&](const Program &P) { return P.Code == R.Program; });
  if (Found != Programs.end()) {
    Current = &*Found;
    return;
  }
  Program P{
      R.Program, std::make_unique<SourceLines>(R.Program), UINT32_MAX, {}};
  uint32_t High = 0;
  for (const Image::Segment &S : R.Program->segments())
    if (S.Executable) {
      P.Low = std::min(P.Low, S.Address);
      High = std::max(High, S.Address + S.MemBytes);
    }
  P.ByWord.resize((High - P.Low) / 4);
  Programs.push_back(std::move(P));
  Current = &Programs.back();
}

void Profile::commit(const Commit &C) {
  Cost &At = Current->ByWord[(C.Pc - Current->Low) / 4];
  ++At.Warp;
  At.Lanes += static_cast<unsigned>(std::popcount(C.LaneMask));
  At.Splits += C.Insn.Opcode == Op::VX_SPLIT ||
               C.Insn.Opcode == Op::VX_SPLIT_N ||
               C.Insn.Opcode == Op::VX_PRED || C.Insn.Opcode == Op::VX_PRED_N;
  At.Divergent += C.Diverged;
  if (C.Access) {
    ++At.Accesses;
    At.Lines += piecesTouched(*C.Access, C.LaneMask);
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
  Cost All;
  std::map<std::string, std::map<unsigned, Cost>> Files;
  std::map<std::string, Cost> Others; // by function
  for (const Program &P : Programs)
    for (size_t N = 0; N != P.ByWord.size(); ++N) {
      const Cost &C = P.ByWord[N];
      if (C.Warp == 0)
        continue;
      All += C;
      const auto Pc = static_cast<uint32_t>(P.Low + 4 * N);
      if (const std::optional<SourcePlace> Place = P.Source->find(Pc)) {
        Files[Place->File][Place->Line] += C;
        continue;
      }
      std::string Name = P.Code->symbolize(Pc);
      Name.resize(std::min(Name.size(), Name.find('+')));
      Others[Name.empty() ? P.Code->name() : Name] += C;
    }

  std::string Text = "# vorion-profile 1\n"
                     "# warp: warp instructions; lanes: active on average; "
                     "splits: vx_split, vx_pred;\n"
                     "# diverg.: those that divided the lanes; accesses: "
                     "loads, stores, atomics;\n"
                     "# lines/a.: 64-byte pieces each touched\n\n";
  Text += fmt::format("{}{}total\n", Heading, row(All, All.Warp));
  for (const auto &[File, Lines] : Files) {
    Cost Sum;
    for (const auto &[Line, C] : Lines)
      Sum += C;
    Text += fmt::format("\n{}{}{}\n", Heading, row(Sum, All.Warp), File);
    const std::vector<std::string> Source = linesOf(File);
    // A file that is not there: the lines that cost something, by number.
    if (Source.empty())
      for (const auto &[Line, C] : Lines)
        Text += fmt::format("{}{:>5}\n", row(C, All.Warp), Line);
    for (unsigned Line = 1; Line <= Source.size(); ++Line) {
      const auto Found = Lines.find(Line);
      Text += fmt::format(
          "{}{:>5}  {}\n",
          row(Found == Lines.end() ? Cost() : Found->second, All.Warp), Line,
          Source[Line - 1]);
    }
  }
  if (!Others.empty())
    Text += fmt::format("\n{}code without line numbers\n", Heading);
  for (const auto &[Name, C] : Others)
    Text += fmt::format("{}{}\n", row(C, All.Warp), Name);
  return Text;
}

namespace {

class ProfileTool : public Tool {
public:
  ProfileTool(std::string FileIn, const ToolOutput &To)
      : File(std::move(FileIn)), Print(To.Print) {}
  std::vector<Observer *> observers() override { return {&Costs}; }
  Expected<Success> runEnded(const std::string &, const RunResult &) override {
    const std::string Report = Costs.report();
    if (File != StandardOutput)
      return writeFileAtomically(File, Report);
    Print(Report);
    return Success{};
  }

private:
  std::string File;
  std::function<void(std::string_view)> Print;
  Profile Costs;
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &To) {
  if (Text == StandardOutput && !To.Print)
    return Error{"", "the profile has nowhere to go, expected a file name",
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
