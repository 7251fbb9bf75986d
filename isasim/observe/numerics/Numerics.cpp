#include "observe/numerics/Numerics.h"

#include "observe/Tool.h"
#include "observe/numerics/NumericReport.h"
#include "vorion/support/File.h"

#include <charconv>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

template <typename T> bool readNumber(std::string_view Text, T &To) {
  const auto Read = std::from_chars(Text.begin(), Text.end(), To);
  return Read.ec == std::errc() && Read.ptr == Text.end();
}

Error badSetting(std::string_view Setting, std::string_view Wanted) {
  return {"",
          fmt::format("numerics setting '{}', expected {}", Setting, Wanted),
          ExitCode::Usage};
}

Expected<Success> set(NumericOptions &O, std::string_view Setting) {
  const size_t Equal = Setting.find('=');
  const std::string_view Name = Setting.substr(0, Equal);
  const std::string_view Value =
      Equal == std::string_view::npos ? "" : Setting.substr(Equal + 1);
  if (Name == "rel")
    return readNumber(Value, O.Limits.Relative) && O.Limits.Relative > 0 &&
                   O.Limits.Relative < 1
               ? Expected<Success>(Success{})
               : badSetting(Setting, "rel=R between 0 and 1");
  if (Name == "cancel")
    return readNumber(Value, O.Limits.CancelBits) && O.Limits.CancelBits >= 1 &&
                   O.Limits.CancelBits <= 60
               ? Expected<Success>(Success{})
               : badSetting(Setting, "cancel=BITS, 1 to 60");
  if (Name == "top")
    return readNumber(Value, O.Top)
               ? Expected<Success>(Success{})
               : badSetting(Setting, "top=N, a whole number");
  if ((Name == "text" || Name == "json") && !Value.empty()) {
    (Name == "text" ? O.Text : O.Json) = Value;
    return Success{};
  }
  return badSetting(Setting, "on, or some of rel=R, cancel=BITS, top=N, "
                             "text=FILE, json=FILE");
}

} // namespace

Expected<NumericOptions> NumericOptions::parse(std::string_view Text) {
  NumericOptions O;
  while (Text != "on") {
    const size_t Comma = Text.find(',');
    if (Expected<Success> Ok = set(O, Text.substr(0, Comma)); !Ok)
      return Ok.error();
    if (Comma == std::string_view::npos)
      break;
    Text.remove_prefix(Comma + 1);
  }
  if (O.Text.empty() && O.Json.empty())
    O.Text = "-";
  return O;
}

Numerics::Numerics(NumericOptions O)
    : Options(std::move(O)), Cores(Sites, Memory, Options.Limits),
      Units(Sites, Memory) {}

void Numerics::runBegins(const RunStart &R) {
  ++Runs;
  Cores.runBegins(R);
  Units.runBegins(R);
}

std::string Numerics::text() const {
  return numericText(
      {Sites, Units.findings(), Options.Limits, Runs, Options.Top});
}

std::string Numerics::json() const {
  return numericJson(
      {Sites, Units.findings(), Options.Limits, Runs, Options.Top});
}

namespace {

class NumericsTool : public Tool {
public:
  NumericsTool(NumericOptions Options, const ToolOutput &To)
      : Options(std::move(Options)), Shadow(this->Options), Print(To.Print) {}
  std::vector<Observer *> observers() override { return {&Shadow}; }
  Expected<Success> runEnded(const std::string &, const RunResult &) override {
    if (Options.Text == StandardOutput)
      Print(Shadow.text());
    else if (!Options.Text.empty())
      if (Expected<Success> Ok =
              writeFileAtomically(Options.Text, Shadow.text());
          !Ok)
        return Ok;
    if (!Options.Json.empty())
      return writeFileAtomically(Options.Json, Shadow.json());
    return Success{};
  }

private:
  NumericOptions Options;
  Numerics Shadow;
  std::function<void(std::string_view)> Print;
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &To) {
  const Expected<NumericOptions> O = NumericOptions::parse(Text);
  if (!O)
    return O.error();
  if (O->Text == StandardOutput && !To.Print)
    return Error{
        "",
        "the numerics report has no output, expected text=FILE or json=FILE",
        ExitCode::Usage};
  return std::unique_ptr<Tool>(std::make_unique<NumericsTool>(*O, To));
}

std::vector<NamedFile> outputs(const std::string &Text) {
  std::vector<NamedFile> Files;
  if (const auto O = NumericOptions::parse(Text)) {
    if (O->Text != StandardOutput)
      Files.push_back({"text= of --numerics", O->Text});
    Files.push_back({"json= of --numerics", O->Json});
  }
  return Files;
}

} // namespace

const ToolKind tools::Numerics{.Make = make, .Outputs = outputs};

} // namespace vorion::isasim
