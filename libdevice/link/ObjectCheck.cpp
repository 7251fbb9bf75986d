#include "ObjectCheck.h"

#include "vorion/support/FileKind.h"

#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <elf.h>
#include <fmt/format.h>
#include <optional>
#include <string_view>

using namespace vorion;

namespace {

using Bytes = std::span<const std::byte>;

/// SHT_RISCV_ATTRIBUTES, which older elf.h files lack.
constexpr uint32_t AttributesSectionType = 0x70000003;
/// Tags of the attribute section's file subsection.
constexpr uint64_t TagFile = 1, TagArch = 5;

template <typename T> std::optional<T> readAt(Bytes File, uint64_t Offset) {
  if (Offset > File.size() || File.size() - Offset < sizeof(T))
    return std::nullopt;
  T Value;
  std::memcpy(&Value, File.data() + Offset, sizeof(T));
  return Value;
}

std::optional<Bytes> slice(Bytes File, uint64_t Offset, uint64_t Size) {
  if (Offset > File.size() || File.size() - Offset < Size)
    return std::nullopt;
  return File.subspan(Offset, Size);
}

/// A cursor over an attribute subsection; every take fails at the end.
class Cursor {
public:
  explicit Cursor(Bytes Rest) : Rest(Rest) {}
  bool atEnd() const { return Rest.empty(); }

  std::optional<uint64_t> takeUleb() {
    uint64_t Value = 0;
    for (unsigned Shift = 0; !Rest.empty() && Shift < 63; Shift += 7) {
      const auto Byte = std::to_integer<uint64_t>(Rest.front());
      Rest = Rest.subspan(1);
      Value |= (Byte & 0x7f) << Shift;
      if (!(Byte & 0x80))
        return Value;
    }
    return std::nullopt;
  }

  std::optional<std::string> takeString() {
    const void *End = std::memchr(Rest.data(), 0, Rest.size());
    if (!End)
      return std::nullopt;
    const char *Begin = reinterpret_cast<const char *>(Rest.data());
    std::string Text(Begin, static_cast<const char *>(End));
    Rest = Rest.subspan(Text.size() + 1);
    return Text;
  }

  std::optional<uint32_t> takeWord() {
    const auto Word = readAt<uint32_t>(Rest, 0);
    if (Word)
      Rest = Rest.subspan(sizeof(*Word));
    return Word;
  }

  /// Takes \p Size bytes as a cursor of their own.
  std::optional<Cursor> takeBlock(uint64_t Size) {
    const auto Block = slice(Rest, 0, Size);
    if (Block)
      Rest = Rest.subspan(Size);
    return Block ? std::optional<Cursor>(Cursor(*Block)) : std::nullopt;
  }

private:
  Bytes Rest;
};

/// The architecture in the attributes of one vendor; nothing if absent or
/// malformed.
std::optional<std::string> archOf(Cursor Vendor) {
  while (!Vendor.atEnd()) {
    const auto Tag = Vendor.takeUleb();
    const auto Size = Vendor.takeWord();
    // The size counts the tag (one byte for the tags in use) and itself.
    if (!Tag || !Size || *Size < 5)
      return std::nullopt;
    auto Block = Vendor.takeBlock(*Size - 5);
    if (!Block)
      return std::nullopt;
    while (*Tag == TagFile && !Block->atEnd()) {
      const auto Attribute = Block->takeUleb();
      if (!Attribute)
        return std::nullopt;
      // Odd tags hold text, even ones a number.
      if (*Attribute % 2 == 0) {
        if (!Block->takeUleb())
          return std::nullopt;
        continue;
      }
      auto Text = Block->takeString();
      if (!Text || *Attribute == TagArch)
        return Text;
    }
  }
  return std::nullopt;
}

std::optional<std::string> archOfSection(Bytes Section) {
  Cursor Rest(Section);
  const auto Version = Rest.takeBlock(1);
  if (!Version || std::to_integer<char>(Section[0]) != 'A')
    return std::nullopt;
  while (!Rest.atEnd()) {
    const auto Size = Rest.takeWord();
    if (!Size || *Size < 4)
      return std::nullopt;
    auto Vendor = Rest.takeBlock(*Size - 4);
    const auto Name = Vendor ? Vendor->takeString() : std::nullopt;
    if (!Name)
      return std::nullopt;
    if (*Name == "riscv")
      return archOf(*Vendor);
  }
  return std::nullopt;
}

bool startsWith(Bytes File, std::string_view Magic) {
  return File.size() >= Magic.size() &&
         std::memcmp(File.data(), Magic.data(), Magic.size()) == 0;
}

/// Does \p Arch name extension \p Extension (followed by its version)?
bool hasExtension(std::string_view Arch, std::string_view Extension) {
  for (std::size_t At = Arch.find('_'); At != Arch.npos;
       At = Arch.find('_', At + 1)) {
    const std::string_view Rest = Arch.substr(At + 1);
    if (Rest.starts_with(Extension) && Rest.size() > Extension.size() &&
        std::isdigit(static_cast<unsigned char>(Rest[Extension.size()])))
      return true;
  }
  return false;
}

constexpr std::string_view ArchiveMagic = "!<arch>\n";
/// Sizes and places in an archive's member header, ar(5).
constexpr std::size_t HeaderSize = 60, NameSize = 16, SizeField = 48,
                      SizeWidth = 10;

Expected<Success> checkArchive(Bytes File, const std::string &Archive) {
  Bytes LongNames;
  for (uint64_t At = ArchiveMagic.size(); At < File.size();) {
    const auto Header = slice(File, At, HeaderSize);
    if (!Header)
      return Error{Archive, "truncated archive, expected complete members"};
    const char *Text = reinterpret_cast<const char *>(Header->data());
    std::string Name(Text, NameSize);
    const std::string Digits(Text + SizeField, SizeWidth);
    const uint64_t Size = std::strtoull(Digits.c_str(), nullptr, 10);
    const auto Member = slice(File, At + HeaderSize, Size);
    if (!Member)
      return Error{Archive, "truncated archive, expected complete members"};
    At += HeaderSize + Size + Size % 2;
    if (Name.starts_with("//")) {
      LongNames = *Member;
      continue;
    }
    if (Name.starts_with("/ ") || Name.starts_with("/SYM64/"))
      continue; // the symbol table
    if (Name[0] == '/') {
      const auto Long =
          slice(LongNames, std::strtoull(Name.c_str() + 1, nullptr, 10), 0);
      if (!Long)
        return Error{Archive, "malformed member name, expected an offset into "
                              "the long-name table"};
      const std::string_view Rest(reinterpret_cast<const char *>(Long->data()),
                                  static_cast<std::size_t>(LongNames.data() +
                                                           LongNames.size() -
                                                           Long->data()));
      Name = Rest.substr(0, Rest.find('\n'));
    }
    Name.resize(Name.find('/') == std::string::npos ? Name.size()
                                                    : Name.find('/'));
    const auto Good =
        link::checkInput(*Member, fmt::format("{}({})", Archive, Name));
    if (!Good)
      return Good.error();
  }
  return Success{};
}

} // namespace

Expected<std::string> link::readArchAttribute(Bytes File,
                                              const std::string &Name) {
  const auto Header = readAt<Elf32_Ehdr>(File, 0);
  if (!Header && fileKindOf(File) == FileKind::Elf)
    return Error{Name, "truncated header, expected a complete object"};
  if (!Header || std::memcmp(Header->e_ident, ELFMAG, SELFMAG) != 0 ||
      Header->e_ident[EI_CLASS] != ELFCLASS32 ||
      Header->e_ident[EI_DATA] != ELFDATA2LSB || Header->e_machine != EM_RISCV)
    return otherKind(
        Name, File,
        "an object or archive for RISC-V (32-bit), compiled by vorion-clang",
        "not an ELF file");
  for (unsigned I = 0; I < Header->e_shnum; ++I) {
    const auto Section = readAt<Elf32_Shdr>(
        File, Header->e_shoff + uint64_t{I} * sizeof(Elf32_Shdr));
    if (!Section)
      return Error{Name, "truncated section table, expected a complete object"};
    if (Section->sh_type != AttributesSectionType)
      continue;
    const auto Content = slice(File, Section->sh_offset, Section->sh_size);
    auto Arch = Content ? archOfSection(*Content) : std::nullopt;
    if (!Arch)
      return Error{Name, "malformed .riscv.attributes section, expected one as "
                         "vorion-clang writes it"};
    return *Arch;
  }
  return Error{Name, "has no .riscv.attributes section, expected one that "
                     "names xvortex (compile with vorion-clang)"};
}

Expected<Success> link::checkInput(Bytes File, const std::string &Name) {
  if (startsWith(File, ArchiveMagic))
    return checkArchive(File, Name);
  if (startsWith(File, "!<thin>\n"))
    return Error{Name, "a thin archive, expected a regular archive"};
  const auto Arch = readArchAttribute(File, Name);
  if (!Arch)
    return Arch.error();
  if (!hasExtension(*Arch, "xvortex"))
    return Error{Name, "compiled for " + *Arch +
                           ", which lacks xvortex: scalar code branches "
                           "without splits and is wrong under divergence, "
                           "expected objects of vorion-clang"};
  return Success{};
}
