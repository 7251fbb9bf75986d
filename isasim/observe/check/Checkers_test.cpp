#include "observe/check/Checkers.h"

#include <fstream>
#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::isasim;

namespace {

constexpr const char *Names[] = {
#define VORION_CHECK(NAME, MAKE) #NAME,
#include "observe/check/Checks.def"
};

/// How many checkers \p Text asks for.
size_t checkersOf(std::string_view Text) {
  const auto Made = Checkers::create(Text, [](std::string_view) {});
  EXPECT_TRUE(Made) << Made.error().What;
  return (*Made)->observers().size() - 1;
}

TEST(Checkers, AreMadeByName) {
  for (const std::string Name : Names)
    EXPECT_EQ(checkersOf(Name), 1U) << Name;
  EXPECT_EQ(checkersOf("bounds,race,bounds"), 2U);
  EXPECT_EQ(checkersOf("all"), std::size(Names));
}

TEST(Checkers, UnknownNamesAreUsageErrors) {
  for (const char *Text : {"", "bound", "all,", "all,x", "bounds race"}) {
    const auto Made = Checkers::create(Text, [](std::string_view) {});
    ASSERT_FALSE(Made) << Text;
    EXPECT_EQ(Made.error().Code, ExitCode::Usage);
    for (const std::string Name : Names)
      EXPECT_NE(Made.error().What.find(Name), std::string::npos);
  }
}

TEST(Checkers, EachHasARowInTheDocuments) {
  std::ifstream Document("docs/debugging.md");
  ASSERT_TRUE(Document);
  const std::string Text{std::istreambuf_iterator<char>(Document), {}};
  for (const std::string Name : Names)
    EXPECT_NE(Text.find("\n| `" + Name + "` | "), std::string::npos) << Name;
}

} // namespace
