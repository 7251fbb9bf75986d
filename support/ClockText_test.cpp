#include "vorion/support/ClockText.h"

#include <gtest/gtest.h>

namespace {

using vorion::ClockText;
using Runs = ClockText::Runs;

TEST(ClockText, WordsAndTheirNumbers) {
  for (const auto &[Text, When] : {std::pair("", Runs::AsConfigured),
                                   {"off", Runs::Never},
                                   {"0", Runs::Never},
                                   {"false", Runs::Never},
                                   {"on", Runs::Always},
                                   {"1", Runs::Always},
                                   {"true", Runs::Always},
                                   {"profiled", Runs::Profiled}}) {
    const auto Read = ClockText::parse(Text);
    ASSERT_TRUE(Read) << Text;
    EXPECT_EQ(Read->When, When) << Text;
    EXPECT_FALSE(Read->Mhz) << Text << " is no clock";
  }
}

TEST(ClockText, ClocksWithAndWithoutTheirUnit) {
  for (const auto &[Text, Mhz] : {std::pair("2", 2U),
                                  {"100", 100U},
                                  {"1MHz", 1U},
                                  {"100000MHz", 100000U}}) {
    const auto Read = ClockText::parse(Text);
    ASSERT_TRUE(Read) << Text;
    EXPECT_EQ(Read->When, Runs::Always) << Text;
    EXPECT_EQ(Read->Mhz, Mhz) << Text;
  }
  for (const uint32_t Mhz : {1U, 530U}) {
    const auto Read = ClockText::parse(ClockText::ofMhz(Mhz));
    ASSERT_TRUE(Read);
    EXPECT_EQ(Read->Mhz, Mhz);
  }
}

TEST(ClockText, WhatSaysNeitherIsRefused) {
  for (const char *Text : {"fast", "On", "-1", "0MHz", "MHz", "1.5", "100 ",
                           "100001", "530000000", "5000000000"}) {
    const auto Read = ClockText::parse(Text);
    ASSERT_FALSE(Read) << Text;
    EXPECT_EQ(Read.error().What,
              "'" + std::string(Text) +
                  "', expected on, off, profiled, or a clock of 2 to 100000 "
                  "MHz");
  }
}

} // namespace
