#include "vorion/support/Suggest.h"

#include <gtest/gtest.h>
#include <vector>

using namespace vorion;

TEST(Suggest, FindsTheNearestWord) {
  const std::vector<std::string> Known = {"--cameras", "--json", "--view",
                                          "render", "train"};
  EXPECT_EQ(closestTo("--camera", Known), "--cameras");
  EXPECT_EQ(closestTo("--jsno", Known), "--json") << "swapped";
  EXPECT_EQ(closestTo("rendr", Known), "render") << "left out";
  EXPECT_EQ(closestTo("traain", Known), "train") << "put in";
  EXPECT_EQ(closestTo("--vieq", Known), "--view") << "changed";
  EXPECT_EQ(closestTo("--nonsense", Known), "");
  EXPECT_EQ(closestTo("x", Known), "");
  EXPECT_EQ(closestTo("", Known), "");
  EXPECT_EQ(closestTo("--view", Known), "") << "what was written";
  EXPECT_EQ(closestTo("--cam", Known), "--cameras") << "begun";
  EXPECT_EQ(closestTo("--ca", Known), "--cameras") << "two letters";
  EXPECT_EQ(closestTo("ren", Known), "render") << "three letters";
  EXPECT_EQ(closestTo("--c", Known), "") << "one letter";
  EXPECT_EQ(closestTo("--", Known), "") << "no letter";
  EXPECT_EQ(didYouMean("rendr", Known), "; did you mean render?");
  EXPECT_EQ(didYouMean("x", Known), "");
  EXPECT_EQ(closestTo(std::string(100'000, 'a'), Known), "");
}

TEST(Suggest, ABeginningOfTwoWordsMeansNeither) {
  const std::vector<std::string> Known = {"cores_per_socket", "warps_per_core",
                                          "warps_per_socket"};
  EXPECT_EQ(closestTo("cores", Known), "cores_per_socket");
  EXPECT_EQ(closestTo("warps", Known), "");
  const std::vector<std::string> Units = {"table32", "table", "table64"};
  EXPECT_EQ(closestTo("tab", Units), "table") << "which begins the others";
}
