#include "observe/SourceLines.h"

#include <dwarf.h>
#include <elfutils/libdw.h>
#include <fmt/format.h>

#include <cstdlib>

namespace vorion::isasim {

std::string SourcePlace::text() const {
  return fmt::format("{}:{}", File, Line);
}

SourceLines::SourceLines(std::shared_ptr<const Image> ProgramIn)
    : Program(std::move(ProgramIn)) {
  const std::span<const std::byte> All = Program->file();
  Bytes.assign(reinterpret_cast<const char *>(All.data()), All.size());
  elf_version(EV_CURRENT);
  File = elf_memory(Bytes.data(), Bytes.size());
  if (File)
    Info = dwarf_begin_elf(File, DWARF_C_READ, nullptr);
}

SourceLines::~SourceLines() {
  if (Info)
    dwarf_end(Info);
  if (File)
    elf_end(File);
}

/// The innermost function of \p Unit at \p Pc.
static std::string functionAt(Dwarf_Die *Unit, uint32_t Pc) {
  Dwarf_Die *Scopes = nullptr;
  const int Count = dwarf_getscopes(Unit, Pc, &Scopes);
  std::string Name;
  for (int N = 0; N < Count && Name.empty(); ++N) {
    const int Tag = dwarf_tag(&Scopes[N]);
    if (Tag != DW_TAG_subprogram && Tag != DW_TAG_inlined_subroutine)
      continue;
    Dwarf_Attribute Attribute;
    if (const char *Found = dwarf_formstring(
            dwarf_attr_integrate(&Scopes[N], DW_AT_name, &Attribute)))
      Name = Found;
  }
  std::free(Scopes);
  return Name;
}

std::optional<SourcePlace> SourceLines::find(uint32_t Pc) const {
  if (!Info)
    return std::nullopt;
  const auto [At, New] = Known.emplace(Pc, std::nullopt);
  if (!New)
    return At->second;
  Dwarf_Die Unit;
  // Units made without a table of ranges are searched one by one.
  if (!dwarf_addrdie(Info, Pc, &Unit)) {
    Dwarf_CU *Next = nullptr;
    bool Found = false;
    Dwarf_Die Sub;
    uint8_t Kind = 0;
    while (!Found &&
           dwarf_get_units(Info, Next, &Next, nullptr, &Kind, &Unit, &Sub) == 0)
      Found = dwarf_haspc(&Unit, Pc) > 0;
    if (!Found)
      return std::nullopt;
  }
  Dwarf_Line *Line = dwarf_getsrc_die(&Unit, Pc);
  int Number = 0;
  // Line 0 means that the code belongs to none.
  if (!Line || dwarf_lineno(Line, &Number) != 0 || Number == 0)
    return std::nullopt;
  const char *Name = dwarf_linesrc(Line, nullptr, nullptr);
  Dwarf_Attribute Attribute;
  const char *Folder =
      dwarf_formstring(dwarf_attr(&Unit, DW_AT_comp_dir, &Attribute));
  std::string Path = Name ? Name : "?";
  if (Folder && Path[0] != '/')
    Path = fmt::format("{}/{}", Folder, Path);
  At->second = SourcePlace{std::move(Path), static_cast<unsigned>(Number),
                           functionAt(&Unit, Pc)};
  return At->second;
}

std::string SourceLines::describe(uint32_t Pc) const {
  const std::string Symbol = Program->symbolize(Pc);
  const std::optional<SourcePlace> Place = find(Pc);
  if (!Place)
    return Symbol.empty() ? fmt::format("0x{:08x}", Pc) : Symbol;
  return Place->Function.empty()
             ? Place->text()
             : fmt::format("{} ({})", Place->text(), Place->Function);
}

} // namespace vorion::isasim
