#include "vorion/support/HelpText.h"

#include "vorion/support/Printable.h"

#include <gtest/gtest.h>

using namespace vorion;

namespace {

constexpr const char *Page =
    "Draws a scene.\n"
    "Usage: splat render [OPTIONS] scene\n"
    "\n"
    "Options:\n"
    "  -h,--help                     print this and exit\n"
    "  --arg ARG                     the next argument: i32:N u32:N i64:N\n"
    "                                buf:SIZE buf@FILE out:SIZE@FILE\n";

TEST(HelpText, IsTheSameWhereItFits) { EXPECT_EQ(wrapped(Page, 70), Page); }

TEST(HelpText, DescriptionsGoOnBelowThemselves) {
  EXPECT_EQ(wrapped(Page, 60),
            "Draws a scene.\n"
            "Usage: splat render [OPTIONS] scene\n"
            "\n"
            "Options:\n"
            "  -h,--help                     print this and exit\n"
            "  --arg ARG                     the next argument: i32:N\n"
            "                                u32:N i64:N buf:SIZE\n"
            "                                buf@FILE out:SIZE@FILE\n");
}

TEST(HelpText, DescriptionsGoBelowTheirOptionsWhereThereIsLittleRoom) {
  EXPECT_EQ(wrapped(Page, 30), "Draws a scene.\n"
                               "Usage: splat render [OPTIONS]\n"
                               "scene\n"
                               "\n"
                               "Options:\n"
                               "  -h,--help\n"
                               "      print this and exit\n"
                               "  --arg ARG\n"
                               "      the next argument: i32:N\n"
                               "      u32:N i64:N buf:SIZE\n"
                               "      buf@FILE out:SIZE@FILE\n");
}

TEST(HelpText, NoLineIsWider) {
  const std::string Long = std::string("  --option=") + std::string(50, 'x') +
                           "  \xe6\xbc\xa2\xe5\xad\x97\xe6\xbc\xa2\xe5\xad\x97"
                           "\xe6\xbc\xa2\xe5\xad\x97\xe6\xbc\xa2\xe5\xad\x97"
                           "\xe6\xbc\xa2\xe5\xad\x97\xe6\xbc\xa2\xe5\xad\x97\n";
  for (std::size_t Columns = 20; Columns <= 90; ++Columns) {
    const std::string All = wrapped(Page + Long, Columns);
    for (std::size_t At = 0; At < All.size();) {
      const std::size_t End = All.find('\n', At);
      EXPECT_LE(columns(All.substr(At, End - At)), Columns);
      At = End + 1;
    }
  }
}

} // namespace
