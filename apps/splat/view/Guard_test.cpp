#include "view/Guard.h"

#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

class GuardTest : public testing::Test {
protected:
  GuardTest() { Door.listensOn(8080); }
  bool passes(const Visitor &V) const { return !Door.refuse(V); }

  Guard Door{"0123abcd"};
  const Visitor Own{false, false, "127.0.0.1:8080", "", "0123abcd"};
  const Visitor Post{true, false, "localhost:8080", "http://localhost:8080",
                     "0123abcd"};
};

TEST_F(GuardTest, OwnPagePasses) {
  EXPECT_TRUE(passes(Own));
  EXPECT_TRUE(passes(Post));
}

TEST_F(GuardTest, OtherHostsAreRefused) {
  for (const char *Host : {"", "127.0.0.1", "127.0.0.1:80", "evil.example:8080",
                           "127.0.0.1:8080.evil.example", "[::1]:8080"}) {
    Visitor V = Own;
    V.Host = Host;
    EXPECT_FALSE(passes(V)) << Host;
  }
}

TEST_F(GuardTest, OtherOriginsAreRefused) {
  for (const char *Origin :
       {"", "null", "http://127.0.0.1:8080", "https://localhost:8080",
        "http://localhost:80800", "http://evil.example"}) {
    Visitor V = Post;
    V.Origin = Origin;
    EXPECT_FALSE(passes(V)) << Origin;
  }
  Visitor Get = Own;
  Get.Origin = "http://evil.example";
  EXPECT_FALSE(passes(Get));
}

TEST_F(GuardTest, OnlyThePageNeedsNoToken) {
  for (const char *Token : {"", "0123abce", "0123abc", "0123abcdd"}) {
    Visitor V = Own;
    V.Token = Token;
    EXPECT_FALSE(passes(V)) << Token;
    V.IsPage = true;
    EXPECT_TRUE(passes(V)) << Token;
    V.Host = "evil.example";
    EXPECT_FALSE(passes(V)) << Token;
  }
}

TEST(GuardToken, IsLongAndDifferentEachTime) {
  const auto A = Guard::make(), B = Guard::make();
  ASSERT_TRUE(A && B);
  EXPECT_EQ(A->token().size(), 32U);
  EXPECT_NE(A->token(), B->token());
}

TEST(GuardToken, ComparisonSeesEveryByte) {
  const std::string Kept = "abcdef";
  EXPECT_TRUE(sameInConstantTime(Kept, "abcdef"));
  for (std::size_t I = 0; I != Kept.size(); ++I) {
    std::string Other = Kept;
    Other[I] ^= 1;
    EXPECT_FALSE(sameInConstantTime(Kept, Other));
  }
  EXPECT_FALSE(sameInConstantTime(Kept, "abcdefabcdef"));
  EXPECT_FALSE(sameInConstantTime("", "a"));
}

} // namespace
