#include "study/PointStore.h"

#include "io/TestFiles.h"

#include <fmt/format.h>

using namespace vorion;
using namespace vorion::splat;

namespace {

using Json = nlohmann::ordered_json;

class PointStoreTest : public ::testing::Test {
protected:
  PointStoreTest() { EXPECT_TRUE(makeFolders(Folder.path("o"))); }

  PointStore open() {
    Log.clear();
    return {Folder.path("o"),
            [](const Json &J) {
              return J.contains("cycles") && J["cycles"].is_number();
            },
            [this](std::string_view Line) { Log += Line; }};
  }

  TestFolder Folder;
  std::string Log;
};

const Provenance From{{"programs", "p"}, {"scene", "A"}};
const Provenance Other{{"programs", "p"}, {"scene", "B"}};

TEST_F(PointStoreTest, AreUsedForTheSameAlone) {
  PointStore First = open();
  EXPECT_EQ(First.find("a@front", From), nullptr);
  ASSERT_TRUE(First.keep("a@front", From, Json{{"cycles", 7}}));
  EXPECT_EQ((*First.find("a@front", From))["cycles"], 7);
  EXPECT_EQ(Log, "");

  PointStore Second = open();
  ASSERT_NE(Second.find("a@front", From), nullptr);
  EXPECT_EQ((*Second.find("a@front", From))["made_from"]["scene"], "A");
  EXPECT_EQ(Log, "");

  PointStore Third = open();
  EXPECT_EQ(Third.find("a@front", Other), nullptr);
  EXPECT_EQ(Third.find("a@front", Other), nullptr);
  EXPECT_EQ(Log, fmt::format("{}: stale, differs in scene: not used",
                             Folder.path("o/points/a@front.json")));
}

/// Each is one line and no measurement.
TEST_F(PointStoreTest, WhatIsNoMeasurementIsNotUsed) {
  PointStore Kept = open();
  ASSERT_TRUE(Kept.keep("a", From, Json{{"cycles", 7}}));
  const std::string Whole = Folder.read("o/points/a.json");
  const auto Cut = [&](std::string_view What, std::string_view By) {
    std::string Text = Whole;
    return Text.replace(Text.find(What), What.size(), By);
  };
  const std::pair<std::string, const char *> Files[] = {
      {"", "an empty file"},
      {"{}", "another point"},
      {"[]", "another point"},
      {"7", "another point"},
      {std::string(200000, '['), "nested deeper than 256"},
      {std::string(100, '[') + std::string(100, ']'), "another point"},
      {Whole.substr(0, Whole.size() / 2), "not JSON"},
      {Cut("\"a\"", "\"b\""), "another point"},
      {Cut("7", "\"7\""), "damaged"},
      {Cut("7", "null"), "damaged"},
      {Cut("\"p\"", "{}"), "stale, differs in programs"}};
  for (const auto &[Text, Why] : Files) {
    Folder.write("o/points/a.json", Text);
    PointStore Again = open();
    EXPECT_EQ(Again.find("a", From), nullptr) << Text.substr(0, 80);
    EXPECT_NE(Log.find(Why), std::string::npos) << Log;
    EXPECT_EQ(Log.find('\n'), std::string::npos);
  }
}

TEST_F(PointStoreTest, NoMeasurementIsNotKept) {
  PointStore Kept = open();
  const auto Done = Kept.keep("a", From, Json{{"cycles", nullptr}});
  ASSERT_FALSE(Done);
  EXPECT_EQ(Done.error().Where, "a");
  EXPECT_FALSE(std::filesystem::exists(Folder.path("o/points/a.json")));
}

} // namespace
