#include "tools/Arguments.h"

#include <cstring>
#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::isasim;

namespace {

template <typename T> T valueOf(std::string_view Text) {
  const Expected<KernelInput> In = parseInput(Text);
  EXPECT_TRUE(In) << Text;
  T Value{};
  EXPECT_EQ(In->Bytes.size(), sizeof(T));
  std::memcpy(&Value, In->Bytes.data(), sizeof(T));
  return Value;
}

} // namespace

TEST(Arguments, Values) {
  EXPECT_EQ(valueOf<int32_t>("i32:-5"), -5);
  EXPECT_EQ(valueOf<uint32_t>("u32:0xffffffff"), 0xFFFFFFFFU);
  EXPECT_EQ(valueOf<int64_t>("i64:-9000000000"), -9000000000);
  EXPECT_EQ(valueOf<float>("f32:1.5"), 1.5F);
  EXPECT_EQ(valueOf<float>("f32:-1e-3"), -1e-3F);
  EXPECT_EQ(valueOf<uint32_t>("bytes:78563412"), 0x12345678U);
}

TEST(Arguments, KindsOfValues) {
  EXPECT_EQ(parseInput("u64:1")->What, KernelInput::Integer);
  EXPECT_EQ(parseInput("f32:1")->What, KernelInput::Float);
  EXPECT_EQ(parseInput("bytes:00")->What, KernelInput::Value);
}

TEST(Arguments, Buffers) {
  EXPECT_EQ(parseInput("buf:64")->Size, 64U);
  EXPECT_EQ(parseInput("buf@a@b.bin")->ReadFrom, "a@b.bin");
  EXPECT_EQ(parseInput("out:16@r.bin")->WriteTo, "r.bin");
  EXPECT_EQ(parseInput("out:16@r.bin")->Size, 16U);
  EXPECT_EQ(parseInput("inout:d.bin")->ReadFrom, "d.bin");
  EXPECT_EQ(parseInput("inout:d.bin")->WriteTo, "d.bin");
  EXPECT_EQ(parseInput("inout:a.bin@b.bin")->ReadFrom, "a.bin");
  EXPECT_EQ(parseInput("inout:a.bin@b.bin")->WriteTo, "b.bin");
  EXPECT_EQ(parseInput("local:256")->What, KernelInput::Local);
}

TEST(Arguments, MalformedOnesAreErrors) {
  for (const char *Text :
       {"", "5", "i32:", "i32:5x", "i32:3000000000", "f32:one", "buf:0",
        "buf:", "buf@", "out:16", "out:16@", "out:x@f", "inout:", "inout:@b",
        "inout:a@", "bytes:123", "bytes:zz", "local:-1", "u32:-1"}) {
    const Expected<KernelInput> In = parseInput(Text);
    ASSERT_FALSE(In) << Text;
    EXPECT_EQ(In.error().Code, ExitCode::Usage);
  }
}

TEST(Arguments, Sizes) {
  std::array<uint32_t, 3> S{};
  EXPECT_EQ(parseSizes("64", S), 1U);
  EXPECT_EQ(S, (std::array<uint32_t, 3>{64, 1, 1}));
  EXPECT_EQ(parseSizes("4,5,6", S), 3U);
  EXPECT_EQ(S, (std::array<uint32_t, 3>{4, 5, 6}));
  for (const char *Text : {"", "0", "4,", ",4", "1,2,3,4", "a", "4294967296"})
    EXPECT_EQ(parseSizes(Text, S), 0U) << Text;
}

TEST(Arguments, Requests) {
  const auto R = parseRequest(
      R"({"kernel": "k", "global": [64, 2], "args": ["i32:1", "buf:4"]})", "f");
  ASSERT_TRUE(R);
  EXPECT_EQ(R->Kernel, "k");
  EXPECT_EQ(R->WorkDim, 2U);
  EXPECT_EQ(R->Global, (std::array<uint32_t, 3>{64, 2, 1}));
  EXPECT_EQ(R->Local[0], 0U);
  EXPECT_EQ(R->Args.size(), 2U);
  for (const char *Text :
       {"", "[]", "{}", R"({"global": []})", R"({"global": [0]})",
        R"({"global": [1,1,1,1]})", R"({"global": [1], "locals": [1]})",
        R"({"global": [1], "args": [5]})", R"({"global": [1], "local": 4})",
        R"({"global": [-1]})", R"({"global": [1], "kernel": 3})"}) {
    const auto Bad = parseRequest(Text, "f");
    ASSERT_FALSE(Bad) << Text;
    EXPECT_NE(Bad.error().What.find("expected"), std::string::npos) << Text;
  }
}
