#include "Tools.h"

#include "CompilerLibrary.h"
#include "FileState.h"
#include "ToolServer.h"
#include "vorion/support/Environment.h"
#include "vorion/support/Hash.h"

extern "C" {
#include "config.h"
#include "pocl_util.h"
}

#include <algorithm>
#include <cstdio>
#include <dlfcn.h>
#include <filesystem>
#include <iomanip>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace vorion {

namespace {

/// Any address of this library serves to find its file.
fs::path libraryFile() {
  Dl_info Info;
  if (!dladdr(reinterpret_cast<void *>(&libraryFile), &Info))
    return {};
  std::error_code Error;
  return fs::canonical(Info.dli_fname, Error);
}

/// Where a message of a tool is cut off.
constexpr size_t MaxToolOutput = 65536;
/// Where remarks are, of which there may be several a line.
constexpr size_t MaxRemarks = size_t{16} << 20;

/// Options of vorion-clang, with blanks between and in quotes if they have
/// some: which remarks to print, and -mllvm (docs/backend.md).
const char *remarkOptions() { return environmentVariable("VORION_REMARKS"); }

/// Remarks change the options of LLVM, which one process keeps for all calls.
bool mayAskServers() {
  const char *Wanted = environmentVariable("VORION_TOOL_SERVERS");
  return !remarkOptions() && !(Wanted && std::string_view(Wanted) == "0");
}

std::string failure(const std::string &Tool, int Code,
                    const std::string &Printed) {
  return Tool + " failed (" + std::to_string(Code) + ")\n" + Printed;
}

/// Where of bitcode nothing is known but what it says itself, clang prints
/// "remark: k.cl:3:5: text"; everywhere else "k.cl:3:5: remark: text". A kernel
/// with barriers has many loops over its work-items at one place: what is said
/// of a place is said once.
void printRemarks(const std::string &Output) {
  std::set<std::string> Told;
  constexpr std::string_view Head = "remark: ";
  std::istringstream Lines(Output);
  for (std::string Line; std::getline(Lines, Line);) {
    const size_t End = Line.find(": ", Head.size());
    if (Line.starts_with(Head) && End != std::string::npos)
      Line = Line.substr(Head.size(), End - Head.size()) + ": remark" +
             Line.substr(End);
    if (Told.insert(Line).second)
      std::fprintf(stderr, "%s\n", Line.c_str());
  }
}

} // namespace

Tools::Tools() {
  std::vector<fs::path> Places;
  if (const char *Given = environmentVariable("VORION_ROOT"))
    Places.emplace_back(Given);
  else
    for (fs::path Folder = libraryFile().parent_path();
         Folder.has_relative_path() && Places.size() < 4;
         Folder = Folder.parent_path())
      Places.push_back(Folder);
  std::error_code Error;
  for (const fs::path &Place : Places)
    if (fs::exists(Place / "bin" / "vorion-clang", Error)) {
      Root = Place;
      return;
    }
  const char *Given = environmentVariable("VORION_ROOT");
  Problem = "cannot find bin/vorion-clang below " +
            (Given ? "VORION_ROOT, '" + std::string(Given) + "'"
                   : libraryFile().parent_path().string() +
                         " or above; set VORION_ROOT");
}

std::string Tools::fingerprint() const {
  std::vector<fs::path> Files = {libraryFile(), pocl::compilerLibraryFile(),
                                 fs::path(Root) / "bin" / "vorion-clang",
                                 fs::path(Root) / "bin" / "vorion-link",
                                 fs::path(Root) / "pocl" / "share" / "pocl" /
                                     "kernel-vorion.bc"};
  std::error_code Error;
  for (const char *Folder : {"lib/vorion", "include/vorion"})
    for (const auto &Entry :
         fs::directory_iterator(fs::path(Root) / Folder, Error))
      Files.push_back(Entry.path());
  std::sort(Files.begin(), Files.end());

  std::string All;
  for (const fs::path &File : Files)
    All += File.filename().string() + stateOf(File);
  return std::to_string(fnv1a(All));
}

std::string Tools::run(std::vector<std::string> Arguments) const {
  if (!Problem.empty())
    return Problem;
  if (mayAskServers())
    if (const auto Answer = askToolServer(
            Arguments[0], {Arguments.begin() + 1, Arguments.end()}))
      return Answer->Code == 0
                 ? std::string()
                 : failure(Arguments[0], Answer->Code,
                           Answer->Printed.substr(0, MaxToolOutput));
  std::vector<char *> Pointers;
  for (std::string &Argument : Arguments)
    Pointers.push_back(Argument.data());
  Pointers.push_back(nullptr);
  std::string Output(remarkOptions() ? MaxRemarks : MaxToolOutput, '\0');
  size_t Bytes = Output.size();
  const int Status =
      pocl_run_command_capture_output(Output.data(), &Bytes, Pointers.data());
  Output.resize(Bytes);
  if (Status == 0) {
    if (remarkOptions())
      printRemarks(Output);
    return {};
  }
  return failure(Arguments[0], Status, Output);
}

std::string Tools::compile(const std::string &Bitcode,
                           const std::string &Object, bool Optimize) const {
  std::vector<std::string> Arguments = {Root + "/bin/vorion-clang",
                                        "-x",
                                        "ir",
                                        Optimize ? "-O2" : "-O0",
                                        "-ffp-contract=off",
                                        "-c",
                                        Bitcode,
                                        "-o",
                                        Object};
  std::istringstream Remarks(remarkOptions() ? remarkOptions() : "");
  for (std::string Option; Remarks >> std::quoted(Option);)
    Arguments.push_back(Option);
  return run(std::move(Arguments));
}

std::string Tools::link(const std::string &Object,
                        const std::string &Image) const {
  return run({Root + "/bin/vorion-link", Object, "-o", Image});
}

} // namespace vorion
