#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

using namespace vorion;

namespace {

using Sorted = nlohmann::json;
using Ordered = nlohmann::ordered_json;

/// What both kinds of documents say of \p Text: "WHERE: WHAT", or nothing.
std::string errorOf(const std::string &Text, const JsonLimits &Limits = {}) {
  const auto Of = [](const auto &J) {
    return J ? std::string() : J.error().Where + ": " + J.error().What;
  };
  const auto A = Of(parseJson<Sorted>(Text, "f", "a thing", Limits));
  EXPECT_EQ(A, Of(parseJson<Ordered>(Text, "f", "a thing", Limits)));
  return A;
}

std::string nested(std::size_t Depth) {
  return std::string(Depth, '[') + std::string(Depth, ']');
}

TEST(Json, ReadsWhatIsJson) {
  const auto J = parseJson<Ordered>(R"({"b": [1, "]}\"", {}], "a": null})", "f",
                                    "a thing");
  ASSERT_TRUE(J);
  EXPECT_EQ(jsonText(*J), R"({"b":[1,"]}\"",{}],"a":null})");
  EXPECT_EQ(jsonText(*parseJson<Sorted>("{\"b\":1,\"a\":[]}", "f", "a thing")),
            R"({"a":[],"b":1})");
}

TEST(Json, WhatIsNoneIsNamedWithItsPlaceAndWhy) {
  EXPECT_EQ(errorOf(" "),
            "f:1:2: not JSON: unexpected end of input, expected a thing");
  EXPECT_EQ(errorOf("[1,\n 2,\n x]"),
            "f:3:2: not JSON: invalid literal, expected a thing");
  EXPECT_EQ(errorOf("[1]]"),
            "f:1:4: not JSON: unexpected ']', expected a thing");
  EXPECT_EQ(errorOf("{\"a\": \"\xff\"}"),
            "f:1:8: not JSON: invalid string: ill-formed UTF-8 byte, expected "
            "a thing");
  EXPECT_EQ(errorOf("\"\\"), "f:1:3: not JSON: invalid string: forbidden "
                             "character after backslash, expected a thing");
  EXPECT_EQ(
      errorOf("[1e999]"),
      "f: a number outside the range of double, expected one below 1.8e308");
}

TEST(Json, AFileOfAnotherKindIsNamed) {
  EXPECT_EQ(errorOf(""), "f: an empty file, expected a thing");
  EXPECT_EQ(errorOf("\x89PNG\r\n\x1a\n"),
            "f: a picture (PNG), expected a thing; `splat compare` and `splat "
            "train` take pictures");
  EXPECT_EQ(errorOf("<html>"),
            "f: a web page or other XML, expected a thing; "
            "download the file itself, perhaps by another link");
}

TEST(Json, AKeyStandsOnceInItsObject) {
  EXPECT_EQ(errorOf("{\"a\": 1,\n \"b\": 2, \"a\": 3}"),
            "f:2:10: duplicate key a in an object, expected unique keys");
  EXPECT_EQ(errorOf(R"({"a\n": [{}], "\u0061\u000a": 3})"),
            "f:1:15: duplicate key a\\x0a in an object, expected unique keys");
  EXPECT_EQ(errorOf(R"([{"b": {"a": 1, "c": [], "a": 2}}])"),
            "f:1:26: duplicate key a in an object, expected unique keys");
  EXPECT_EQ(errorOf(R"({"a": {"a": "a"}, "b": [{"a": "\":a"}, {"a": "a"}]})"),
            "")
      << "each in an object of its own";
  EXPECT_EQ(errorOf("{\"a\": 1, \"a\": 2"),
            "f:1:16: not JSON: unexpected end of input, expected a thing");
}

TEST(Json, DepthIsBounded) {
  constexpr const char *TooDeep =
      "f: lists and objects nested deeper than 256, expected fewer levels";
  EXPECT_EQ(errorOf(nested(256)), "");
  EXPECT_EQ(errorOf(nested(257)), TooDeep);
  EXPECT_EQ(errorOf(nested(200'000)), TooDeep);
  EXPECT_EQ(errorOf(std::string(200'000, '[')), TooDeep);
  std::string Objects;
  for (int I = 0; I < 300; ++I)
    Objects += "{\"a\":";
  EXPECT_EQ(errorOf(Objects), TooDeep);
  EXPECT_EQ(errorOf('"' + nested(1000) + '"'), "") << "a string is not nested";
  EXPECT_EQ(errorOf("\xef\xbb\xbf " + nested(257)), TooDeep);
  EXPECT_EQ(errorOf("1" + nested(1000)),
            "f:1:2: not JSON: unexpected '[', expected a thing");
  EXPECT_EQ(errorOf("ply\n" + nested(1000)),
            "f: a PLY file, expected a thing; `splat render` and `splat "
            "convert` read scenes")
      << "the first thing that is wrong";
}

TEST(Json, SizesAreBounded) {
  const JsonLimits Small{.Bytes = 16, .Values = 4, .Keys = 2};
  EXPECT_EQ(errorOf("[1,2,3]", Small), "");
  EXPECT_EQ(errorOf("[1,2,3,4]", Small),
            "f: more than 4 values, expected fewer");
  EXPECT_EQ(errorOf("                 1", Small),
            "f: 18 bytes of JSON, expected at most 16");
  EXPECT_EQ(errorOf(R"({"a":1,"b":2})", Small), "");
  EXPECT_EQ(errorOf(R"({"a":1,"b":2,)", Small),
            "f: an object of more than 2 keys, expected fewer");
}

TEST(Json, WritingReplacesWhatIsNoUtf8) {
  EXPECT_EQ(jsonText(Ordered{{"path", "a\xff"}}),
            "{\"path\":\"a\xef\xbf\xbd\"}");
  EXPECT_EQ(jsonText(Sorted{{"a\xff", 1}}, 1), "{\n \"a\xef\xbf\xbd\": 1\n}");
}

const JsonShape &shape() {
  static const JsonShape Shape = JsonShape::object(
      {{"name", JsonShape::text()},
       {"count", JsonShape::whole(1, 9)},
       {"on", JsonShape::boolean(), false},
       {"db", JsonShape::number().orNull(), false},
       {"rows",
        JsonShape::list(
            JsonShape::object({{"x", JsonShape::number()}}).closed(), 1, 2),
        false},
       {"rest", JsonShape::anything(), false}});
  return Shape;
}

std::string problemOf(const std::string &Text) {
  const auto Of = [&](const auto &J) {
    const auto Ok = shape().check(*J, "f");
    return Ok ? std::string() : Ok.error().What;
  };
  const auto A = Of(parseJson<Sorted>(Text, "f", "a thing"));
  EXPECT_EQ(A, Of(parseJson<Ordered>(Text, "f", "a thing")));
  return A;
}

TEST(JsonShape, TakesWhatHasTheShape) {
  EXPECT_EQ(problemOf(R"({"name": "n", "count": 9, "other": [], "db": null,
                         "on": false, "rows": [{"x": 1}, {"x": 0.5}],
                         "rest": {}})"),
            "");
  EXPECT_EQ(problemOf(R"({"name": "n", "count": 1, "db": -1})"), "");
}

TEST(JsonShape, NamesTheFirstThatHasNot) {
  EXPECT_EQ(problemOf("[]"), "a document of type array, expected an object");
  EXPECT_EQ(problemOf("{}"), "key name is missing, expected a string");
  const auto With = [](const std::string &More) {
    auto J = Ordered::parse(R"({"name": "n", "count": 1})");
    J.update(Ordered::parse("{" + More + "}"));
    return problemOf(J.dump());
  };
  EXPECT_EQ(With(R"("name": 5)"), "key name is 5, expected a string");
  EXPECT_EQ(With(R"("name": null)"), "key name is null, expected a string");
  EXPECT_EQ(With(R"("count": 10)"),
            "key count is 10, expected a whole number, 1 to 9");
  EXPECT_EQ(With(R"("count": -1)"),
            "key count is -1, expected a whole number, 1 to 9");
  EXPECT_EQ(With(R"("count": 1.5)"),
            "key count is of type number, expected a whole number, 1 to 9");
  EXPECT_EQ(With(R"("on": "yes")"),
            "key on is of type string, expected true or false");
  EXPECT_EQ(With(R"("db": {})"), "key db is of type object, expected a number");
  EXPECT_EQ(With(R"("rows": [])"),
            "key rows is of type array, expected a list of 1 to 2 values");
  EXPECT_EQ(With(R"("rows": [{"x": 1}, {"x": "y"}])"),
            "key rows[1].x is of type string, expected a number");
  EXPECT_EQ(With(R"("rows": [{"x": 1, "\u001b[31m": 1}])"),
            "unknown key rows[0].\\x1b[31m, expected one of x");
}

} // namespace
