/// Memory for code: never writable and executable at once, and bounded.

#include "translate/HostCode.h"

#include "testing/HostMappings.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <unistd.h>
#include <vector>

using namespace vorion::isasim::testing;
using vorion::isasim::translate::HostCode;

namespace {

size_t pageBytes() { return static_cast<size_t>(sysconf(_SC_PAGESIZE)); }

std::vector<uint8_t> piece(uint8_t Byte, size_t Bytes = 100) {
  return std::vector<uint8_t>(Bytes, Byte);
}

bool holds(const std::byte *At, uint8_t Byte, size_t Bytes = 100) {
  return std::all_of(At, At + Bytes,
                     [Byte](std::byte B) { return B == std::byte{Byte}; });
}

TEST(HostCode, IsExecutableAndNotWritable) {
  const unsigned Before = madeCode(hostMappings());
  HostCode Host(16 * pageBytes());
  EXPECT_EQ(madeCode(hostMappings()), Before) << "nothing has been written";
  for (const uint8_t Byte : {1, 2, 3}) {
    const std::byte *At = Host.add(piece(Byte));
    ASSERT_NE(At, nullptr);
    EXPECT_TRUE(holds(At, Byte));
    const std::vector<HostMapping> Now = hostMappings();
    EXPECT_GT(madeCode(Now), Before);
    EXPECT_FALSE(isCodeWritable(Now)) << "after piece " << int{Byte};
  }
}

TEST(HostCode, CannotBeWrittenOnceItIsThere) {
  HostCode Host(4 * pageBytes());
  std::byte *At = Host.add(piece(1));
  ASSERT_NE(At, nullptr);
  EXPECT_DEATH(*At = std::byte{2}, "");
}

TEST(HostCode, IsNoLongerThanItsRoom) {
  HostCode Host(4 * pageBytes());
  const std::byte *Pieces[4];
  for (uint8_t N = 0; N != 4; ++N) {
    Pieces[N] = Host.add(piece(N));
    ASSERT_NE(Pieces[N], nullptr) << "each takes a page";
  }
  EXPECT_EQ(Host.bytes(), 4 * pageBytes());
  EXPECT_EQ(Host.add(piece(9)), nullptr);
  EXPECT_EQ(Host.bytes(), 4 * pageBytes());
  for (uint8_t N = 0; N != 4; ++N)
    EXPECT_TRUE(holds(Pieces[N], N)) << "what was there stays";
  EXPECT_FALSE(isCodeWritable(hostMappings()));
}

TEST(HostCode, RefusesWhatIsLongerThanItsRoom) {
  HostCode Host(4 * pageBytes());
  EXPECT_EQ(Host.add(piece(1, 4 * pageBytes())), nullptr);
  EXPECT_EQ(Host.bytes(), 0U);
  EXPECT_NE(Host.add(piece(1, 2 * pageBytes())), nullptr) << "this one fits";
}

TEST(HostCode, LeavesNothingBehind) {
  const unsigned Before = madeCode(hostMappings());
  {
    HostCode Host(4 * pageBytes());
    ASSERT_NE(Host.add(piece(1)), nullptr);
    EXPECT_EQ(madeCode(hostMappings()), Before + 1);
  }
  EXPECT_EQ(madeCode(hostMappings()), Before);
}

} // namespace
