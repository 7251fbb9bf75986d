#include "CyclesListing.h"

#include "vorion/support/ClockText.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/TemporaryFolder.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/JSON.h"
#include "llvm/Support/LineIterator.h"
#include "llvm/Support/MemoryBuffer.h"
#include "llvm/Support/Program.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <span>

namespace json = llvm::json;
using llvm::StringRef;

namespace vorion {

namespace {

constexpr const char *Tool = "vorion-objdump";
constexpr const char *Wanted =
    "a profile that vorion-sim --profile=FILE.json has written";

Error wrong(const std::string &Where, const std::string &What) {
  return {Where, What + ", expected " + Wanted};
}

/// What an instruction cost.
struct Cost {
  uint32_t Code = 0;
  uint64_t Executed = 0;
  uint64_t Lanes = 0; ///< active, added up over executions; 0 with cycles
  uint64_t Cycles = 0;
  std::string Reason; ///< that most of the cycles went to, beside issuing
};

struct Program {
  std::string File;
  std::map<uint64_t, Cost> ByAddress;
};

struct Profile {
  bool HasCycles = false;
  uint64_t Cycles = 0; ///< of all cores and programs
  std::string Machine; ///< a line of what the cycles are of, or nothing
  std::vector<Program> Programs;
};

Cost parseCost(const json::Object &From) {
  Cost C;
  C.Code = static_cast<uint32_t>(From.getInteger("code").value_or(0));
  const auto Count = [&](StringRef Key) {
    return static_cast<uint64_t>(From.getInteger(Key).value_or(0));
  };
  C.Executed = Count("executed");
  C.Lanes = Count("lanes");
  C.Cycles = Count("cycles");
  if (const json::Object *Reasons = From.getObject("by_reason")) {
    int64_t Most = 0;
    for (const auto &[Name, Cycles] : *Reasons)
      if (const auto Number = Cycles.getAsInteger();
          Number && *Number > Most && StringRef(Name) != "issue") {
        Most = *Number;
        C.Reason = StringRef(Name).str();
      }
  }
  return C;
}

Expected<Profile> readProfile(const std::string &Path) {
  const auto Buffer = llvm::MemoryBuffer::getFile(Path);
  if (!Buffer)
    return wrong(Path, Buffer.getError().message());
  llvm::Expected<json::Value> Text = json::parse((*Buffer)->getBuffer());
  if (!Text) {
    const StringRef Bytes = (*Buffer)->getBuffer();
    const auto File = std::as_bytes(std::span(Bytes.data(), Bytes.size()));
    std::string Why = llvm::toString(Text.takeError());
    if (!mayBeJson(fileKindOf(File)))
      return otherKind(Path, File, Wanted, "");
    return wrong(Path, Why);
  }
  const json::Object *Top = Text->getAsObject();
  const json::Array *Programs = Top ? Top->getArray("programs") : nullptr;
  if (!Programs || Top->getString("format") != "vorion-profile 1")
    return wrong(Path, "is no such report");
  Profile All;
  const auto Cycles = Top->getInteger("cycles");
  All.HasCycles = Cycles.has_value();
  All.Cycles = static_cast<uint64_t>(Cycles.value_or(0));
  if (const auto Name = Top->getString("machine"))
    All.Machine =
        "machine: " +
        clockedMachine(
            Name->str(),
            static_cast<uint64_t>(Top->getInteger("clock_mhz").value_or(0)),
            static_cast<uint64_t>(
                Top->getInteger("clock_version").value_or(0))) +
        "\n";
  for (const json::Value &Each : *Programs) {
    const json::Object *Object = Each.getAsObject();
    const auto File = Object ? Object->getString("file") : std::nullopt;
    const json::Array *Instructions =
        Object ? Object->getArray("instructions") : nullptr;
    if (!File || !Instructions)
      return wrong(Path, "has a program without a file or instructions");
    Program P{File->str(), {}};
    for (const json::Value &Entry : *Instructions) {
      const json::Object *Of = Entry.getAsObject();
      const auto Pc = Of ? Of->getInteger("pc") : std::nullopt;
      if (!Pc)
        return wrong(Path, "has an instruction without pc");
      P.ByAddress[static_cast<uint64_t>(*Pc)] = parseCost(*Of);
    }
    All.Programs.push_back(std::move(P));
  }
  return All;
}

/// A line of llvm-objdump's listing.
struct Line {
  enum class Kind { File, Function, Instruction, Other } What = Kind::Other;
  std::string Text;
  uint64_t Address = 0; ///< of an instruction
  uint32_t Code = 0;
};

/// "80000010: 00a50533 <tab>add a0, a0, a0"; false of anything else.
bool parseInstruction(StringRef Text, Line &L) {
  Text = Text.ltrim();
  if (Text.consumeInteger(16, L.Address) || !Text.consume_front(": "))
    return false;
  Text = Text.ltrim();
  if (Text.consumeInteger(16, L.Code))
    return false;
  const auto [Name, Operands] = Text.ltrim().split('\t');
  L.What = Line::Kind::Instruction;
  L.Text = fmt::format("{:x}: {:<9} {}", L.Address, Name.str(), Operands.str());
  L.Text.resize(StringRef(L.Text).rtrim().size());
  return true;
}

/// "80000010 <name>:".
bool isLabel(StringRef Text) {
  uint64_t Address = 0;
  return Text.ends_with(">:") && !Text.consumeInteger(16, Address) &&
         Text.starts_with(" <");
}

Line parseLine(StringRef Text) {
  Line L{Line::Kind::Other, Text.str()};
  std::ranges::replace(L.Text, '\t', ' ');
  if (Text.contains(":\tfile format "))
    L.What = Line::Kind::File;
  else if (isLabel(Text) && Text.contains(" <.L"))
    L.Text.clear(); // the assembler's own, inside of a function
  else if (isLabel(Text))
    L.What = Line::Kind::Function;
  else
    parseInstruction(Text, L);
  return L;
}

/// What stands beside the lines.
class Columns {
public:
  explicit Columns(const Profile &Of) : Of(Of) {}

  std::string heading() const {
    return Of.HasCycles ? fmt::format("{:>11} {:>6} {:>10}  {:<10}  ", "cycles",
                                      "%", "executed", "waits for")
                        : fmt::format("{:>10} {:>6}  ", "executed", "lanes");
  }
  std::string nothing() const { return std::string(heading().size(), ' '); }
  /// Of a function only what its instructions add up to.
  std::string row(const Cost &C, bool IsFunction = false) const {
    const std::string Executed = IsFunction ? "" : std::to_string(C.Executed);
    if (Of.HasCycles)
      return fmt::format("{:>11} {:>6} {:>10}  {:<10}  ", C.Cycles,
                         ratio(100 * C.Cycles, Of.Cycles, 2), Executed,
                         C.Reason);
    return fmt::format("{:>10} {:>6}  ", Executed,
                       IsFunction ? "" : ratio(C.Lanes, C.Executed, 1));
  }

private:
  static std::string ratio(uint64_t A, uint64_t B, int Digits) {
    return B ? fmt::format("{:.{}f}", double(A) / double(B), Digits) : "-";
  }
  const Profile &Of;
};

/// One program's part of the listing.
class Listing {
public:
  Listing(const Profile &All, const Columns &Shown) : All(All), Shown(Shown) {}

  void add(Line L) { Lines.push_back(std::move(L)); }
  bool empty() const { return Lines.empty(); }

  /// What to print, or an error if the profile has not this program.
  Expected<std::string> text(const std::string &From) const {
    const Program *P = find();
    if (!P)
      return Error{
          From, "has no program with the instructions of " +
                    Lines.front().Text.substr(0, Lines.front().Text.find(':')) +
                    ", expected a profile of its run"};
    std::string Text = Lines.front().Text + "\n\n" + Shown.heading() + "\n";
    // Up to the next function; printed if it was executed.
    std::string Function;
    Cost Sum;
    const auto Flush = [&] {
      if (Sum.Executed)
        Text += Function;
      Function.clear();
      Sum = {};
    };
    size_t Head = 0;
    for (size_t I = 1; I < Lines.size(); ++I) {
      const Line &L = Lines[I];
      if (L.What == Line::Kind::Function) {
        Flush();
        Head = I;
        Function = sumLine(*P, Head);
        continue;
      }
      const auto Found = L.What == Line::Kind::Instruction
                             ? P->ByAddress.find(L.Address)
                             : P->ByAddress.end();
      const bool IsKnown = Found != P->ByAddress.end();
      if (IsKnown)
        Sum.Executed += Found->second.Executed;
      if (Head && !L.Text.empty())
        Function += (IsKnown ? Shown.row(Found->second) : Shown.nothing()) +
                    L.Text + "\n";
    }
    Flush();
    return Text;
  }

private:
  /// The one whose instructions are all here.
  const Program *find() const {
    std::map<uint64_t, uint32_t> Here;
    for (const Line &L : Lines)
      if (L.What == Line::Kind::Instruction)
        Here[L.Address] = L.Code;
    for (const Program &P : All.Programs)
      if (llvm::all_of(P.ByAddress, [&](const auto &Entry) {
            const auto Found = Here.find(Entry.first);
            return Found != Here.end() && Found->second == Entry.second.Code;
          }))
        return &P;
    return nullptr;
  }

  /// The line of the function that begins at line \p Head, with its sum.
  std::string sumLine(const Program &P, size_t Head) const {
    Cost Sum;
    for (size_t I = Head + 1;
         I < Lines.size() && Lines[I].What != Line::Kind::Function; ++I)
      if (const auto Found = Lines[I].What == Line::Kind::Instruction
                                 ? P.ByAddress.find(Lines[I].Address)
                                 : P.ByAddress.end();
          Found != P.ByAddress.end())
        Sum.Cycles += Found->second.Cycles;
    return "\n" + Shown.row(Sum, /*IsFunction=*/true) + Lines[Head].Text + "\n";
  }

  const Profile &All;
  const Columns &Shown;
  std::vector<Line> Lines;
};

Expected<std::string> annotate(StringRef Objdumped, const Profile &Of,
                               const std::string &From) {
  const Columns Shown(Of);
  std::vector<Listing> Files;
  llvm::SmallVector<StringRef, 0> Texts;
  Objdumped.split(Texts, '\n');
  for (const StringRef Text : Texts) {
    Line L = parseLine(Text);
    if (L.What == Line::Kind::File)
      Files.emplace_back(Of, Shown);
    if (!Files.empty())
      Files.back().add(std::move(L));
  }
  std::string All = Of.Machine;
  for (const Listing &Each : Files) {
    const Expected<std::string> Text = Each.text(From);
    if (!Text)
      return Text.error();
    All += *Text;
  }
  return All;
}

} // namespace

std::optional<std::string> takeCyclesOption(std::vector<StringRef> &Arguments) {
  for (size_t I = 0; I < Arguments.size(); ++I) {
    StringRef A = Arguments[I];
    if (A == "--profile") {
      std::string Value =
          I + 1 < Arguments.size() ? Arguments[I + 1].str() : "";
      Arguments.erase(Arguments.begin() + I,
                      Arguments.begin() + std::min(I + 2, Arguments.size()));
      return Value;
    }
    if (A.consume_front("--profile=")) {
      Arguments.erase(Arguments.begin() + I);
      return A.str();
    }
  }
  return std::nullopt;
}

int runWithCycles(StringRef Program, std::vector<StringRef> Arguments,
                  bool HasProgram, const std::string &File) {
  if (File.empty())
    return reportError(Tool, {"",
                              "--profile: nothing follows, expected the "
                              "name of a profile",
                              ExitCode::Usage});
  const Expected<Profile> Read = readProfile(File);
  if (!Read)
    return reportError(Tool, Read.error());
  const auto Folder = TemporaryFolder::make("vorion");
  if (!Folder)
    return reportError(Tool, Folder.error());
  // The code tells whether the program is the one that ran.
  Arguments.insert(Arguments.begin(), {Program, "--disassemble"});
  if (!HasProgram)
    for (const auto &P : Read->Programs)
      Arguments.push_back(P.File);
  const std::string Output = Folder->path() + "/listing";
  const std::optional<StringRef> Streams[] = {std::nullopt, StringRef(Output),
                                              std::nullopt};
  std::string Problem;
  const int Ended = llvm::sys::ExecuteAndWait(Program, Arguments, std::nullopt,
                                              Streams, 0, 0, &Problem);
  if (Ended < 0)
    return reportError(
        Tool, {"", Problem + ", expected a listing", ExitCode::Internal});
  if (Ended != 0)
    return Ended;
  const auto Buffer = llvm::MemoryBuffer::getFile(Output);
  if (!Buffer)
    return reportError(
        Tool, {Output, Buffer.getError().message() + ", expected a listing"});
  const Expected<std::string> Text =
      annotate((*Buffer)->getBuffer(), *Read, File);
  if (!Text)
    return reportError(Tool, Text.error());
  printText(*Text);
  return 0;
}

} // namespace vorion
