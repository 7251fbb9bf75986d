#include "Tools.h"

#include "CacheFolders.h"
#include "FileState.h"
#include "vorion/support/Environment.h"
#include "vorion/support/Hash.h"

extern "C" {
#include "pocl_cache_folders.h"
#include "pocl_checked_file.h"
}

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <iomanip>
#include <set>
#include <sstream>

extern char **environ;

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

/// Options of vorion-clang, with blanks between and in quotes if they have
/// some: which remarks to print, and -mllvm (docs/backend.md).
const char *remarkOptions() { return environmentVariable("VORION_REMARKS"); }

/// This process's, with the cache folder that it uses: perhaps one of its own,
/// or one that was named from another current folder.
std::vector<std::string> compilerEnvironment() {
  constexpr std::string_view Cache = "POCL_CACHE_DIR=";
  std::vector<std::string> All;
  for (char **Variable = environ; Variable && *Variable; ++Variable)
    if (!std::string_view(*Variable).starts_with(Cache))
      All.emplace_back(*Variable);
  if (const std::string Folder = usedCacheFolder(); !Folder.empty())
    All.push_back(std::string(Cache) + Folder);
  return All;
}

/// Remarks change the options of LLVM, which one process keeps for all calls.
bool mayStay() {
  const char *Wanted = environmentVariable("VORION_TOOL_SERVERS");
  return !remarkOptions() && !(Wanted && std::string_view(Wanted) == "0");
}

/// How long the compiler may take for a request, in seconds; 0 is for ever. A
/// large kernel takes seconds. Nothing if the variable has no such number.
std::optional<unsigned> compileSeconds() {
  constexpr unsigned Default = 600;
  const char *Given = environmentVariable("VORION_COMPILE_SECONDS");
  if (!Given)
    return Default;
  unsigned Seconds = 0;
  const char *End = Given + std::strlen(Given);
  const auto [Rest, Failed] = std::from_chars(Given, End, Seconds);
  if (Failed != std::errc() || Rest != End)
    return std::nullopt;
  return Seconds;
}

/// Where of bitcode nothing is known but what it says itself, clang prints
/// "remark: k.cl:3:5: text"; everywhere else "k.cl:3:5: remark: text". A kernel
/// with barriers has many loops over its work-items at one place: what is said
/// of a place is said once.
std::string remarksOnce(const std::string &Output) {
  std::string Remarks;
  std::set<std::string> Told;
  constexpr std::string_view Head = "remark: ";
  std::istringstream Lines(Output);
  for (std::string Line; std::getline(Lines, Line);) {
    const size_t End = Line.find(": ", Head.size());
    if (Line.starts_with(Head) && End != std::string::npos)
      Line = Line.substr(Head.size(), End - Head.size()) + ": remark" +
             Line.substr(End);
    if (Told.insert(Line).second)
      Remarks += Line + "\n";
  }
  return Remarks;
}

} // namespace

std::function<void(const CompilerAnswer &)> Tools::Listener;

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
    if (fs::exists(Place / "bin" / "vorion-compiler", Error)) {
      Root = Place;
      return;
    }
  const char *Given = environmentVariable("VORION_ROOT");
  Problem = "cannot find bin/vorion-compiler below " +
            (Given ? "VORION_ROOT, '" + std::string(Given) + "'"
                   : libraryFile().parent_path().string() +
                         " or above; set VORION_ROOT");
}

std::string Tools::compiler() const { return Root + "/bin/vorion-compiler"; }

std::string Tools::fingerprint() const {
  std::vector<fs::path> Files = {
      libraryFile(), compiler(), fs::path(Root) / "bin" / "vorion-clang.cfg",
      fs::path(Root) / "pocl" / "share" / "pocl" / "kernel-vorion.bc"};
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

std::optional<CompilerFailure> Tools::ask(CompilerRequest &Request,
                                          CompilerAnswer &Answer) const {
  if (!Problem.empty())
    return CompilerFailure{Problem, {}, true};
  const auto Seconds = compileSeconds();
  if (!Seconds)
    return CompilerFailure{CompilerProblem +
                               std::string("is not started: VORION_COMPILE_"
                                           "SECONDS has '") +
                               environmentVariable("VORION_COMPILE_SECONDS") +
                               "', expected a whole number",
                           {},
                           true};
  std::error_code Failed;
  Request.Folder = fs::current_path(Failed).string();
  Request.IsKept = pocl_cache_keeps_programs();
  std::istringstream Remarks(remarkOptions() ? remarkOptions() : "");
  for (std::string Option; Remarks >> std::quoted(Option);)
    Request.MachineOptions.push_back(Option);
  auto Response =
      askCompiler({compiler(), compilerEnvironment(), mayStay(), *Seconds},
                  textOf(Request));
  if (auto *Why = std::get_if<CompilerFailure>(&Response))
    return std::move(*Why);
  if (!isReadInto(Answer, std::get<std::string>(Response)))
    return CompilerFailure{compiler() + " is of another version", {}, true};
  if (!Answer.FileProblem.empty())
    pocl_adopt_file_problem(Answer.FileProblem.c_str());
  if (remarkOptions())
    Answer.Printed = remarksOnce(Answer.Printed);
  if (Answer.Problem.empty() && Listener)
    Listener(Answer);
  else if (Answer.Problem.empty())
    std::fputs(Answer.Printed.c_str(), stderr);
  return std::nullopt;
}

} // namespace vorion
