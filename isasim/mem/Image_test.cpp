/// Executables: good ones, each way of being bad, and every truncation.

#include "testing/ElfBuilder.h"

#include <random>

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr uint32_t Nop = 0x00000013;
constexpr uint32_t Table = VX_IMAGE_BASE + 0x1000;

ElfOptions good() {
  ElfOptions O;
  O.Segments = {{VX_IMAGE_BASE, PF_R | PF_X, {Nop, Nop}, 0}};
  O.Symbols = {{"_start", VX_IMAGE_BASE}};
  return O;
}

/// With a kernel "add" of two arguments.
ElfOptions withKernel() {
  ElfOptions O = good();
  // Record, two arguments, then the names.
  const uint32_t Args = Table + sizeof(VxKernel);
  const uint32_t Names = Args + 2 * sizeof(VxKernelArg);
  O.Segments.push_back({Table,
                        PF_R,
                        {Names,
                         VX_IMAGE_BASE + 4,
                         Args,
                         2,
                         8,
                         12,
                         256,
                         16,
                         1,
                         1,
                         8,
                         4096, // vx_kernel
                         Names + 4,
                         VX_ARG_GLOBAL,
                         0,
                         4,
                         Names + 6,
                         VX_ARG_VALUE,
                         4,
                         4,
                         0x00646461 /* add */,
                         0x006E0061 /* a, n */},
                        0});
  O.Symbols.push_back({"__start_vorion_kernels", Table});
  O.Symbols.push_back({"__stop_vorion_kernels",
                       Table + static_cast<uint32_t>(sizeof(VxKernel))});
  return O;
}

std::string wrongIn(const ElfOptions &O) {
  const auto I = Image::parse(buildElf(O), "x.elf");
  return I ? "" : I.error().What;
}

} // namespace

TEST(Image, ReadsSegmentsAndSymbols) {
  ElfOptions O = good();
  O.Segments.push_back({VX_IMAGE_BASE + 0x2000, PF_R | PF_W, {7, 8}, 100});
  const auto I = Image::parse(buildElf(O), "x.elf");
  ASSERT_TRUE(I) << I.error().What;
  EXPECT_EQ((*I)->entry(), VX_IMAGE_BASE);
  ASSERT_EQ((*I)->segments().size(), 2U);
  EXPECT_TRUE((*I)->segments()[0].Executable);
  EXPECT_TRUE((*I)->segments()[1].Writable);
  EXPECT_EQ((*I)->segments()[1].MemBytes, 108U);
  EXPECT_EQ((*I)->findSymbol("_start"), VX_IMAGE_BASE);
  EXPECT_FALSE((*I)->findSymbol("nothing"));
  EXPECT_EQ((*I)->symbolize(VX_IMAGE_BASE + 4), "_start+0x4");
  EXPECT_EQ((*I)->symbolize(VX_IMAGE_BASE - 4), "");
  EXPECT_EQ((*I)->bytesAt(VX_IMAGE_BASE + 0x2004, 4).size(), 4U);
  EXPECT_TRUE((*I)->bytesAt(VX_IMAGE_BASE + 0x2006, 4).empty());
}

TEST(Image, ReadsTheKernelTable) {
  const auto I = Image::parse(buildElf(withKernel()), "x.elf");
  ASSERT_TRUE(I) << I.error().What;
  ASSERT_EQ((*I)->kernels().size(), 1U);
  const Kernel *K = (*I)->findKernel("add");
  ASSERT_NE(K, nullptr);
  EXPECT_EQ(K->Entry, VX_IMAGE_BASE + 4);
  EXPECT_EQ(K->ArgsBytes, 8U);
  EXPECT_EQ(K->ContextBytes, 12U);
  EXPECT_EQ(K->LocalBytes, 256U);
  EXPECT_EQ(K->LocalSize[0], 16U);
  EXPECT_EQ(K->Lanes, 8U);
  EXPECT_EQ(K->StackBytes, 4096U);
  EXPECT_EQ(K->contextBytesOf(8), 8U * 12);
  EXPECT_EQ(K->contextBytesOf(9), 16U * 12);
  ASSERT_EQ(K->Args.size(), 2U);
  EXPECT_EQ(K->Args[0].Name, "a");
  EXPECT_EQ(K->Args[0].Kind, VX_ARG_GLOBAL);
  EXPECT_EQ(K->Args[1].Name, "n");
  EXPECT_EQ(K->Args[1].Offset, 4U);
  EXPECT_EQ((*I)->findKernel("sub"), nullptr);
}

TEST(Image, KnowsForHowManyLanesItIs) {
  ElfOptions O = withKernel();
  const auto I = Image::parse(buildElf(O), "x.elf");
  ASSERT_TRUE(I) << I.error().What;
  EXPECT_TRUE((*I)->checkLanes(8));
  const auto Wrong = (*I)->checkLanes(16);
  ASSERT_FALSE(Wrong);
  EXPECT_EQ(Wrong.error().Where, "x.elf");
  EXPECT_EQ(Wrong.error().What,
            "kernel 'add' was compiled for warps of 8 lanes, expected 16 as in "
            "the machine (the compiler reads VORION_SET and VORION_CONFIG)");
  EXPECT_FALSE((*I)->checkLanes(16, "add"));
  EXPECT_TRUE((*I)->checkLanes(16, "another"));
  O.Segments[1].Words[10] = 0;
  const auto Any = Image::parse(buildElf(O), "x.elf");
  ASSERT_TRUE(Any) << Any.error().What;
  EXPECT_TRUE((*Any)->checkLanes(16));
}

TEST(Image, RefusesOtherMachines) {
  EXPECT_EQ(Image::parse({}, "x.elf").error().What,
            "an empty file, expected an ELF executable for RISC-V (32-bit)");
  ElfOptions O = good();
  O.Class = ELFCLASS64;
  constexpr const char *Wanted =
      ", expected an ELF executable for RISC-V (32-bit); `vorion-clang` "
      "compiles sources for the machine";
  EXPECT_EQ(wrongIn(O),
            std::string("an ELF executable for RISC-V (64-bit)") + Wanted);
  O = good();
  O.Data = ELFDATA2MSB;
  EXPECT_TRUE(
      wrongIn(O).ends_with(std::string("(32-bit, big-endian)") + Wanted));
  O = good();
  O.Machine = EM_X86_64;
  EXPECT_EQ(wrongIn(O),
            std::string("an ELF executable for x86-64 (32-bit)") + Wanted);
  O = good();
  O.Type = ET_REL;
  EXPECT_EQ(wrongIn(O),
            "ELF type 1, expected 2 (executable); link the object first");
  O = good();
  O.Flags = 3;
  EXPECT_EQ(wrongIn(O), "compressed instructions, expected code without the C "
                        "extension");
  O.Flags = 4;
  EXPECT_EQ(wrongIn(O), "wrong floating-point ABI, expected ilp32f or ilp32");
  O.Flags = 0;
  EXPECT_EQ(wrongIn(O), "");
  O.Flags = 10;
  EXPECT_EQ(wrongIn(O), "RV32E code, expected RV32I");
  O = good();
  O.Segments.clear();
  EXPECT_EQ(wrongIn(O), "no program headers, expected a linked executable");
}

TEST(Image, RefusesBadSegments) {
  ElfOptions O = good();
  O.Segments[0].Address = 0x10000;
  EXPECT_EQ(wrongIn(O), "segment 0 at 0x00010000, 0x8 bytes, expected it "
                        "within 0x80000000 and 0x81000000");
  O = good();
  O.Segments[0].ZeroBytes = VX_IMAGE_SIZE;
  EXPECT_NE(wrongIn(O).find("expected it within"), std::string::npos);
  O = good();
  O.Segments.push_back({VX_IMAGE_BASE + 4, PF_R, {1}, 0});
  EXPECT_EQ(wrongIn(O), "the segments at 0x80000000 and 0x80000004 overlap");
  O = good();
  O.Segments[0].Flags |= PF_W;
  EXPECT_EQ(wrongIn(O), "the segment at 0x80000000 is writable code, expected "
                        "code to be read-only");
  O = good();
  O.Entry = VX_IMAGE_BASE + 8;
  EXPECT_EQ(wrongIn(O), "entry point 0x80000008, expected the address of an "
                        "instruction in an executable segment");
  O.Entry = VX_IMAGE_BASE + 2;
  EXPECT_NE(wrongIn(O), "");
}

TEST(Image, RefusesBadKernelTables) {
  ElfOptions O = withKernel();
  O.Segments[1].Words[0] = 0x80FFFFFF; // name
  EXPECT_EQ(wrongIn(O), "kernel table at 0x80001000: the name is not a string "
                        "of the image");
  O = withKernel();
  O.Segments[1].Words[1] = Table; // entry
  EXPECT_EQ(wrongIn(O), "kernel table at 0x80001000: entry point 0x80001000 of "
                        "'add' is not code");
  O = withKernel();
  O.Segments[1].Words[3] = 1000000; // number of arguments
  EXPECT_NE(wrongIn(O).find("1000000 arguments"), std::string::npos);
  O = withKernel();
  O.Segments[1].Words[2] = 0xFFFFFFF0; // address of arguments
  EXPECT_NE(wrongIn(O).find("argument 0 of 'add' is not in the image"),
            std::string::npos);
  O = withKernel();
  O.Segments[1].Words[14] = 6; // an argument beyond the end of them
  EXPECT_NE(wrongIn(O).find("argument 0 of 'add' is malformed"),
            std::string::npos);
  O = withKernel();
  O.Symbols[2].second -= 4;
  EXPECT_EQ(wrongIn(O), "kernel table of 44 bytes, expected a multiple of 48");
}

/// With variables of program scope: 12 bytes, of which the first two words are
/// known and the second is an address.
ElfOptions withVariables() {
  ElfOptions O = withKernel();
  const uint32_t Contents = Table + 0x1000 + sizeof(VxVariables);
  O.Segments.push_back({Table + 0x1000,
                        PF_R,
                        {VX_IMAGE_BASE + 4, 12, 256, Contents, 8, Contents + 8,
                         1, // vx_variables
                         77, 8, 4},
                        0});
  O.Symbols.push_back({"__start_vorion_variables", Table + 0x1000});
  O.Symbols.push_back({"__stop_vorion_variables", Contents});
  return O;
}

TEST(Image, ReadsTheTableOfVariables) {
  const auto I = Image::parse(buildElf(withVariables()), "x.elf");
  ASSERT_TRUE(I) << I.error().What;
  const ProgramVariables &V = (*I)->findKernel("add")->Variables;
  EXPECT_EQ(V.Bytes, 12U);
  EXPECT_EQ(V.Alignment, 256U);
  EXPECT_EQ(V.ContentsBytes, 8U);
  EXPECT_EQ(V.NumPointers, 1U);
}

TEST(Image, RefusesBadTablesOfVariables) {
  const auto With = [](size_t Word, uint32_t Value) {
    ElfOptions O = withVariables();
    O.Segments[2].Words[Word] = Value;
    return wrongIn(O);
  };
  const std::string Where = "table of variables at 0x80002000: ";
  EXPECT_EQ(With(0, VX_IMAGE_BASE), Where + "no kernel begins at 0x80000000");
  EXPECT_EQ(With(1, 4), Where + "malformed");          // bytes
  EXPECT_EQ(With(2, 0), Where + "malformed");          // alignment
  EXPECT_EQ(With(2, 24), Where + "malformed");         // alignment
  EXPECT_EQ(With(3, 0x80FFFFFF), Where + "malformed"); // contents
  EXPECT_EQ(With(4, 0x10000), Where + "malformed");    // bytes of them
  EXPECT_EQ(With(5, 0x80FFFFFF), Where + "malformed"); // pointers
  EXPECT_EQ(With(6, 0x40000001), Where + "malformed"); // number of them
  EXPECT_EQ(With(9, 5), Where + "pointer 0 is outside the variables");
  ElfOptions O = withVariables();
  O.Symbols.back().second -= 4;
  EXPECT_EQ(wrongIn(O),
            "table of variables of 24 bytes, expected a multiple of 28");
}

TEST(Image, GroupSizesAreAllZeroOrNone) {
  ElfOptions O = withKernel();
  O.Segments[1].Words[8] = 0; // 16,0,1
  EXPECT_EQ(wrongIn(O),
            "kernel table at 0x80001000: 'add' was compiled for groups of "
            "16,0,1, expected three sizes above 0, or 0,0,0 for any");
  O.Segments[1].Words[7] = 0; // 0,0,1
  EXPECT_NE(wrongIn(O), "");
  O.Segments[1].Words[9] = 0;
  EXPECT_EQ(wrongIn(O), "");
}

TEST(Image, ArgumentsThatNoKernelHasAreRefused) {
  ElfOptions O = withKernel();
  O.Segments[1].Words[4] = 0xFFFFFFFF;
  EXPECT_EQ(wrongIn(O), "kernel table at 0x80001000: 'add' has 4294967295 "
                        "bytes of arguments, expected at most 262144");
}

/// 20,000 kernels of one table with 4,000 arguments each: gigabytes of a file
/// of one megabyte.
TEST(Image, ManyKernelsOfOneTableAreRefused) {
  constexpr uint32_t Kernels = 20000, Args = 4000;
  constexpr uint32_t ArgTable = Table + Kernels * uint32_t{sizeof(VxKernel)};
  constexpr uint32_t Name = ArgTable + Args * uint32_t{sizeof(VxKernelArg)};
  ElfOptions O = good();
  std::vector<uint32_t> Words;
  for (uint32_t N = 0; N != Kernels; ++N)
    Words.insert(Words.end(),
                 {Name, VX_IMAGE_BASE, ArgTable, Args, 4, 0, 0, 0, 0, 0, 0, 0});
  for (uint32_t N = 0; N != Args; ++N)
    Words.insert(Words.end(), {Name, VX_ARG_VALUE, 0, 4});
  Words.push_back('k');
  O.Segments.push_back({Table, PF_R, Words, 0});
  O.Symbols.push_back({"__start_vorion_kernels", Table});
  O.Symbols.push_back({"__stop_vorion_kernels", ArgTable});
  EXPECT_NE(wrongIn(O).find(" kernel arguments in a file of "),
            std::string::npos)
      << wrongIn(O);
}

/// Arguments whose names all begin in one long string.
TEST(Image, NamesThatShareOneStringAreRefused) {
  constexpr uint32_t Args = 4000, NameBytes = 20000;
  constexpr uint32_t ArgTable = Table + sizeof(VxKernel);
  constexpr uint32_t Names = ArgTable + Args * uint32_t{sizeof(VxKernelArg)};
  ElfOptions O = good();
  std::vector<uint32_t> Words = {
      Names, VX_IMAGE_BASE, ArgTable, Args, 4, 0, 0, 0, 0, 0, 0, 0};
  for (uint32_t N = 0; N != Args; ++N)
    Words.insert(Words.end(), {Names, VX_ARG_VALUE, 0, 4});
  Words.insert(Words.end(), NameBytes / 4, 0x61616161);
  Words.push_back(0);
  O.Segments.push_back({Table, PF_R, Words, 0});
  O.Symbols.push_back({"__start_vorion_kernels", Table});
  O.Symbols.push_back({"__stop_vorion_kernels", ArgTable});
  EXPECT_NE(wrongIn(O), "");
}

/// Segments that all are the same bytes of the file: 16 MiB of 100 KiB.
TEST(Image, SegmentsThatShareBytesOfTheFileAreRefused) {
  constexpr uint32_t Segments = 160, Bytes = 100 << 10;
  ElfOptions O = good();
  O.Segments.assign(Segments, {Table, PF_R, {}, Bytes});
  O.Segments.push_back({VX_IMAGE_BASE, PF_R | PF_X, {0x13}, 0});
  std::vector<std::byte> File = buildElf(O);
  File.resize(File.size() + Bytes);
  for (uint32_t N = 0; N != Segments; ++N) {
    Elf32_Phdr P;
    std::byte *At = File.data() + sizeof(Elf32_Ehdr) + N * sizeof(P);
    std::memcpy(&P, At, sizeof(P));
    P.p_vaddr += N * Bytes;
    P.p_offset = 0;
    P.p_filesz = Bytes;
    std::memcpy(At, &P, sizeof(P));
  }
  const auto I = Image::parse(File, "test");
  ASSERT_FALSE(I);
  EXPECT_NE(I.error().What.find("expected each byte in one segment"),
            std::string::npos)
      << I.error().What;
}

TEST(Image, AbsoluteSymbolsCount) {
  ElfOptions O = good();
  O.AbsoluteSymbols = {{"begin_signature", VX_IMAGE_BASE + 0x2000},
                       {"stack_size", VX_IMAGE_BASE - 0x1000}};
  O.Symbols.clear();
  const auto I = Image::parse(buildElf(O), "x.elf");
  ASSERT_TRUE(I) << I.error().What;
  EXPECT_EQ((*I)->findSymbol("begin_signature"), VX_IMAGE_BASE + 0x2000);
  EXPECT_EQ((*I)->symbolize(VX_IMAGE_BASE + 0x2000), "begin_signature");
  // A number is no function that goes on behind it, and takes no one's place.
  EXPECT_EQ((*I)->symbolize(VX_IMAGE_BASE), "");
  O.Symbols = {{"_start", VX_IMAGE_BASE}};
  O.AbsoluteSymbols = {{"VX_IMAGE_BASE", VX_IMAGE_BASE}};
  const auto Both = Image::parse(buildElf(O), "x.elf");
  ASSERT_TRUE(Both) << Both.error().What;
  EXPECT_EQ((*Both)->symbolize(VX_IMAGE_BASE), "_start");
}

TEST(Image, KnowsWhichLoadsAndStoresAreAtomic) {
  ElfOptions O = good();
  // The words lie at 0 and 4, and say how far away the instructions are.
  O.Atomics = {VX_IMAGE_BASE + 8, VX_IMAGE_BASE - 4};
  const auto Program = Image::parse(buildElf(O), "test");
  ASSERT_TRUE(Program) << Program.error().What;
  EXPECT_TRUE((*Program)->isAtomicPlace(VX_IMAGE_BASE));
  EXPECT_FALSE((*Program)->isAtomicPlace(VX_IMAGE_BASE + 4));
  EXPECT_TRUE((*Program)->isAtomicPlace(VX_IMAGE_BASE + 8));

  O.Atomics.assign(1000, 0);
  EXPECT_EQ(wrongIn(O), "");
  O.AtomicSections = 1000;
  EXPECT_EQ(wrongIn(O), "sections vorion_atomics are larger than the file");
}

TEST(Image, EveryTruncationIsAnError) {
  const std::vector<std::byte> Whole = buildElf(withKernel());
  ASSERT_TRUE(Image::parse(Whole, "x.elf"));
  for (size_t Length = 0; Length != Whole.size(); ++Length)
    EXPECT_FALSE(Image::parse(std::span(Whole).first(Length), "x.elf"))
        << Length;
}

TEST(Image, SurvivesAnyChangedBytes) {
  const std::vector<std::byte> Whole = buildElf(withKernel());
  std::mt19937 Random(9);
  for (int Try = 0; Try != 20000; ++Try) {
    std::vector<std::byte> Bent = Whole;
    for (auto Changes = 1 + Random() % 4; Changes; --Changes)
      Bent[Random() % Bent.size()] = static_cast<std::byte>(Random());
    // Whatever it is, it is an image or an error.
    const auto I = Image::parse(Bent, "x.elf");
    if (!I)
      EXPECT_FALSE(I.error().What.empty());
  }
}
