#include "vorion/support/CommandLine.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <optional>
#include <utility>

using namespace vorion;

namespace {

/// What is said of \p Arguments to a tool with two commands.
std::string said(std::vector<std::string> Arguments) {
  CLI::App App("A tool.", "tool");
  App.require_subcommand(1);
  App.fallthrough();
  std::string Set, Cameras, Json, Path, Capture;
  unsigned Threads = 0, Clock = 0;
  double Volts = 0;
  float Near = 0;
  App.add_option("--set", Set);
  CLI::App *Render = App.add_subcommand("render", "");
  takesFile(Render->add_option("--cameras", Cameras))->required();
  takesFile(Render->add_option("-j,--json", Json), {".json"});
  Render->add_option("--path", Path)->check(isOneOf({"raster", "simt"}));
  Render->add_option("--threads", Threads)->type_name("N");
  Render->add_option("--clock", Clock)->check(isBetween(1U, 100000U));
  Render->add_option("--voltage", Volts)->check(isBetween(0.1, 5.0));
  Render->add_option("--near", Near)->option_text("Z");
  Render->add_flag("--draft")->needs("--path")->excludes("--clock");
  CLI::App *Train = App.add_subcommand("train", "");
  Train->add_option("capture", Capture)->required();
  testing::internal::CaptureStderr();
  const auto Code = parseCommandLine(App, std::move(Arguments));
  const std::string Text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(Code.value_or(0), Text.empty() ? 0 : 2);
  return Text;
}

TEST(CommandLine, WhatIsRightIsParsed) {
  EXPECT_EQ(said({"render", "--cameras", "c", "--set", "a=b"}), "");
  EXPECT_EQ(said({"train", "photographs"}), "");
}

TEST(CommandLine, WhatIsNearlyRightIsNamed) {
  EXPECT_EQ(said({"rendr", "--cameras", "c"}),
            "tool: error: unknown subcommand rendr, did you mean render? "
            "(see --help)\n");
  EXPECT_EQ(said({"render", "--camera", "c"}),
            "tool: error: unknown option --camera, did you mean --cameras? "
            "(see --help)\n");
  EXPECT_EQ(said({"render", "--cameras", "c", "--jsno=f"}),
            "tool: error: unknown option --jsno, did you mean --json? "
            "(see --help)\n");
  EXPECT_EQ(said({"train", "--sets", "a=b"}),
            "tool: error: unknown option --sets, did you mean --set? "
            "(see --help)\n");
}

TEST(CommandLine, ValuesThatAreNearlyRightAreNamed) {
  EXPECT_EQ(said({"render", "--cameras", "c", "--path", "simt"}), "");
  EXPECT_EQ(said({"render", "--cameras", "c", "--path", "rastr"}),
            "tool: error: --path: rastr is not known, expected one of raster, "
            "simt; did you mean raster?\n");
  EXPECT_EQ(said({"render", "--cameras", "c", "--path", "cores"}),
            "tool: error: --path: cores is not known, expected one of raster, "
            "simt\n");
}

TEST(CommandLine, EmptyValuesAreRefused) {
  for (const auto &[Option, Kind] : {std::pair("--json", "FILE"),
                                     {"--threads", "N"},
                                     {"--clock", "N"},
                                     {"--path", "raster|simt"},
                                     {"--voltage", "X"},
                                     {"--set", "TEXT"}}) {
    const std::string Expected = fmt::format(
        "tool: error: {}: an empty value, expected {}", Option, Kind);
    const std::string Apart = said({"render", "--cameras", "c", Option, ""});
    EXPECT_TRUE(Apart.starts_with(Expected)) << Apart;
    // Whose value would be the next argument.
    EXPECT_EQ(said({"render", std::string(Option) + "=", "--cameras", "c"}),
              Apart);
  }
  EXPECT_EQ(said({"train", ""}),
            "tool: error: CAPTURE: an empty value, expected TEXT (see "
            "--help)\n");
  EXPECT_EQ(said({"render", "--cameras", "c", "--set", "a="}), "");
  EXPECT_EQ(said({"render", "--camera=", "c"}),
            "tool: error: unknown option --camera, did you mean --cameras? "
            "(see --help)\n");
}

TEST(CommandLine, ANumberThatIsNaNIsRefused) {
  CLI::App App;
  std::optional<double> Least;
  std::vector<float> Several;
  std::string Name;
  App.add_option("--least", Least)->option_text("DB");
  App.add_option("--several", Several)->delimiter(',');
  App.add_option("--name", Name);
  const auto Said = [&App](std::vector<std::string> Arguments) {
    const auto Parsed = parseOptions(App, std::move(Arguments));
    return Parsed ? std::string() : Parsed.error().What;
  };
  EXPECT_EQ(Said({"--least", "nan"}),
            "--least: nan, expected a number (see --help)");
  EXPECT_EQ(Said({"--several", "1,NaN,2"}),
            "--several: NaN, expected a number (see --help)");
  EXPECT_EQ(Said({"--least", "inf"}), "") << "equal pictures have it";
  EXPECT_EQ(Said({"--name", "nan"}), "");
}

TEST(CommandLine, WhatAValueIsCanBeAsked) {
  CLI::App App;
  std::string Text;
  const auto Of = [&App](const char *Option) {
    return valueOf(*App.get_option(Option));
  };
  using Type = OptionValue::Type;
  App.add_option("--any", Text)->check(CLI::Range(1, 2));
  EXPECT_EQ(Of("--any").What, Type::Any);
  App.add_option("--one", Text)->check(isOneOf({"a", "b c", "d"}));
  EXPECT_EQ(Of("--one").What, Type::OneOf);
  EXPECT_EQ(Of("--one").Words, (std::vector<std::string>{"a", "b c", "d"}));
  takesFile(App.add_option("--file", Text), {".png", ".pfm"});
  EXPECT_EQ(Of("--file").What, Type::File);
  EXPECT_EQ(Of("--file").Words, (std::vector<std::string>{".png", ".pfm"}));
  takesFolder(App.add_option("--folder", Text));
  EXPECT_EQ(Of("--folder").What, Type::Folder);
  EXPECT_TRUE(Of("--folder").Words.empty());
  takesSomeOf(App.add_option("--some", Text), {"a", "b"});
  EXPECT_EQ(Of("--some").What, Type::SomeOf);
  EXPECT_EQ(Of("--some").Words, (std::vector<std::string>{"a", "b"}));
  takesView(App.add_option("--view", Text));
  EXPECT_EQ(Of("--view").What, Type::View);
}

TEST(CommandLine, WhatIsWrittenIsToldFromWhatIsRead) {
  CLI::App App;
  std::string Text;
  const auto Of = [&App](const char *Option) {
    return valueOf(*App.get_option(Option));
  };
  using Type = OptionValue::Type;
  takesFile(App.add_option("--in", Text), {".ply"});
  EXPECT_FALSE(Of("--in").IsWritten);
  writesFile(App.add_option("--out", Text), {".ply"});
  EXPECT_EQ(Of("--out").What, Type::File);
  EXPECT_EQ(Of("--out").Words, std::vector<std::string>{".ply"});
  EXPECT_TRUE(Of("--out").IsWritten);
  writesFolder(App.add_option("--folder", Text));
  EXPECT_EQ(Of("--folder").What, Type::Folder);
  EXPECT_TRUE(Of("--folder").IsWritten);
  writesFiles(App.add_option("--plots", Text));
  EXPECT_EQ(Of("--plots").What, Type::Prefix);
  EXPECT_TRUE(Of("--plots").IsWritten);
}

TEST(CommandLine, OptionsThatWriteAreListedByAllTheirNames) {
  CLI::App App;
  std::string Text;
  takesFile(App.add_option("--cameras", Text));
  writesFile(App.add_option("-o,--output", Text));
  App.add_option("--set", Text);
  writesFiles(App.add_option("--plots", Text));
  EXPECT_EQ(writingOptions(App),
            (std::vector<std::string>{"-o", "--output", "--plots"}));
}

TEST(CommandLine, TheCalledCommandIsNoOptionsValue) {
  CLI::App App;
  std::string Text;
  App.add_option("--set", Text);
  const CLI::App *Render = App.add_subcommand("render", "");
  const CLI::App *Train = App.add_subcommand("train", "");
  EXPECT_EQ(calledCommand(App, {"render", "train"}), Render);
  EXPECT_EQ(calledCommand(App, {"--set", "render", "train"}), Train);
  EXPECT_EQ(calledCommand(App, {"--set=render", "train"}), Train);
  EXPECT_EQ(calledCommand(App, {"--set", "train"}), nullptr);
}

TEST(CommandLine, OtherMistakesAreToldAsTheyAre) {
  EXPECT_EQ(said({"paint"}),
            "tool: error: unknown subcommand paint (see --help)\n");
  EXPECT_EQ(said({"render", "--nonsense", "c"}),
            "tool: error: unknown option --nonsense (see --help)\n");
  EXPECT_EQ(said({"render"}),
            "tool: error: --cameras is missing, expected: tool render "
            "--cameras FILE (see --help)\n");
  EXPECT_EQ(said({"train"}),
            "tool: error: CAPTURE is missing, expected: tool train CAPTURE "
            "(see --help)\n");
  EXPECT_EQ(said({}), ""); // but help, on standard output
  EXPECT_EQ(said({"--set", "a=b"}),
            "tool: error: no subcommand, expected one of render, train (see "
            "--help)\n");
  EXPECT_EQ(said({"render", "--\x1b[31m"}),
            "tool: error: unknown option --\\x1b[31m (see --help)\n");
  EXPECT_EQ(said({"render", "--cameras", "c", "d"}),
            "tool: error: unexpected argument d (see --help)\n");
  EXPECT_EQ(said({"render", "--cameras", "c", "--", "d"}),
            "tool: error: unexpected argument d (see --help)\n");
}

/// What is printed on standard output for \p Arguments.
std::string printed(std::vector<std::string> Arguments) {
  testing::internal::CaptureStdout();
  EXPECT_EQ(said(std::move(Arguments)), "");
  return testing::internal::GetCapturedStdout();
}

TEST(CommandLine, HelpIsACommandToo) {
  const std::string All = printed({"--help"});
  EXPECT_NE(All.find("--set"), std::string::npos);
  EXPECT_EQ(printed({"help"}), All);
  const std::string OfRender = printed({"render", "--help"});
  EXPECT_NE(OfRender.find("--cameras"), std::string::npos);
  EXPECT_EQ(printed({"help", "render"}), OfRender);
  EXPECT_EQ(said({"help", "rendr"}),
            "tool: error: unknown subcommand rendr, did you mean render? (see "
            "--help)\n");
  EXPECT_EQ(said({"train", "help"}), "") << "a capture of that name";
}

TEST(CommandLine, NumbersThatNoFloatHoldsAreRefused) {
  const auto SaidOf = [](const char *Near) {
    return said({"render", "--cameras", "c", "--near", Near});
  };
  for (const char *Good : {"0", "-0.0", "0e99", "1e-45", "3e38", "-3e38", "inf",
                           "-inf", "5", "0x1p-3"})
    EXPECT_EQ(SaidOf(Good), "") << Good;
  for (const char *Zero : {"1e-46", "-1e-46", "1e-400", "0.5e-4999", "1e-9999"})
    EXPECT_EQ(SaidOf(Zero),
              fmt::format("tool: error: --near: {} is 0 in single "
                          "precision, expected 0 or a size from "
                          "1.4e-45 to 3.4e+38 (see --help)\n",
                          Zero));
  for (const char *Infinite : {"1e39", "-1e39", "1e400", "1e9999"})
    EXPECT_EQ(SaidOf(Infinite),
              fmt::format("tool: error: --near: {} is infinite in single "
                          "precision, expected a size from 1.4e-45 to 3.4e+38 "
                          "(see --help)\n",
                          Infinite));
}

TEST(CommandLine, NoMessageIsTheParsersOwn) {
  const auto SaidOf = [](std::vector<std::string> More) {
    More.insert(More.begin(), {"render", "--cameras", "c"});
    return said(std::move(More));
  };
  EXPECT_EQ(SaidOf({"--threads", "4", "--clock", "530", "--voltage", "1"}), "");
  EXPECT_EQ(SaidOf({"--threads"}),
            "tool: error: --threads: a value is missing, expected N (see "
            "--help)\n");
  EXPECT_EQ(SaidOf({"--json", "--path", "simt"}),
            "tool: error: --json: a value is missing, expected FILE (see "
            "--help)\n");
  EXPECT_EQ(SaidOf({"--threads", "-1"}),
            "tool: error: --threads: -1 is not a valid number (see "
            "--help)\n");
  EXPECT_EQ(SaidOf({"--threads", "1", "--threads", "2"}),
            "tool: error: --threads: 2 values, expected at most 1 (see "
            "--help)\n");
  EXPECT_EQ(SaidOf({"--clock", "1e3"}),
            "tool: error: --clock: 1e3, expected a whole number from 1 to "
            "100000\n");
  EXPECT_EQ(SaidOf({"--clock", "0"}),
            "tool: error: --clock: 0, expected a whole number from 1 to "
            "100000\n");
  EXPECT_EQ(SaidOf({"--draft"}),
            "tool: error: --draft requires --path, expected both (see "
            "--help)\n");
  EXPECT_EQ(SaidOf({"--draft", "--path", "simt", "--clock", "1"}),
            "tool: error: --clock excludes --draft, expected one of them (see "
            "--help)\n");
  for (const char *Wrong : {"5.5", "nan", "V"})
    EXPECT_EQ(SaidOf({"--voltage", Wrong}),
              "tool: error: --voltage: " + std::string(Wrong) +
                  ", expected a number from 0.1 to 5\n");
}

} // namespace
