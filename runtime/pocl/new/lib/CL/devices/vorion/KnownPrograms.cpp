#include "KnownPrograms.h"

#include "FileState.h"

extern "C" {
#include "pocl_cache.h"
#include "pocl_cache_folders.h"
#include "pocl_checked_file.h"
#include "pocl_file_util.h"
#include "pocl_runtime_config.h"
#include "pocl_util.h"
}

#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>

namespace fs = std::filesystem;

namespace vorion {

namespace {

bool isOfWord(char C) {
  return std::isalnum(static_cast<unsigned char>(C)) || C == '_';
}

/// Without the ends of lines behind a backslash, which may stand in a word.
std::string withJoinedLines(std::string_view Text) {
  std::string Joined;
  Joined.reserve(Text.size());
  for (size_t I = 0; I < Text.size(); ++I) {
    size_t End = I + 1;
    if (Text[I] == '\\') {
      while (End < Text.size() && Text[End] != '\n' &&
             std::isspace(static_cast<unsigned char>(Text[End])))
        ++End;
      if (End < Text.size() && Text[End] == '\n') {
        I = End;
        continue;
      }
    }
    Joined += Text[I];
  }
  return Joined;
}

std::string_view withoutBlanks(std::string_view Text) {
  const size_t First = Text.find_first_not_of(" \t\r");
  return First == Text.npos ? std::string_view() : Text.substr(First);
}

/// Whether a line with the word `include` names one of the toolchain's headers,
/// which the fingerprint of the tools covers.
bool includesOurs(std::string_view Line, const Tools &ToolSet) {
  Line = withoutBlanks(Line);
  for (const std::string_view Word : {"#", "include", "<"}) {
    if (!Line.starts_with(Word))
      return false;
    Line = withoutBlanks(Line.substr(Word.size()));
  }
  const size_t End = Line.find('>');
  if (End == Line.npos || Line.substr(0, End).find('/') != Line.npos)
    return false;
  std::error_code Error;
  return fs::is_regular_file(
      fs::path(ToolSet.includeFolder()) / Line.substr(0, End), Error);
}

/// Whether the text gives the same program for as long as neither it nor the
/// compiler changes. In doubt it does not.
bool namesItsProgram(const char *Source, const char *Options,
                     const Tools &ToolSet) {
  std::istringstream Words(Options ? Options : "");
  for (std::string Word; Words >> Word;)
    if (Word.starts_with("-i")) // -include and its kin
      return false;
  if (std::strstr(Source, "?\?/")) // a backslash to some
    return false;
  const std::string Joined = withJoinedLines(Source);
  const std::string_view Text = Joined;
  for (size_t I = 0; I < Text.size();) {
    if (!isOfWord(Text[I])) {
      ++I;
      continue;
    }
    const size_t Begin = I;
    while (I < Text.size() && isOfWord(Text[I]))
      ++I;
    const std::string_view Word = Text.substr(Begin, I - Begin);
    if (Word == "include") {
      const size_t Line = Text.rfind('\n', Begin) + 1;
      if (!includesOurs(Text.substr(Line, Text.find('\n', Begin) - Line),
                        ToolSet))
        return false;
    }
    for (const char *Other :
         {"include_next", "import", "embed", "__has_include",
          "__has_include_next", "__has_embed"})
      if (Word == Other)
        return false;
  }
  return true;
}

/// State and path.
std::string lineOf(const fs::path &File) {
  return stateOf(File) + " " + File.string() + "\n";
}

/// What made a program, beside what the fingerprint of the tools covers: the
/// headers in front of every program. A line each.
std::string headerFiles() {
  std::string Files;
  char Data[POCL_MAX_PATHNAME_LENGTH];
  pocl_get_private_datadir(Data);
  std::error_code Error;
  for (const auto &Entry :
       fs::directory_iterator(fs::path(Data) / "include", Error))
    Files += lineOf(Entry.path());
  return Files;
}

/// Whether all files are as these lines say.
bool areUnchanged(const std::string &Files) {
  std::istringstream Lines(Files);
  for (std::string Line; std::getline(Lines, Line);) {
    const size_t Path = Line.find(' ', Line.find(' ') + 1) + 1;
    if (Path == 0 || lineOf(Line.substr(Path)) != Line + "\n")
      return false;
  }
  return true;
}

/// Where the kernel cache has what is known of the program's text. Empty if it
/// cannot be there. The program's hash becomes that of the text.
std::string placeOf(cl_program Program, cl_uint Index, const Tools &ToolSet) {
  if (!pocl_get_bool_option("POCL_KERNEL_CACHE", 1) ||
      !pocl_cache_keeps_programs() ||
      pocl_get_bool_option("POCL_LEAVE_KERNEL_COMPILER_TEMP_FILES", 0) ||
      !namesItsProgram(Program->source, Program->compiler_options, ToolSet))
    return {};
  // No preprocessed text begins so.
  const std::string Key = std::string("#text\n") + Program->source;
  char Path[POCL_MAX_PATHNAME_LENGTH];
  if (pocl_cache_create_program_cachedir(Program, Index, Key.data(), Key.size(),
                                         Path))
    return {};
  return fs::path(Path).replace_filename("known").string();
}

} // namespace

bool takeKnownProgram(cl_program Program, cl_uint Index, const Tools &ToolSet) {
  auto &Hash = Program->build_hash[Index];
  const std::string Place = placeOf(Program, Index, ToolSet);
  char *Known = nullptr, *Binary = nullptr;
  uint64_t Size = 0;
  if (!Place.empty() && pocl_read_checked_file(Place.c_str(), &Known, &Size) ==
                            POCL_CHECKED_FILE_OK) {
    if (Size >= sizeof(Hash) &&
        areUnchanged(std::string(Known + sizeof(Hash), Size - sizeof(Hash)))) {
      std::memcpy(Hash, Known, sizeof(Hash));
      char Path[POCL_MAX_PATHNAME_LENGTH];
      pocl_cache_program_bc_path(Path, Program, Index);
      const auto Found = pocl_read_checked_file(Path, &Binary, &Size);
      if (Found != POCL_CHECKED_FILE_OK)
        Binary = nullptr;
      if (Found == POCL_CHECKED_FILE_DAMAGED) // it is made again, with its log
        pocl_cache_forget_buildlog(Program, Index);
    }
    std::free(Known);
  }
  if (!Binary) {
    std::memset(Hash, 0, sizeof(Hash));
    return false;
  }
  POCL_MEM_FREE(Program->binaries[Index]);
  Program->binaries[Index] = reinterpret_cast<unsigned char *>(Binary);
  Program->binary_sizes[Index] = Size;
  return true;
}

void keepKnownProgram(cl_program Program, cl_uint Index, const Tools &ToolSet) {
  auto &Hash = Program->build_hash[Index];
  if (Hash[0] == '_') // it goes with this program (pocl_cache_folders.h)
    return;
  const std::string Built(reinterpret_cast<const char *>(Hash), sizeof(Hash));
  const std::string Place = placeOf(Program, Index, ToolSet);
  std::memcpy(Hash, Built.data(), sizeof(Hash));
  if (Place.empty())
    return;
  const std::string Known = Built + headerFiles();
  pocl_write_checked_file(Place.c_str(), Known.data(), Known.size());
}

} // namespace vorion
