#include "StackDepth.h"

#include <vorion_abi.h>

#include <cstring>
#include <elf.h>
#include <gtest/gtest.h>

using namespace vorion;

namespace {

struct Function {
  uint32_t Address, Frame, Flags;
  std::vector<uint32_t> Callees;
};

/// The words of a structure.
template <typename T> void append(std::vector<uint32_t> &To, const T &Part) {
  static_assert(sizeof(T) % 4 == 0);
  const size_t At = To.size();
  To.resize(At + sizeof(T) / 4);
  std::memcpy(&To[At], &Part, sizeof(T));
}

constexpr uint32_t MainAddress = 0x80000000, TableAddress = 0x80001000;

/// A program with the records of \p Functions, a kernel for each of \p Kernels,
/// which are entries, and main() at MainAddress.
std::vector<std::byte> program(const std::vector<Function> &Functions,
                               const std::vector<uint32_t> &Kernels) {
  // Each part a section; names at these places of the first.
  constexpr char Names[] =
      "\0vorion_stacks\0vorion_kernels\0vorion_main\0k\0\0\0\0";
  constexpr uint32_t StacksName = 1, KernelsName = 15, MainName = 30,
                     KernelName = 42;
  std::vector<uint32_t> Parts[4];
  Parts[0].resize(sizeof(Names) / 4);
  std::memcpy(Parts[0].data(), Names, Parts[0].size() * 4);
  for (const Function &F : Functions) {
    append(Parts[1], vx_stack{F.Address, F.Frame, F.Flags,
                              static_cast<uint32_t>(F.Callees.size())});
    Parts[1].insert(Parts[1].end(), F.Callees.begin(), F.Callees.end());
  }
  for (const uint32_t Entry : Kernels) {
    vx_kernel K{};
    K.name = TableAddress + 0x800 + KernelName;
    K.entry = Entry;
    K.stack_bytes = 7;
    append(Parts[2], K);
  }
  append(Parts[3], Elf32_Sym{});
  append(Parts[3], Elf32_Sym{MainName, MainAddress, 4,
                             ELF32_ST_INFO(STB_GLOBAL, STT_FUNC), 0, 1});

  Elf32_Ehdr Header{};
  std::memcpy(Header.e_ident, ELFMAG, SELFMAG);
  Header.e_ident[EI_CLASS] = ELFCLASS32;
  Header.e_type = ET_EXEC;
  Header.e_phoff = sizeof(Header);
  Header.e_phnum = 1;
  Header.e_shoff = sizeof(Header) + sizeof(Elf32_Phdr);
  Header.e_shnum = 4;
  std::vector<uint32_t> Words;
  append(Words, Header);
  Elf32_Phdr Stack{};
  Stack.p_type = PT_GNU_STACK;
  append(Words, Stack);
  uint32_t At = Header.e_shoff + 4 * sizeof(Elf32_Shdr);
  const Elf32_Shdr Sections[] = {
      {0, SHT_STRTAB, SHF_ALLOC, TableAddress + 0x800, 0, 0, 0, 0, 1, 0},
      {StacksName, SHT_PROGBITS, 0, 0, 0, 0, 0, 0, 4, 0},
      {KernelsName, SHT_PROGBITS, SHF_ALLOC, TableAddress, 0, 0, 0, 0, 4, 0},
      {0, SHT_SYMTAB, 0, 0, 0, 0, 0, 0, 4, sizeof(Elf32_Sym)}};
  for (unsigned N = 0; N != 4; ++N) {
    Elf32_Shdr S = Sections[N];
    S.sh_offset = At;
    S.sh_size = static_cast<uint32_t>(Parts[N].size() * 4);
    At += S.sh_size;
    append(Words, S);
  }
  for (const std::vector<uint32_t> &Part : Parts)
    Words.insert(Words.end(), Part.begin(), Part.end());
  const auto Bytes = std::as_bytes(std::span(Words));
  return {Bytes.begin(), Bytes.end()};
}

/// What main, which calls \p Functions[0], needs.
uint64_t needOf(std::vector<Function> Functions) {
  Functions.push_back({MainAddress, 16, 0, {Functions[0].Address}});
  std::vector<std::byte> File = program(Functions, {});
  const auto Needs = link::writeStackNeeds(File, "x.elf");
  EXPECT_TRUE(Needs) << Needs.error().What;
  EXPECT_EQ(Needs->size(), 1u);
  Elf32_Phdr Stack;
  std::memcpy(&Stack, &File[sizeof(Elf32_Ehdr)], sizeof(Stack));
  EXPECT_EQ(Stack.p_memsz, Needs->front().Bytes);
  return Needs->front().Bytes - 16;
}

TEST(StackDepth, IsThatOfTheDeepestPath) {
  EXPECT_EQ(needOf({{8, 32, 0, {}}}), 32u);
  EXPECT_EQ(needOf({{8, 32, 0, {12, 16}},
                    {12, 100, 0, {20}},
                    {16, 64, 0, {20}},
                    {20, 8, 0, {}},
                    {24, 4096, 0, {}}}),
            140u);
  // Absent weak functions have the address 0.
  EXPECT_EQ(needOf({{8, 32, 0, {0, 0}}}), 32u);
}

TEST(StackDepth, HasRoomForWhatRepeats) {
  // A circle, behind it and before it something else.
  EXPECT_EQ(needOf({{8, 32, 0, {12}},
                    {12, 100, 0, {16}},
                    {16, 64, 0, {12, 20}},
                    {20, 8, 0, {}}}),
            204u + VX_REPEAT_BYTES);
  EXPECT_EQ(needOf({{8, 32, 0, {8}}}), 32u + VX_REPEAT_BYTES);
  EXPECT_EQ(needOf({{8, 32, VX_STACK_REPEATS, {}}}), 32u + VX_REPEAT_BYTES);
  // Nobody knows the function that is called.
  EXPECT_EQ(needOf({{8, 32, 0, {40}}}), 32u + VX_REPEAT_BYTES);
  // Pointers reach functions whose address is taken.
  EXPECT_EQ(needOf({{8, 32, VX_STACK_INDIRECT, {}},
                    {12, 200, VX_STACK_ADDRESS_TAKEN, {16}},
                    {16, 1000, 0, {}},
                    {20, 4096, 0, {}}}),
            1232u + VX_REPEAT_BYTES);
}

TEST(StackDepth, LongPathsTakeNoStackOfTheHost) {
  std::vector<Function> Chain;
  for (uint32_t N = 1; N <= 200'000; ++N)
    Chain.push_back({8 * N, 16, 0, {8 * (N + 1)}});
  Chain.back().Callees.clear();
  EXPECT_EQ(needOf(Chain), 200'000u * 16);
}

TEST(StackDepth, IsWrittenIntoTheKernelTable) {
  std::vector<std::byte> File =
      program({{8, 32, 0, {12}}, {12, 48, 0, {}}}, {8, 12, 99});
  const auto Needs = link::writeStackNeeds(File, "x.elf");
  ASSERT_TRUE(Needs);
  ASSERT_EQ(Needs->size(), 2u);
  EXPECT_EQ((*Needs)[0].Name, "kernel k");
  EXPECT_EQ((*Needs)[0].Bytes, 80u);
  EXPECT_EQ((*Needs)[1].Bytes, 48u);
  // Of the third nothing is known: it keeps what it says.
  std::vector<uint32_t> Kept;
  const size_t Kernels =
      File.size() - 2 * sizeof(Elf32_Sym) - 3 * sizeof(vx_kernel);
  for (size_t N = 0; N != 3; ++N) {
    vx_kernel K;
    std::memcpy(&K, &File[Kernels + N * sizeof(K)], sizeof(K));
    Kept.push_back(K.stack_bytes);
  }
  EXPECT_EQ(Kept, (std::vector<uint32_t>{80, 48, 7}));
}

TEST(StackDepth, DamagedFilesAreErrorsOrNothing) {
  const std::vector<std::byte> Good =
      program({{8, 32, 0, {12}}, {12, 48, 0, {}}}, {8});
  for (size_t At = 0; At != Good.size(); ++At)
    for (const unsigned Value : {0x00U, 0x7FU, 0xFFU}) {
      std::vector<std::byte> Damaged = Good;
      Damaged[At] = static_cast<std::byte>(Value);
      (void)link::writeStackNeeds(Damaged, "x.elf");
    }
  for (size_t Size = 0; Size != Good.size(); ++Size) {
    std::vector<std::byte> Cut(Good.begin(), Good.begin() + Size);
    (void)link::writeStackNeeds(Cut, "x.elf");
  }
}

} // namespace
