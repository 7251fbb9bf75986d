#include "vorion/support/ServeCalls.h"

#include "vorion/support/ToolMessages.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vorion {
namespace {

TEST(ToolMessages, TextsArriveWholeAndTheEndIsSeen) {
  int Ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, Ends), 0);
  const std::string Long(50'000, 'x');
  for (const std::string &Text :
       {std::string(), std::string("a\0b", 3), Long}) {
    EXPECT_TRUE(sendText(Ends[0], Text));
    EXPECT_EQ(receiveText(Ends[1]), Text);
  }
  ::close(Ends[0]);
  EXPECT_FALSE(receiveText(Ends[1]).has_value());
  EXPECT_FALSE(sendText(Ends[1], "nobody reads"));
  ::close(Ends[1]);
}

TEST(ToolMessages, ArgumentsStayWhatTheyAre) {
  for (const std::vector<std::string> &Arguments :
       {std::vector<std::string>{}, {""}, {"-o", "a b", "", "c\nd"}})
    EXPECT_EQ(argumentsOf(callText(Arguments)), Arguments);
}

/// The client's end of a server that prints its arguments and fails if the
/// first one is "fail".
int served() {
  int Ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, Ends) != 0)
    return -1;
  const pid_t Child = ::fork();
  if (Child == 0) {
    ::dup2(Ends[1], STDIN_FILENO);
    std::string Name = "tool";
    ::_exit(serveCalls(Name.data(), [](std::span<char *> Call) {
      for (const char *A : Call.subspan(1))
        std::printf("(%s)", A);
      std::fprintf(stderr, "!");
      return std::string_view(Call[1]) == "fail" ? 3 : 0;
    }));
  }
  ::close(Ends[1]);
  int Status = -1;
  // It ends at once, and leaves the server to nobody.
  EXPECT_EQ(::waitpid(Child, &Status, 0), Child);
  EXPECT_EQ(Status, 0);
  return Ends[0];
}

TEST(ServeCalls, OneAfterTheOtherUntilOneFails) {
  const int Socket = served();
  for (const char *Word : {"one", "two"}) {
    EXPECT_TRUE(sendText(Socket, callText({Word, "x"})));
    const auto Answer = receiveText(Socket);
    ASSERT_TRUE(Answer.has_value());
    EXPECT_EQ(Answer->substr(0, 2), "0 ");
    EXPECT_NE(Answer->find(std::string("(") + Word + ")(x)"),
              std::string::npos);
    EXPECT_NE(Answer->find('!'), std::string::npos);
    EXPECT_EQ(Answer->size(), 2 + 5 + 3 + 1U);
  }
  EXPECT_TRUE(sendText(Socket, callText({"fail"})));
  EXPECT_EQ(receiveText(Socket).value_or("").substr(0, 2), "3 ");
  EXPECT_FALSE(receiveText(Socket).has_value());
  ::close(Socket);
}

} // namespace
} // namespace vorion
