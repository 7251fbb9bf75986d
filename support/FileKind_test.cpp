#include "FolderTest.h"
#include "vorion/support/File.h"
#include "vorion/support/FileKind.h"

#include <cstring>
#include <gtest/gtest.h>
#include <set>

using namespace vorion;
using namespace std::string_literals;

namespace {

std::span<const std::byte> bytesOf(const std::string &Text) {
  return std::as_bytes(std::span(Text));
}

FileKind kindOf(const std::string &Content) {
  return fileKindOf(bytesOf(Content));
}

/// \p Start and zeros.
std::string padded(const std::string &Start, std::size_t Bytes = 512) {
  return Start + std::string(Bytes - Start.size(), '\0');
}

template <typename T> std::string number(T Value) {
  std::string Bytes(sizeof(Value), '\0');
  std::memcpy(Bytes.data(), &Value, sizeof(Value));
  return Bytes;
}

TEST(FileKind, EveryMarkOfTheTableIsKnown) {
#define FILE_MARK(ID, AT, BYTES)                                               \
  EXPECT_EQ(kindOf(padded(std::string(AT, '\1') +                              \
                          std::string(BYTES, sizeof(BYTES) - 1))),             \
            FileKind::ID)                                                      \
      << BYTES;
#include "vorion/support/FileKinds.def"
}

TEST(FileKind, AMarkAtTheBeginningDecidesFirst) {
  EXPECT_EQ(kindOf(padded("!<arch>\nWEBP.o/")), FileKind::ObjectArchive);
}

TEST(FileKind, AReaderAsksForItsOwnMark) {
  EXPECT_TRUE(hasMark(FileKind::Ply, bytesOf("ply\nformat")));
  EXPECT_FALSE(hasMark(FileKind::Ply, bytesOf("plywood")));
  EXPECT_FALSE(hasMark(FileKind::Empty, bytesOf("")));
}

TEST(FileKind, EveryLineOfTheTableIsKnown) {
#define FILE_LINE(ID, BEGINNING)                                               \
  EXPECT_EQ(kindOf("\r\n " BEGINNING "1\nand more\n"), FileKind::ID)           \
      << BEGINNING;
#include "vorion/support/FileKinds.def"
}

TEST(FileKind, EveryKeyOfTheTableIsKnown) {
#define FILE_KEY(ID, KEY)                                                      \
  EXPECT_EQ(kindOf("{\n \"" KEY "\": []}"), FileKind::ID) << KEY;              \
  EXPECT_EQ(objectKindOf([](std::string_view Has) { return Has == KEY; }),     \
            FileKind::ID);
#include "vorion/support/FileKinds.def"
}

TEST(FileKind, EveryEntryOfTheTableIsKnown) {
#define FILE_ENTRY(ID, ENDING)                                                 \
  EXPECT_EQ(archiveKindOf({"first", "a" ENDING}), FileKind::ID) << ENDING;
#include "vorion/support/FileKinds.def"
  const std::string Name = "arr_0.npy";
  EXPECT_EQ(kindOf(padded(padded("PK\3\4", 26) + number<uint16_t>(9) +
                          number<uint16_t>(0) + Name)),
            FileKind::Npz)
      << "by the first entry alone";
}

TEST(FileKind, NamesDiffer) {
  std::set<std::string_view> Known;
  for (auto K = FileKind{}; K != FileKind::Unknown;
       K = static_cast<FileKind>(static_cast<int>(K) + 1)) {
    EXPECT_FALSE(name(K).empty());
    Known.insert(name(K));
  }
  EXPECT_GE(Known.size(), 70U);
}

/// The header of an ELF file.
std::string elf(char Class, char Data, uint16_t Type, uint16_t Machine) {
  return padded("\x7f"
                "ELF"s +
                Class + Data + '\1' + std::string(9, '\0') +
                number<uint16_t>(Type) + number<uint16_t>(Machine));
}

std::string describe(const std::string &Content) {
  return vorion::describe(kindOf(Content), bytesOf(Content));
}

TEST(FileKind, ElfFilesAreToldByMachineAndClass) {
  EXPECT_EQ(describe(elf(2, 1, 3, 62)),
            "an ELF shared library for x86-64 (64-bit)");
  EXPECT_EQ(describe(elf(1, 1, 2, 243)),
            "an ELF executable for RISC-V (32-bit)");
  EXPECT_EQ(describe(elf(1, 2, 0x0100, 0x0800)),
            "an ELF object for MIPS (32-bit, big-endian)");
  EXPECT_EQ(describe(elf(2, 1, 9, 999)),
            "an ELF file for machine number 999 (64-bit)");
  EXPECT_EQ(describe("\x7f"
                     "ELF"),
            "an ELF file");
}

TEST(FileKind, KindsWithoutALongMarkAreKnownByMore) {
  EXPECT_EQ(
      kindOf(padded("BM" + number(70) + number(0) + number(54) + number(40))),
      FileKind::Bmp);
  EXPECT_EQ(kindOf(padded("BM and no more of a picture")), FileKind::Unknown);
  EXPECT_EQ(kindOf(padded(padded("MZ", 0x3c) + number(0x80) +
                          std::string(0x40, '\0') + "PE\0\0"s)),
            FileKind::Pe);
  EXPECT_EQ(kindOf(padded("MZ")), FileKind::Unknown);
  EXPECT_EQ(kindOf(padded("\xca\xfe\xba\xbe\0\0\0\2"s)), FileKind::MachO);
  EXPECT_EQ(kindOf(padded("\xca\xfe\xba\xbe\0\0\0\x3d"s)), FileKind::JavaClass);
  EXPECT_EQ(kindOf(number<uint64_t>(2000) + R"({"weight": {"dtype": "F32"}})"),
            FileKind::Safetensors);
  EXPECT_EQ(kindOf(padded("\x08\x07\x12\x07pytorch\x1a"s)), FileKind::Onnx);
}

TEST(FileKind, ColmapsFilesAreKnownByTheirFirstRecord) {
  const std::string Count = number<uint64_t>(3);
  EXPECT_EQ(kindOf(padded(Count + number(1) + number(4) +
                          number<uint64_t>(1920) + number<uint64_t>(1080))),
            FileKind::ColmapCameras);
  EXPECT_EQ(kindOf(padded(Count + number(1) + number(0.5) + number(0.5) +
                          number(-0.5) + number(0.5))),
            FileKind::ColmapImages);
  EXPECT_EQ(kindOf(padded(Count + number<uint64_t>(7) + number(1.5) +
                          number(-2.0) + number(0.25) + "\x80\x90\xa0" +
                          number(0.7) + number<uint64_t>(3))),
            FileKind::ColmapPoints);
  EXPECT_EQ(kindOf(padded(Count)), FileKind::Unknown);
}

TEST(FileKind, TextsAreToldFromBytesAndByTheirEncoding) {
  EXPECT_EQ(kindOf(""), FileKind::Empty);
  EXPECT_EQ(kindOf("hello\n"), FileKind::PlainText);
  EXPECT_EQ(kindOf("\xef\xbb\xbf[1]"), FileKind::JsonList);
  EXPECT_EQ(kindOf("\xff\xfeh\0e\0l\0l\0o\0"s), FileKind::Utf16);
  EXPECT_EQ(kindOf("\xff\xfeh\0"s), FileKind::Utf16);
  EXPECT_EQ(kindOf("\0h\0e\0l\0l\0o"s), FileKind::Utf16);
  EXPECT_EQ(kindOf("\xff\xfe\0\0h\0\0\0"s), FileKind::Utf32);
  EXPECT_EQ(kindOf(padded("")), FileKind::Unknown);
  EXPECT_EQ(kindOf(number(1.5F) + number(-2.5F) + number(0.125F)),
            FileKind::Unknown);
  EXPECT_TRUE(isText(bytesOf("a\tb\n")));
  EXPECT_FALSE(isText(bytesOf("a\0b"s)));
}

TEST(FileKind, AReaderSaysWhatTheFileIsAndWhatToDo) {
  const auto What = [](const std::string &Content) {
    return otherKind("f", bytesOf(Content), "a thing", "no thing").What;
  };
  EXPECT_EQ(What(padded("%PDF-1.7")), "a document (PDF), expected a thing");
  EXPECT_EQ(What(elf(1, 1, 2, 243)),
            "an ELF executable for RISC-V (32-bit), expected a thing; "
            "`vorion-sim` and `vorion-objdump` read programs of the machine");
  EXPECT_EQ(What(elf(2, 1, 2, 62)),
            "an ELF executable for x86-64 (64-bit), expected a thing; "
            "`vorion-clang` compiles sources for the machine");
  EXPECT_EQ(What(padded("")), "no thing, expected a thing");
}

using FileKindAt = FolderTest;

TEST_F(FileKindAt, AFileThatNobodyReadIsLookedAt) {
  const auto What = [](const std::string &Path) {
    const Error E = otherKindAt(Path, "a thing", "no thing");
    EXPECT_EQ(E.Where, Path);
    return E.What;
  };
  ASSERT_TRUE(writeFileAtomically(path("a"), "\xff\xd8\xff"));
  EXPECT_EQ(What(path("a")),
            "a picture (JPEG), expected a thing; `splat compare` and `splat "
            "train` take pictures");
  EXPECT_EQ(What(path("none")), "no thing, expected a thing");
  EXPECT_EQ(What("/dev/zero"), "no thing, expected a thing");
}

TEST(FileKind, EveryUseButNoneHasAnAdvice) {
  for (auto K = FileKind{}; K != FileKind::Unknown;
       K = static_cast<FileKind>(static_cast<int>(K) + 1))
    EXPECT_EQ(adviceFor(useOf(K)).empty(), useOf(K) == FileUse::Nothing)
        << name(K);
}

} // namespace
