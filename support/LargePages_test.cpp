#include <cstddef>
#include <cstdint>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <new>
#include <sstream>
#include <string>

namespace {

constexpr std::size_t LargePage = std::size_t(2) << 20;

/// Whether the kernel was asked to have \p Address in a large page.
bool isWantedLarge(const void *Address) {
  std::ifstream Maps("/proc/self/smaps");
  const auto Wanted = reinterpret_cast<uintptr_t>(Address);
  bool IsInside = false;
  for (std::string Line; std::getline(Maps, Line);) {
    uintptr_t From = 0, To = 0;
    char Dash = 0;
    std::istringstream Range(Line);
    if (Range >> std::hex >> From >> Dash >> To && Dash == '-')
      IsInside = From <= Wanted && Wanted < To;
    if (IsInside && Line.starts_with("VmFlags:"))
      return Line.find(" hg") != std::string::npos;
  }
  return false;
}

TEST(LargePages, LargeBlocksAreAlignedAndAskedForAsLargePages) {
  for (const std::size_t Size :
       {LargePage, 5 * LargePage / 2, 40 * LargePage}) {
    const std::unique_ptr<std::byte[]> Block(new std::byte[Size]);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(Block.get()) % LargePage, 0U);
    EXPECT_TRUE(isWantedLarge(Block.get())) << Size;
    Block[0] = Block[Size - 1] = std::byte{1};
  }
}

TEST(LargePages, SmallBlocksAreAsBefore) {
  const std::unique_ptr<std::byte[]> Block(new std::byte[LargePage / 2]),
      Empty(new std::byte[0]);
  EXPECT_FALSE(isWantedLarge(Block.get()));
  EXPECT_NE(Empty, nullptr);
}

unsigned Called = 0;

TEST(LargePages, WhoHandlesMissingMemoryIsAsked) {
  Called = 0;
  std::set_new_handler([] {
    if (++Called == 2)
      std::set_new_handler(nullptr);
  });
  // Called by its name, because a new expression may be optimised away.
  EXPECT_THROW(static_cast<void>(::operator new(SIZE_MAX / 2)), std::bad_alloc);
  EXPECT_EQ(Called, 2U);
}

} // namespace
