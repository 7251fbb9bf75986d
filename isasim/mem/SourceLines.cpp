#include "mem/SourceLines.h"

#include <dwarf.h>
#include <elfutils/libdw.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <new>

namespace vorion::isasim {

namespace {

/// libdw would end the process with a message and an exit code of its own. The
/// attribute, unlike [[noreturn]], is part of the type, which is as C has it.
__attribute__((noreturn)) void memoryRanOut() {
  if (const std::new_handler Handler = std::get_new_handler())
    Handler();
  throw std::bad_alloc();
}

} // namespace

std::string SourcePlace::text() const {
  return fmt::format("{}{}:{}", IsNear ? "near " : "", File, Line);
}

SourceLines::SourceLines(std::shared_ptr<const Image> ProgramIn)
    : Program(std::move(ProgramIn)) {
  const std::span<const std::byte> All = Program->file();
  Bytes.assign(reinterpret_cast<const char *>(All.data()), All.size());
  elf_version(EV_CURRENT);
  File = elf_memory(Bytes.data(), Bytes.size());
  if (File)
    Info = dwarf_begin_elf(File, DWARF_C_READ, nullptr);
  if (Info)
    dwarf_new_oom_handler(Info, memoryRanOut);
}

SourceLines::~SourceLines() {
  if (Info)
    dwarf_end(Info);
  if (File)
    elf_end(File);
}

namespace {

struct Freer {
  void operator()(Dwarf_Die *Dies) const { std::free(Dies); }
};
using Dies = std::unique_ptr<Dwarf_Die, Freer>;

/// With the unit's folder where the name alone would not be found.
std::string pathOf(Dwarf_Die *Unit, const char *Name) {
  Dwarf_Attribute Attribute;
  const char *Folder =
      dwarf_formstring(dwarf_attr(Unit, DW_AT_comp_dir, &Attribute));
  std::string Path = Name ? Name : "?";
  if (!Folder || Path[0] == '/')
    return Path;
  return (std::filesystem::path(Folder) / Path).lexically_normal();
}

std::optional<Dwarf_Word> number(Dwarf_Die *Die, unsigned Attribute) {
  Dwarf_Attribute Found;
  Dwarf_Word Value = 0;
  if (!dwarf_attr(Die, Attribute, &Found) ||
      dwarf_formudata(&Found, &Value) != 0)
    return std::nullopt;
  return Value;
}

/// Where the function that \p Inlined is a copy of was called.
SourcePlace callPlace(Dwarf_Die *Unit, Dwarf_Die *Inlined) {
  Dwarf_Files *Files = nullptr;
  size_t Count = 0;
  const auto File = number(Inlined, DW_AT_call_file);
  const char *Name = nullptr;
  if (File && dwarf_getsrcfiles(Unit, &Files, &Count) == 0 && *File < Count)
    Name = dwarf_filesrc(Files, *File, nullptr, nullptr);
  return {pathOf(Unit, Name),
          static_cast<unsigned>(number(Inlined, DW_AT_call_line).value_or(0)),
          "", false};
}

} // namespace

/// The unit that \p Pc lies in; false if there is none.
static bool unitAt(Dwarf *Info, uint32_t Pc, Dwarf_Die *Unit) {
  // Units made without a table of ranges are searched one by one.
  if (dwarf_addrdie(Info, Pc, Unit))
    return true;
  Dwarf_CU *Next = nullptr;
  Dwarf_Die Sub;
  uint8_t Kind = 0;
  while (dwarf_get_units(Info, Next, &Next, nullptr, &Kind, Unit, &Sub) == 0)
    if (dwarf_haspc(Unit, Pc) > 0)
      return true;
  return false;
}

/// 0 means that the code belongs to no line.
static unsigned lineOf(Dwarf_Line *Line) {
  int Number = 0;
  return Line && dwarf_lineno(Line, &Number) == 0
             ? static_cast<unsigned>(Number)
             : 0;
}

/// The last row before \p Pc, in the same function, that has a line; null if
/// there is none.
static Dwarf_Line *lineBefore(Dwarf_Die *Unit, uint32_t Pc) {
  Dwarf_Lines *Rows = nullptr;
  size_t Count = 0;
  if (dwarf_getsrclines(Unit, &Rows, &Count) != 0)
    return nullptr;
  Dwarf_Line *Found = nullptr;
  for (size_t N = 0; N < Count; ++N) {
    Dwarf_Line *Row = dwarf_onesrcline(Rows, N);
    Dwarf_Addr Address = 0;
    bool EndsFunction = false;
    if (!Row || dwarf_lineaddr(Row, &Address) != 0 || Address > Pc ||
        dwarf_lineendsequence(Row, &EndsFunction) != 0)
      break;
    if (EndsFunction)
      Found = nullptr;
    else if (lineOf(Row) != 0)
      Found = Row;
  }
  return Found;
}

std::vector<SourcePlace> SourceLines::chain(uint32_t Pc) const {
  Dwarf_Die Unit;
  if (!Info || !unitAt(Info, Pc, &Unit))
    return {};
  Dwarf_Line *Line = dwarf_getsrc_die(&Unit, Pc);
  const bool HasOwn = lineOf(Line) != 0;
  if (!HasOwn)
    Line = lineBefore(&Unit, Pc);
  if (!Line)
    return {};
  SourcePlace Here{pathOf(&Unit, dwarf_linesrc(Line, nullptr, nullptr)),
                   lineOf(Line), "", !HasOwn};

  // The innermost scope there, then those around it. (dwarf_getscopes goes on
  // from an inlined function to where it was written, not to its caller.)
  Dwarf_Die *Raw = nullptr;
  if (dwarf_getscopes(&Unit, Pc, &Raw) <= 0)
    return {Here};
  const Dies Inner(Raw);
  const int Count = dwarf_getscopes_die(&Inner.get()[0], &Raw);
  if (Count <= 0)
    return {Here};
  const Dies Scopes(Raw);
  std::vector<SourcePlace> Places;
  for (int N = 0; N < Count; ++N) {
    const int Tag = dwarf_tag(&Raw[N]);
    if (Tag != DW_TAG_inlined_subroutine && Tag != DW_TAG_subprogram)
      continue;
    const char *Name = dwarf_diename(&Raw[N]);
    Here.Function = Name ? Name : "";
    // A kernel is inlined into a function of its name, which runs a group.
    if (Places.empty() || Places.back().Function != Here.Function)
      Places.push_back(Here);
    if (Tag == DW_TAG_subprogram)
      break;
    Here = callPlace(&Unit, &Raw[N]);
  }
  if (Places.empty())
    Places.push_back(Here);
  return Places;
}

const std::optional<SourcePlace> &SourceLines::nearest(uint32_t Pc) const {
  const auto [At, New] = Known.emplace(Pc, std::nullopt);
  if (!New)
    return At->second;
  if (std::vector<SourcePlace> Places = chain(Pc); !Places.empty())
    At->second = std::move(Places.front());
  return At->second;
}

std::optional<SourcePlace> SourceLines::find(uint32_t Pc) const {
  const std::optional<SourcePlace> &Place = nearest(Pc);
  return Place && !Place->IsNear ? Place : std::nullopt;
}

std::string SourceLines::describe(uint32_t Pc) const {
  const std::string Symbol = Program->symbolize(Pc);
  const std::optional<SourcePlace> &Place = nearest(Pc);
  if (!Place)
    return Symbol.empty() ? fmt::format("0x{:08x}", Pc) : Symbol;
  return Place->Function.empty()
             ? Place->text()
             : fmt::format("{} ({})", Place->text(), Place->Function);
}

} // namespace vorion::isasim
