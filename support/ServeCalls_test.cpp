#include "vorion/support/ServeCalls.h"

#include "vorion/support/ToolMessages.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <optional>
#include <poll.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>
extern "C" { // which glibc 2.36 lacks
#include <sys/pidfd.h>
}

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

struct Sample {
  std::string Name;
  bool IsSet = false;
  std::vector<std::string> Words;
};
template <typename Archive> void visit(Archive &A, Sample &Value) {
  A.text(Value.Name);
  A.number(Value.IsSet);
  A.list(Value.Words);
}

TEST(ToolMessages, FieldsStayWhatTheyAre) {
  Sample Sent{std::string("a\0b", 3), true, {"", "c\nd"}}, Got;
  const std::string Text = textOf(Sent);
  EXPECT_TRUE(isReadInto(Got, Text));
  EXPECT_EQ(Got.Name, Sent.Name);
  EXPECT_EQ(Got.IsSet, Sent.IsSet);
  EXPECT_EQ(Got.Words, Sent.Words);
}

TEST(ToolMessages, OtherTextsAreRefused) {
  Sample Sent{"name", false, {"word"}}, Got;
  const std::string Text = textOf(Sent);
  EXPECT_FALSE(isReadInto(Got, Text + "x"));
  for (size_t Size = 0; Size < Text.size(); ++Size)
    EXPECT_FALSE(isReadInto(Got, std::string_view(Text).substr(0, Size)));
  EXPECT_FALSE(isReadInto(Got, std::string(Text.size(), '\xFF')));
}

struct CSample {
  char *Name = nullptr;
  size_t *Sizes = nullptr;
  size_t Count = 0;
};
template <typename Archive> void visit(Archive &A, CSample &Value) {
  A.text(Value.Name);
  A.array(Value.Sizes, Value.Count);
}

// A leak is seen by the sanitizer build.
TEST(ToolMessages, WhatWasReadIsReleased) {
  std::string Name = "name";
  std::vector<size_t> Sizes{1, 2};
  CSample Sent{Name.data(), Sizes.data(), Sizes.size()}, Got;
  EXPECT_TRUE(isReadInto(Got, textOf(Sent)));
  EXPECT_STREQ(Got.Name, "name");
  EXPECT_EQ(Got.Sizes[1], 2U);
  FieldReleaser Releaser;
  visit(Releaser, Got);
  EXPECT_EQ(Got.Name, nullptr);
  EXPECT_EQ(Got.Sizes, nullptr);
  EXPECT_EQ(Got.Count, 0U);
}

/// The client's ends of a server.
struct Served {
  int Calls = -1, End = -1;

  std::optional<std::string> call(std::string_view Request) const {
    return sendText(Calls, Request) ? receiveText(Calls) : std::nullopt;
  }
  ServerEnd end() const {
    ServerEnd Ended;
    const auto Text = receiveText(End);
    EXPECT_TRUE(Text && isReadInto(Ended, *Text));
    ::close(Calls);
    ::close(End);
    return Ended;
  }
};

/// A server that answers with its request and what it printed.
Served serve() {
  int Calls[2], End[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, Calls) != 0 ||
      ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, End) != 0)
    return {};
  const pid_t Child = ::fork();
  if (Child == 0) {
    ::dup2(Calls[1], STDIN_FILENO);
    ::dup2(End[1], STDOUT_FILENO);
    ::_exit(serveCalls([](std::string_view Request) -> Response {
      std::fprintf(stderr, "(%s)", std::string(Request).c_str());
      if (Request == "exit")
        ::_exit(3);
      if (Request == "abort")
        std::abort();
      if (Request == "run") {
        const pid_t Run = ::fork();
        if (Run == 0)
          ::pause();
        return {std::to_string(Run)};
      }
      return {std::string(Request) + takePrinted(), Request != "last"};
    }));
  }
  ::close(Calls[1]);
  ::close(End[1]);
  int Status = -1;
  // It ends at once, and leaves the server to nobody.
  EXPECT_EQ(::waitpid(Child, &Status, 0), Child);
  EXPECT_EQ(Status, 0);
  return {Calls[0], End[0]};
}

TEST(ServeCalls, OneAfterTheOtherUntilTheLast) {
  const Served Server = serve();
  for (const std::string Word : {"one", "two", "last"})
    EXPECT_EQ(Server.call(Word), Word + "(" + Word + ")");
  EXPECT_FALSE(Server.call("another").has_value());
  EXPECT_EQ(Server.end().WaitStatus, 0);
}

TEST(ServeCalls, WhatAServerRunsEndsWithIt) {
  const Served Server = serve();
  const auto Run = Server.call("run");
  ASSERT_TRUE(Run);
  const int Process = ::pidfd_open(std::stoi(*Run), 0);
  ASSERT_GE(Process, 0);
  EXPECT_FALSE(Server.call("abort").has_value());
  pollfd Ended{Process, POLLIN, 0};
  EXPECT_EQ(::poll(&Ended, 1, 60'000), 1);
  ::close(Process);
  Server.end();
}

TEST(ServeCalls, TheClientLearnsHowItEnded) {
  Served Server = serve();
  EXPECT_EQ(Server.call("one"), "one(one)");
  EXPECT_FALSE(Server.call("exit").has_value());
  ServerEnd End = Server.end();
  EXPECT_TRUE(WIFEXITED(End.WaitStatus) && WEXITSTATUS(End.WaitStatus) == 3);
  EXPECT_EQ(End.Printed, "(exit)");

  Server = serve();
  EXPECT_FALSE(Server.call("abort").has_value());
  End = Server.end();
  EXPECT_TRUE(WIFSIGNALED(End.WaitStatus) &&
              WTERMSIG(End.WaitStatus) == SIGABRT);
}

} // namespace
} // namespace vorion
