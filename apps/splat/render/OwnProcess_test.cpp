#include "render/OwnProcess.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace vorion;
using namespace vorion::splat;

namespace {

TEST(OwnProcess, GivesWhatTheWorkGives) {
  const std::string Long(100000, 'x');
  const auto Text = inOwnProcess([&] { return Expected(Long + '\0'); });
  ASSERT_TRUE(Text);
  EXPECT_EQ(*Text, Long + '\0');
  EXPECT_EQ(*inOwnProcess([] { return Expected(std::string()); }), "");

  const auto Failed = inOwnProcess([]() -> Expected<std::string> {
    return Error{"there", "wrong", ExitCode::Trap};
  });
  ASSERT_FALSE(Failed);
  EXPECT_EQ(Failed.error().Where, "there");
  EXPECT_EQ(Failed.error().What, "wrong");
  EXPECT_EQ(Failed.error().Code, ExitCode::Trap);
}

TEST(OwnProcess, ChangesNothingHere) {
  int Value = 1;
  const auto Changed = inOwnProcess([&] {
    Value = 2;
    return Expected(std::to_string(Value));
  });
  ASSERT_TRUE(Changed);
  EXPECT_EQ(*Changed, "2");
  EXPECT_EQ(Value, 1);
}

TEST(OwnProcess, OneThatDiesIsAnError) {
  const auto Died = inOwnProcess([]() -> Expected<std::string> { _exit(7); });
  ASSERT_FALSE(Died);
  EXPECT_EQ(Died.error().Code, ExitCode::Internal);
}

} // namespace
