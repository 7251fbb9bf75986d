#include "vorion/support/Printable.h"

#include <gtest/gtest.h>

using namespace vorion;

namespace {

TEST(Printable, LeavesLettersOfAllKindsAlone) {
  EXPECT_EQ(escaped("view 3_a~"), "view 3_a~");
  EXPECT_EQ(escaped("Bäume \xe6\xa8\xb9 \xf0\x9f\x8c\xb3"),
            "Bäume \xe6\xa8\xb9 \xf0\x9f\x8c\xb3");
}

TEST(Printable, EscapesWhatATerminalObeys) {
  EXPECT_EQ(escaped("a\x1b[31mb\n\r\t\x7f"), "a\\x1b[31mb\\x0a\\x0d\\x09\\x7f");
  EXPECT_EQ(escaped(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(escaped("\xc2\x9b"
                    "31m"),
            "\\xc2\\x9b31m")
      << "CSI as one byte";
  EXPECT_EQ(escaped("a\xe2\x80\xae"
                    "b"),
            "a\\xe2\\x80\\xaeb")
      << "right to left from here";
}

TEST(Printable, EscapesWhatIsNoUtf8) {
  EXPECT_EQ(escaped("\xff"
                    "a"),
            "\\xffa");
  EXPECT_EQ(escaped("\xc3"), "\\xc3") << "cut short";
  EXPECT_EQ(escaped("\x80"), "\\x80") << "begins in the middle";
  EXPECT_EQ(escaped("\xc0\x9b"), "\\xc0\\x9b") << "overlong";
  EXPECT_EQ(escaped("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "surrogate";
  EXPECT_EQ(escaped("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
}

TEST(Printable, KeepsTheLinesOfReports) {
  EXPECT_EQ(escapedLines("a\n\x1b"
                         "b\n"),
            "a\n\\x1bb\n");
  EXPECT_EQ(escapedLines("a"), "a");
}

TEST(Printable, CountsAndCutsColumns) {
  constexpr const char *Two = "\xe6\xbc\xa2"; // a letter of two columns
  constexpr const char *None = "e\xcc\x81";   // e and an accent behind it
  EXPECT_EQ(columns("abc"), 3U);
  EXPECT_EQ(columns(Two), 2U);
  EXPECT_EQ(columns(None), 1U);
  EXPECT_EQ(columns("\xff"), 1U) << "no UTF-8";
  EXPECT_EQ(firstColumns("abc", 2), "ab");
  EXPECT_EQ(firstColumns(std::string("a") + Two, 2), "a");
  EXPECT_EQ(firstColumns(std::string(None) + "f", 1), None);
}

TEST(Printable, ShortensLongNames) {
  EXPECT_EQ(printable("abc", 3), "abc");
  EXPECT_EQ(printable("ab\ncd", 3), "ab\\x0a...");
  EXPECT_EQ(printable(std::string(100, 'a')).size(), 83U);
}

} // namespace
