#include "ResourcesReport.h"

#include "Resources.h"

#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/TemporaryFolder.h"
#include "vorion/support/Version.h"

#include "llvm/ADT/SmallString.h"
#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/FormatVariadic.h"
#include "llvm/Support/JSON.h"
#include "llvm/Support/LineIterator.h"
#include "llvm/Support/MemoryBuffer.h"
#include "llvm/Support/Program.h"
#include "llvm/Support/raw_ostream.h"

#include <algorithm>
#include <set>

namespace json = llvm::json;

namespace vorion {

namespace {

constexpr const char *Tool = "vorion-clang";
constexpr const char *Wanted = ", expected the functions that were compiled";

Expected<json::Array> readFunctions(const std::string &Path) {
  json::Array Functions;
  // A compilation without code has written nothing.
  if (!llvm::sys::fs::exists(Path))
    return Functions;
  const auto Buffer = llvm::MemoryBuffer::getFile(Path);
  if (!Buffer)
    return Error{Path, Buffer.getError().message() + Wanted};
  for (llvm::line_iterator Line(**Buffer); !Line.is_at_end(); ++Line) {
    auto Function = json::parse(*Line);
    if (!Function)
      return Error{Path, llvm::toString(Function.takeError()) + Wanted,
                   ExitCode::Internal};
    Functions.push_back(std::move(*Function));
  }
  return Functions;
}

std::string report(json::Array Functions,
                   llvm::ArrayRef<llvm::StringRef> Arguments) {
  llvm::SmallString<128> Folder;
  if (llvm::sys::fs::current_path(Folder))
    Folder.clear();
  const auto Text = [](std::string_view Of) {
    return json::fixUTF8(llvm::StringRef(Of.data(), Of.size()));
  };
  json::Array Words;
  for (const llvm::StringRef Word : Arguments)
    Words.push_back(Text(Word));
  const json::Value Report = json::Object{
      {"schema", json::Object{{"name", "vorion-resources"}, {"version", 1}}},
      {"program", json::Object{{"name", Tool},
                               {"version", Text(projectVersion())},
                               {"commit", Text(commitOfTree())},
                               {"llvm", Text(llvmVersion())},
                               {"pocl", Text(poclVersion())},
                               {"arguments", std::move(Words)},
                               {"folder", Text(Folder.str())},
                               {"environment", json::Object{}}}},
      {"functions", std::move(Functions)}};
  return llvm::formatv("{0:2}\n", Report);
}

/// A column of the table: its heading, and where its number is.
struct Column {
  llvm::StringRef Heading;
  std::vector<llvm::StringRef> Keys;
};

const std::vector<Column> &columns() {
  static const std::vector<Column> All = {
      {"instr.", {"instructions"}},
      {"bytes", {"code_bytes"}},
      {"int", {"registers", "integer", "alive"}},
      {"float", {"registers", "float", "alive"}},
      {"stack", {"stack_bytes"}},
      {"private", {"private_bytes"}},
      {"saved", {"saved_bytes"}},
      {"spilled", {"spills", "bytes"}},
      {"stores", {"spills", "stores"}},
      {"loads", {"spills", "loads"}},
      {"local", {"local_bytes"}},
      {"kept", {"context_bytes"}},
      {"splits", {"splits"}},
      {"preds", {"predicates"}},
      {"joins", {"joins"}},
      {"bars", {"barriers"}},
      {"divs", {"divisions"}},
  };
  return All;
}

/// The number, or a dash for none.
std::string number(const json::Object &Function, const Column &Of) {
  const json::Object *At = &Function;
  for (const llvm::StringRef Key : llvm::ArrayRef(Of.Keys).drop_back())
    At = At->getObject(Key);
  const auto Number = At->getInteger(Of.Keys.back());
  return Number ? std::to_string(*Number) : "-";
}

std::string place(const json::Object &Of) {
  const auto File = Of.getString("file");
  if (!File)
    return "(no line)";
  const std::string Line =
      llvm::formatv("{0}:{1}", *File, *Of.getInteger("line")).str();
  const int64_t Column = Of.getInteger("column").value_or(0);
  return Column ? llvm::formatv("{0}:{1}", Line, Column).str() : Line;
}

std::string table(const json::Array &Functions) {
  constexpr const char *First = "function";
  size_t Width = llvm::StringRef(First).size();
  for (const json::Value &Each : Functions)
    Width = std::max(Width, Each.getAsObject()->getString("function")->size());
  const auto Cell = [](const std::string &Text, const Column &Of) {
    return llvm::right_justify(Text, Of.Heading.size() + 2);
  };
  std::string Text;
  llvm::raw_string_ostream Out(Text);
  Out << llvm::left_justify(First, Width);
  for (const Column &Of : columns())
    Out << Cell(Of.Heading.str(), Of);
  Out << "\n";
  for (const json::Value &Each : Functions) {
    const json::Object &Function = *Each.getAsObject();
    Out << llvm::left_justify(*Function.getString("function"), Width);
    for (const Column &Of : columns())
      Out << Cell(number(Function, Of), Of);
    Out << "\n";
    for (const json::Value &Callee : *Function.getArray("calls"))
      Out << "  calls " << *Callee.getAsString() << "\n";
    if (const json::Object *Rounds = Function.getObject("rounds"))
      Out << llvm::formatv(
          "  {0}: runs in rounds from barrier to barrier: {1}\n",
          place(*Rounds), *Rounds->getString("reason"));
    // A kernel with barriers has many loops over its work-items at one place.
    std::set<std::string> Told;
    for (const json::Value &Any : *Function.getArray("branches")) {
      const json::Object &Branch = *Any.getAsObject();
      const bool IsSplit = *Branch.getString("kind") == "split";
      const std::string Line = llvm::formatv(
          "  {0}: divergent {1}: {2}\n", place(Branch),
          IsSplit ? "branch" : "loop", *Branch.getString("reason"));
      if (Told.insert(Line).second)
        Out << Line;
    }
  }
  return Text;
}

} // namespace

std::optional<std::string>
takeResourcesOption(std::vector<llvm::StringRef> &Arguments) {
  std::optional<std::string> Form;
  llvm::erase_if(Arguments, [&](llvm::StringRef A) {
    if (A != "--resources" && !A.consume_front("--resources="))
      return false;
    Form = A == "--resources" ? "" : A.str();
    return true;
  });
  return Form;
}

int runWithResources(llvm::StringRef Program,
                     llvm::ArrayRef<llvm::StringRef> Arguments,
                     const std::string &Form) {
  const bool IsFile = !Form.empty() && Form != "json";
  if (IsFile)
    if (const auto Good = claimOutputs({{"--resources", Form}}); !Good)
      return reportError(Tool, Good.error());
  const auto Folder = TemporaryFolder::make("vorion");
  if (!Folder)
    return reportError(Tool, Folder.error());
  const std::string Collected = Folder->path() + "/resources";
  const std::string Option =
      ("-" + llvm::vorion::ResourcesOption + "=" + Collected).str();
  // The front end keeps lines for remarks, even of no pass; the code is the
  // same.
  std::vector<llvm::StringRef> Words = {
      Program, "--start-no-unused-arguments", "-Rpass=^$", "-mllvm",
      Option,  "--end-no-unused-arguments"};
  Words.insert(Words.end(), Arguments.begin(), Arguments.end());
  std::string Problem;
  const int Ended = llvm::sys::ExecuteAndWait(Program, Words, std::nullopt, {},
                                              0, 0, &Problem);
  if (Ended < 0)
    return reportError(Tool, {"", Problem + ", expected the compiler to end",
                              ExitCode::Internal});
  if (Ended != 0)
    return Ended;
  Expected<json::Array> Functions = readFunctions(Collected);
  if (!Functions)
    return reportError(Tool, Functions.error());
  if (Form.empty()) {
    if (!Functions->empty())
      printText(table(*Functions));
    return 0;
  }
  const Expected<Success> Written =
      writeFileAtomically(IsFile ? Form : std::string(StandardOutput),
                          report(std::move(*Functions), Arguments));
  return Written ? 0 : reportError(Tool, Written.error());
}

} // namespace vorion
