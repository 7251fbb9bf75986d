#include "vorion/support/Tool.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <new>
#include <stdexcept>
#include <thread>
#include <unistd.h>

using namespace vorion;

namespace {

/// The exit code of \p Body and what it said on stderr.
std::pair<int, std::string> ran(const std::function<int()> &Body) {
  testing::internal::CaptureStderr();
  const int Code = runTool("tool", Body);
  return {Code, testing::internal::GetCapturedStderr()};
}

TEST(Tool, GivesTheCodeOfItsBody) {
  EXPECT_EQ(ran([] { return 4; }), std::pair(4, std::string()));
}

TEST(Tool, WhatIsThrownIsOneLine) {
  EXPECT_EQ(
      ran([]() -> int { throw std::bad_alloc(); }),
      std::pair(5, std::string("tool: error: out of memory, expected a smaller "
                               "input or a host with more memory\n")));
  EXPECT_EQ(
      ran([]() -> int { throw std::runtime_error("this\nthat"); }),
      std::pair(70, std::string("tool: error: internal error: this\\x0athat, "
                                "expected no exception\n")));
}

// The sanitizer has an allocator of its own, which asks no handler.
#if !__has_feature(address_sanitizer)
TEST(Tool, MemoryThatRunsOutInAThreadIsOneLine) {
  const auto TakeTooMuch = [] {
    std::thread Taker(
        [] { ::operator delete(::operator new(std::size_t{1} << 62)); });
    Taker.join();
    return 0;
  };
  EXPECT_EXIT(runTool("tool", TakeTooMuch), testing::ExitedWithCode(5),
              "^tool: error: out of memory, expected a smaller input or a host "
              "with more memory\n$");
}
#endif

TEST(Tool, OutputThatIsFullIsSeen) {
  std::fflush(stdout);
  const int Saved = dup(STDOUT_FILENO);
  ASSERT_TRUE(std::freopen("/dev/full", "w", stdout));
  const auto Result = ran([] {
    std::printf("text\n");
    return 0;
  });
  std::fflush(stdout);
  ASSERT_EQ(dup2(Saved, STDOUT_FILENO), STDOUT_FILENO);
  close(Saved);
  std::clearerr(stdout);
  EXPECT_EQ(
      Result,
      std::pair(
          3, std::string("tool: error: standard output: cannot write: No space "
                         "left on device, expected an open output stream\n")));
}

} // namespace
