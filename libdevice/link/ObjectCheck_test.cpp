#include "ObjectCheck.h"

#include <cstdio>
#include <cstring>
#include <elf.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <vector>

using namespace vorion;

namespace {

using Buffer = std::vector<std::byte>;

void append(Buffer &To, const void *From, std::size_t Size) {
  const auto *Bytes = static_cast<const std::byte *>(From);
  To.insert(To.end(), Bytes, Bytes + Size);
}
void append(Buffer &To, std::string_view Text) {
  append(To, Text.data(), Text.size());
}
void appendWord(Buffer &To, uint32_t Word) { append(To, &Word, 4); }

/// An attribute section that names \p Arch after an attribute of either kind.
Buffer attributes(const std::string &Arch) {
  Buffer File;
  append(File, std::string("\x04\x10", 2)); // Tag_RISCV_stack_align = 16
  append(File, std::string("\x05", 1) + Arch);
  File.push_back(std::byte{0});
  Buffer Vendor;
  append(Vendor, std::string("riscv\0\x01", 7));
  appendWord(Vendor, static_cast<uint32_t>(File.size() + 5));
  append(Vendor, File.data(), File.size());
  Buffer Section;
  append(Section, "A");
  appendWord(Section, static_cast<uint32_t>(Vendor.size() + 4));
  append(Section, Vendor.data(), Vendor.size());
  return Section;
}

/// The smallest ELF file with \p Section as its attribute section.
Buffer object(const Buffer &Section, uint16_t Machine = EM_RISCV) {
  Elf32_Ehdr Header{};
  std::memcpy(Header.e_ident, ELFMAG, SELFMAG);
  Header.e_ident[EI_CLASS] = ELFCLASS32;
  Header.e_ident[EI_DATA] = ELFDATA2LSB;
  Header.e_machine = Machine;
  Header.e_shoff = sizeof(Header);
  Header.e_shnum = 1;
  Elf32_Shdr Entry{};
  Entry.sh_type = 0x70000003;
  Entry.sh_offset = sizeof(Header) + sizeof(Entry);
  Entry.sh_size = static_cast<uint32_t>(Section.size());
  Buffer File;
  append(File, &Header, sizeof(Header));
  append(File, &Entry, sizeof(Entry));
  append(File, Section.data(), Section.size());
  return File;
}

Buffer archive(const std::vector<std::pair<std::string, Buffer>> &Members) {
  Buffer File;
  append(File, "!<arch>\n");
  for (const auto &[Name, Content] : Members) {
    char Header[61];
    std::snprintf(Header, sizeof(Header), "%-16s%-12d%-6d%-6d%-8d%-10zu`\n",
                  Name.c_str(), 0, 0, 0, 644, Content.size());
    append(File, Header, 60);
    append(File, Content.data(), Content.size());
    if (Content.size() % 2)
      append(File, "\n");
  }
  return File;
}

std::string messageOf(const Buffer &File) {
  const auto Result = link::checkInput(File, "f");
  return Result ? "" : Result.error().Where + ": " + Result.error().What;
}

const std::string Good = "rv32i2p1_m2p0_f2p2_zicsr2p0_xvortex1p0_xvorion1p0";

TEST(ObjectCheck, TakesAnObjectForXVortex) {
  EXPECT_EQ(messageOf(object(attributes(Good))), "");
  EXPECT_EQ(*link::readArchAttribute(object(attributes(Good)), "f"), Good);
}

TEST(ObjectCheck, RefusesAScalarObjectAndNamesItsArchitecture) {
  EXPECT_NE(
      messageOf(object(attributes("rv32i2p1_m2p0_f2p2")))
          .find("f: compiled for rv32i2p1_m2p0_f2p2, which lacks xvortex"),
      std::string::npos);
}

TEST(ObjectCheck, ALongerExtensionNameIsNotXVortex) {
  const std::string Longer = "rv32i2p1_xvortexlike1p0";
  EXPECT_NE(messageOf(object(attributes(Longer))), "");
  EXPECT_EQ(messageOf(object(attributes(Longer + "_xvortex1p0"))), "");
}

TEST(ObjectCheck, RefusesAnObjectWithoutAttributes) {
  Buffer File = object(attributes(Good));
  auto *Entry =
      reinterpret_cast<Elf32_Shdr *>(File.data() + sizeof(Elf32_Ehdr));
  Entry->sh_type = SHT_PROGBITS;
  EXPECT_NE(messageOf(File).find("has no .riscv.attributes"),
            std::string::npos);
}

TEST(ObjectCheck, RefusesOtherMachinesAndOtherFiles) {
  EXPECT_NE(messageOf(object(attributes(Good), EM_X86_64))
                .find("for x86-64 (32-bit), expected an object"),
            std::string::npos);
  Buffer Text;
  append(Text, "hello");
  EXPECT_NE(messageOf(Text).find("a text, expected"), std::string::npos);
  Buffer Bitcode;
  append(Bitcode, "BC\xC0\xDE....");
  EXPECT_NE(messageOf(Bitcode).find("bitcode"), std::string::npos);
  EXPECT_NE(messageOf({}).find("an empty file"), std::string::npos);
}

TEST(ObjectCheck, AnArchiveIsAsGoodAsItsMembers) {
  const Buffer Fine = object(attributes(Good));
  const Buffer Scalar = object(attributes("rv32i2p1"));
  Buffer Symbols, Names;
  append(Symbols, "abc");
  append(Names, "a-name-that-is-quite-long.o/\n");
  EXPECT_EQ(messageOf(archive({{"/", Symbols}, {"a.o/", Fine}})), "");
  EXPECT_NE(messageOf(archive({{"a.o/", Fine}, {"b.o/", Scalar}}))
                .find("f(b.o): compiled for rv32i2p1"),
            std::string::npos);
  EXPECT_NE(messageOf(archive({{"//", Names}, {"/0", Scalar}}))
                .find("f(a-name-that-is-quite-long.o)"),
            std::string::npos);
}

// Whatever is cut off or changed, the answer is a message or a name, and no
// read leaves the file (the sanitizer builds watch that).
RC_GTEST_PROP(ObjectCheck, AnyDamageIsSurvived,
              (uint16_t Cut, uint16_t At, uint8_t Value)) {
  for (Buffer File :
       {object(attributes(Good)),
        archive({{"//", Buffer(30)}, {"/3", object(attributes(Good))}})}) {
    File[At % File.size()] = std::byte{Value};
    File.resize(File.size() - Cut % File.size());
    const std::string Message = messageOf(File);
    RC_ASSERT(Message.empty() ||
              (Message.starts_with("f") &&
               Message.find("expected") != std::string::npos));
  }
}

} // namespace
