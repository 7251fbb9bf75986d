#include "Tools.h"

#include "CompilerLibrary.h"
#include "CompilerProcess.h"
#include "FileState.h"
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

/// Where a message of the compiler is cut off.
constexpr size_t MaxPrinted = 65536;

/// Options of vorion-clang, with blanks between and in quotes if they have
/// some: which remarks to print, and -mllvm (docs/backend.md).
const char *remarkOptions() { return environmentVariable("VORION_REMARKS"); }

/// Remarks change the options of LLVM, which one process keeps for all calls.
bool mayStay() {
  const char *Wanted = environmentVariable("VORION_TOOL_SERVERS");
  return !remarkOptions() && !(Wanted && std::string_view(Wanted) == "0");
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
      libraryFile(), pocl::compilerLibraryFile(), compiler(),
      fs::path(Root) / "bin" / "vorion-clang.cfg",
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

MadeImage Tools::makeImage(ImageRequest Request) const {
  const auto Refuse = [](std::string Text, const std::string &Printed,
                         MadeImage::Cause Of) {
    if (!Printed.empty())
      Text += "\n" + Printed.substr(0, MaxPrinted);
    return MadeImage{{}, {}, std::move(Text), Of};
  };
  using enum MadeImage::Cause;
  if (!Problem.empty())
    return Refuse(Problem, {}, Resources);
  std::istringstream Remarks(remarkOptions() ? remarkOptions() : "");
  for (std::string Option; Remarks >> std::quoted(Option);)
    Request.Options.push_back(Option);
  const auto Response = askCompiler(compiler(), textOf(Request), mayStay());
  if (const auto *Why = std::get_if<CompilerFailure>(&Response))
    return Refuse(Why->Text, Why->Printed,
                  Why->LackedResources ? Resources : Kernel);
  ImageAnswer Answer;
  if (!isReadInto(Answer, std::get<std::string>(Response)))
    return Refuse(compiler() + " is of another version", {}, Resources);
  if (Answer.Image.empty())
    return Refuse(
        std::string("cannot be ") +
            (Answer.IsCompiled ? "linked" : "compiled for the machine") +
            ", expected a kernel that can",
        Answer.Printed, Kernel);
  if (remarkOptions())
    printRemarks(Answer.Printed);
  return {std::move(Answer.Image), std::move(Answer.Object), {}, {}};
}

} // namespace vorion
