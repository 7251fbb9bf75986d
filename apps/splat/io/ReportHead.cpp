#include "io/ReportHead.h"

#include "vorion/support/Version.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <system_error>
#include <unistd.h>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

static std::vector<std::string> &commandLine() {
  static std::vector<std::string> Arguments;
  return Arguments;
}

void setCommandLine(std::vector<std::string> Arguments) {
  commandLine() = std::move(Arguments);
}

void completeCommandLine(std::string Option, std::string Value) {
  commandLine().push_back(std::move(Option));
  commandLine().push_back(std::move(Value));
}

std::string madeBy() {
  std::string Text = fmt::format("splat {}: splat", projectVersion());
  for (const std::string &Word : commandLine())
    Text += " " + Word;
  return Text;
}

bool isRecordedVariable(std::string_view Name) {
  // The machine and its clock; others watch, or say where programs are.
  constexpr std::array<std::string_view, 3> Recorded{
      "VORION_CONFIG", "VORION_SET", "VORION_TIME"};
  return std::ranges::find(Recorded, Name) != Recorded.end();
}

Json reportHead(std::string_view Name, unsigned Version) {
  Json Environment = Json::object();
  for (char **Each = environ; *Each; ++Each) {
    const std::string_view Text = *Each;
    const std::size_t Equals = Text.find('=');
    if (Equals != std::string_view::npos && Equals + 1 < Text.size() &&
        isRecordedVariable(Text.substr(0, Equals)))
      Environment[std::string(Text.substr(0, Equals))] =
          Text.substr(Equals + 1);
  }
  std::error_code Ignored;
  return {{"schema", {{"name", Name}, {"version", Version}}},
          {"program",
           {{"name", "splat"},
            {"version", projectVersion()},
            {"commit", commitOfTree()},
            {"llvm", llvmVersion()},
            {"pocl", poclVersion()},
            {"arguments", commandLine()},
            {"folder", std::filesystem::current_path(Ignored).string()},
            {"environment", Environment}}}};
}

} // namespace vorion::splat
