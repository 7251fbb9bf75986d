#include "vorion/support/Definition.h"

#include "vorion/support/CommandLine.h"
#include "vorion/support/Json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace vorion;

namespace {

using Json = nlohmann::ordered_json;

TEST(Definition, SaysOfEachOptionWhatItTakes) {
  CLI::App App("A tool.", "tool");
  App.footer("last");
  std::string Text;
  int Number = 0;
  bool Flag = false;
  std::vector<std::string> Several;
  CLI::App *Draw = App.add_subcommand("draw", "Draws.");
  takesFile(Draw->add_option("scene", Text, "What."), {".ply"})->required();
  writesFile(Draw->add_option("-o,--output", Text, "Where."), {".png", ".pfm"});
  CLI::Option *Fast = Draw->add_flag("--fast", Flag, "Soon.");
  Draw->add_option("--times", Number, "Often.")
      ->check(isBetween(1, 64))
      ->needs(Fast);
  Draw->add_flag("--why{plan}", Text, "Say.")
      ->option_text("[=measure]")
      ->check(isOneOf({"plan", "measure"}))
      ->excludes(Fast);
  Draw->add_option("--view", Several, "Which.")->allow_extra_args(false);
  takesNameOrFile(Draw->add_option("--preset", Text, "With."), {"fast", "good"},
                  {".json"});

  const auto J = ownJson<Json>(definitionOf(App));
  EXPECT_EQ(J["schema"]["name"], "vorion-command-line");
  EXPECT_EQ(J["tool"]["name"], "tool");
  EXPECT_EQ(J["tool"]["footer"], "last");
  const Json &Command = J["tool"]["commands"][0];
  EXPECT_EQ(Command["name"], "draw");
  const auto Of = [&Command](const std::string &Name) -> Json {
    for (const Json &O : Command["options"]) {
      if (O.value("position", "") == Name)
        return O;
      for (const Json &Each : O["names"])
        if (Each == Name)
          return O;
    }
    return {};
  };
  EXPECT_EQ(Of("scene"), ownJson<Json>(R"({"names": [], "help": "What.",
      "position": "scene", "value": {"name": "FILE", "kind": "file",
      "optional": false, "written": false, "words": [".ply"]},
      "required": true, "repeats": false})"));
  EXPECT_EQ(Of("-o"), ownJson<Json>(R"({"names": ["-o", "--output"],
      "help": "Where.", "value": {"name": "FILE", "kind": "file",
      "optional": false, "written": true, "words": [".png", ".pfm"]},
      "required": false, "repeats": false})"));
  EXPECT_EQ(Of("--fast"),
            ownJson<Json>(R"({"names": ["--fast"], "help": "Soon.",
      "required": false, "repeats": false, "excludes": ["--why"]})"));
  EXPECT_EQ(Of("--times"),
            ownJson<Json>(R"({"names": ["--times"], "help": "Often.",
      "value": {"name": "N", "kind": "any", "optional": false,
      "written": false, "range": "1..64"},
      "required": false, "repeats": false, "needs": ["--fast"]})"));
  EXPECT_EQ(Of("--why"), ownJson<Json>(R"({"names": ["--why"], "help": "Say.",
      "value": {"name": "[=measure]", "kind": "one-of", "optional": true,
      "written": false, "words": ["plan", "measure"]},
      "required": false, "repeats": false, "excludes": ["--fast"]})"));
  EXPECT_TRUE(Of("--view")["repeats"].get<bool>());
  EXPECT_EQ(Of("--preset"),
            ownJson<Json>(R"({"names": ["--preset"], "help": "With.",
      "value": {"name": "NAME|FILE", "kind": "file", "optional": false,
      "written": false, "words": [".json"], "names": ["fast", "good"]},
      "required": false, "repeats": false})"));
}

TEST(Definition, IsPrintedByEveryTool) {
  CLI::App App("A tool.", "tool");
  std::string Text;
  App.add_option("--needed", Text)->required();
  testing::internal::CaptureStdout();
  EXPECT_EQ(parseCommandLine(App, {"--print-definition"}), 0);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), definitionOf(App) + "\n");
}

} // namespace
