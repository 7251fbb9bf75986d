/// Executables for tests, made in memory.
#pragma once

#include "core/IsaTables.h"
#include "vorion/isasim/Image.h"

#include <cstring>
#include <elf.h>
#include <gtest/gtest.h>

namespace vorion::isasim::testing {

struct ElfSegment {
  uint32_t Address;
  uint32_t Flags; ///< PF_R, PF_W, PF_X
  std::vector<uint32_t> Words;
  uint32_t ZeroBytes = 0; ///< memory beyond Words
};

struct ElfOptions {
  std::vector<ElfSegment> Segments;
  uint32_t Entry = VX_IMAGE_BASE;
  uint16_t Machine = EM_RISCV;
  uint16_t Type = ET_EXEC;
  uint8_t Class = ELFCLASS32;
  uint8_t Data = ELFDATA2LSB;
  uint32_t Flags = 2; ///< ilp32f
  /// Symbols of no type in section 1.
  std::vector<std::pair<std::string, uint32_t>> Symbols;
  std::vector<std::pair<std::string, uint32_t>> AbsoluteSymbols;
  /// How often the section vorion_atomics is there, and its words.
  unsigned AtomicSections = 1;
  std::vector<uint32_t> Atomics;
};

inline std::vector<std::byte> buildElf(const ElfOptions &O) {
  std::vector<std::byte> File(sizeof(Elf32_Ehdr) +
                              O.Segments.size() * sizeof(Elf32_Phdr));
  auto Append = [&](const void *Data, size_t Bytes) {
    const size_t At = File.size();
    File.resize(At + Bytes);
    if (Bytes)
      std::memcpy(File.data() + At, Data, Bytes);
    return static_cast<uint32_t>(At);
  };
  for (size_t N = 0; N != O.Segments.size(); ++N) {
    const ElfSegment &S = O.Segments[N];
    Elf32_Phdr P{};
    P.p_type = PT_LOAD;
    P.p_vaddr = P.p_paddr = S.Address;
    P.p_filesz = static_cast<uint32_t>(S.Words.size() * 4);
    P.p_memsz = P.p_filesz + S.ZeroBytes;
    P.p_flags = S.Flags;
    P.p_offset = Append(S.Words.data(), P.p_filesz);
    std::memcpy(File.data() + sizeof(Elf32_Ehdr) + N * sizeof(P), &P,
                sizeof(P));
  }
  // Sections: none, strings (of symbols and sections), symbols, and atomics.
  std::string Strings(1, '\0');
  std::vector<Elf32_Sym> Symbols(1);
  const auto AddSymbols = [&](const auto &Each, uint16_t Section) {
    for (const auto &[Name, Address] : Each) {
      Elf32_Sym S{};
      S.st_name = static_cast<uint32_t>(Strings.size());
      S.st_value = Address;
      S.st_shndx = Section;
      Strings += Name + '\0';
      Symbols.push_back(S);
    }
  };
  AddSymbols(O.Symbols, 1);
  AddSymbols(O.AbsoluteSymbols, SHN_ABS);
  std::vector<Elf32_Shdr> Sections(3);
  if (!O.Atomics.empty()) {
    Elf32_Shdr S{};
    S.sh_name = static_cast<uint32_t>(Strings.size());
    Strings += std::string("vorion_atomics") + '\0';
    S.sh_type = SHT_PROGBITS;
    S.sh_size = static_cast<uint32_t>(O.Atomics.size() * 4);
    S.sh_offset = Append(O.Atomics.data(), S.sh_size);
    Sections.insert(Sections.end(), O.AtomicSections, S);
  }
  Sections[1].sh_type = SHT_STRTAB;
  Sections[1].sh_offset = Append(Strings.data(), Strings.size());
  Sections[1].sh_size = static_cast<uint32_t>(Strings.size());
  Sections[2].sh_type = SHT_SYMTAB;
  Sections[2].sh_offset =
      Append(Symbols.data(), Symbols.size() * sizeof(Elf32_Sym));
  Sections[2].sh_size =
      static_cast<uint32_t>(Symbols.size() * sizeof(Elf32_Sym));
  Sections[2].sh_link = 1;
  Sections[2].sh_entsize = sizeof(Elf32_Sym);

  Elf32_Ehdr H{};
  std::memcpy(H.e_ident, ELFMAG, SELFMAG);
  H.e_ident[EI_CLASS] = O.Class;
  H.e_ident[EI_DATA] = O.Data;
  H.e_ident[EI_VERSION] = EV_CURRENT;
  H.e_type = O.Type;
  H.e_machine = O.Machine;
  H.e_version = EV_CURRENT;
  H.e_entry = O.Entry;
  H.e_phoff = sizeof(Elf32_Ehdr);
  H.e_flags = O.Flags;
  H.e_ehsize = sizeof(Elf32_Ehdr);
  H.e_phentsize = sizeof(Elf32_Phdr);
  H.e_phnum = static_cast<uint16_t>(O.Segments.size());
  H.e_shentsize = sizeof(Elf32_Shdr);
  H.e_shnum = static_cast<uint16_t>(Sections.size());
  H.e_shstrndx = 1;
  H.e_shoff = Append(Sections.data(), Sections.size() * sizeof(Elf32_Shdr));
  std::memcpy(File.data(), &H, sizeof(H));
  return File;
}

/// An image of \p Words at the start of the image range.
inline std::shared_ptr<const Image>
codeImage(const std::vector<uint32_t> &Words) {
  ElfOptions O;
  O.Segments.push_back({VX_IMAGE_BASE, PF_R | PF_X, Words});
  auto Program = Image::parse(buildElf(O), "test");
  EXPECT_TRUE(Program) << Program.error().What;
  return *Program;
}

} // namespace vorion::isasim::testing
