/// `--region`: which launches the clock is on for, and a file of them
/// (docs/regions.md).

#include "observe/SettingsOnce.h"
#include "observe/Tool.h"
#include "region/RegionFile.h"
#include "vorion/isasim/Machine.h"

#include <charconv>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <utility>

namespace vorion::isasim {

namespace {

template <typename Number> bool readNumber(std::string_view Text, Number &To) {
  const auto R = std::from_chars(Text.begin(), Text.end(), To);
  return R.ec == std::errc() && R.ptr == Text.end() && To != 0;
}

/// A launch: "7" is the seventh of all, "blend:7" the seventh of a kernel.
struct Mark {
  std::string Text, Kernel;
  uint64_t Number = 1;

  bool parse(std::string_view From) {
    Text = From;
    if (readNumber(From, Number))
      return true;
    const size_t Colon = From.find(':');
    Kernel = From.substr(0, Colon);
    return !Kernel.empty() &&
           Kernel.find_first_not_of("0123456789") != std::string::npos &&
           (Colon == std::string_view::npos ||
            readNumber(From.substr(Colon + 1), Number));
  }
};

struct RegionOptions {
  std::optional<Mark> Warm, To;
  Mark From{.Text = "1", .Kernel = "", .Number = 1};
  std::optional<uint64_t> Count;
  std::string Save;

  static Expected<RegionOptions> parse(std::string_view Text);

private:
  bool set(std::string_view Name, std::string_view Value);
  /// Whether `to` is known to come no later than `from`.
  bool isEmpty() const {
    return To && To->Kernel == From.Kernel && To->Number <= From.Number;
  }
};

bool RegionOptions::set(std::string_view Name, std::string_view Value) {
  if (Name == "warm")
    return Warm.emplace().parse(Value);
  if (Name == "from")
    return From.parse(Value);
  if (Name == "to")
    return !Count && To.emplace().parse(Value);
  if (Name == "count")
    return !To && readNumber(Value, Count.emplace());
  Save = Value;
  return Name == "save" && !Save.empty();
}

Expected<RegionOptions> RegionOptions::parse(std::string_view Text) {
  RegionOptions O;
  SettingsOnce Given;
  for (bool More = true; More;) {
    const size_t Comma = Text.find(',');
    const std::string_view Setting = Text.substr(0, Comma);
    const size_t Equal = Setting.find('=');
    if (!Given.isNew(Setting))
      return SettingsOnce::twice("region", Setting);
    if (Equal == std::string_view::npos ||
        !O.set(Setting.substr(0, Equal), Setting.substr(Equal + 1)))
      return Error{
          "",
          fmt::format("region setting '{}', expected warm=LAUNCH, "
                      "from=LAUNCH, to=LAUNCH or count=N, save=FILE, "
                      "where LAUNCH is N, KERNEL or KERNEL:N, N from 1",
                      Setting),
          ExitCode::Usage};
    More = Comma != std::string_view::npos;
    Text.remove_prefix(More ? Comma + 1 : 0);
  }
  if (O.isEmpty())
    return Error{
        "",
        fmt::format(
            "region: to={} is not after from={}, expected a later launch",
            O.To->Text, O.From.Text),
        ExitCode::Usage};
  return O;
}

class RegionTool : public Tool {
public:
  explicit RegionTool(RegionOptions OptionsIn)
      : Options(std::move(OptionsIn)) {}

  Expected<Success> attach(Machine &M) override {
    Device = &M;
    Device->setClocking(Clocking::Off);
    return Success{};
  }
  void runBegins(const std::string &Name, uint32_t LaunchBlock) override;
  Expected<Success> runEnded(const std::string &, const RunResult &R) override;
  Expected<Success> finished() const override;

private:
  enum class Phase { Before, Warming, Counted, Behind };

  bool isAt(const Mark &M) const {
    return M.Number == (M.Kernel.empty() ? Launches : launchesOf(M.Kernel)) &&
           (M.Kernel.empty() || M.Kernel == Name);
  }
  uint64_t launchesOf(const std::string &Kernel) const {
    const auto Found = OfKernel.find(Kernel);
    return Found == OfKernel.end() ? 0 : Found->second;
  }
  bool isInside() const {
    return Now == Phase::Warming || Now == Phase::Counted;
  }
  void choosePhase();
  void begin();
  std::string lastMarks() const;

  const RegionOptions Options;
  Machine *Device = nullptr;
  std::string Name;      ///< of the launch at hand
  uint64_t Launches = 0; ///< with it
  std::map<std::string, uint64_t> OfKernel;
  uint64_t Counted = 0;
  Phase Now = Phase::Before;
  std::optional<RegionWriter> File;
  std::optional<Error> Problem; ///< of the launch's beginning
};

void RegionTool::choosePhase() {
  if (Now == Phase::Before && Options.Warm && isAt(*Options.Warm))
    Now = Phase::Warming;
  if (Now == Phase::Counted && ((Options.To && isAt(*Options.To)) ||
                                (Options.Count && Counted == *Options.Count)))
    Now = Phase::Behind;
  if (Now < Phase::Counted && isAt(Options.From)) {
    if (Options.Warm && Now == Phase::Before)
      Problem = Error{
          "",
          fmt::format(
              "region: from={} is before warm={}, expected a later launch",
              Options.From.Text, Options.Warm->Text),
          ExitCode::Usage};
    Now = Phase::Counted;
  }
  Counted += Now == Phase::Counted;
}

/// At the region's first launch. Neither the clock nor a file knows what a
/// rasterizer has left to do.
void RegionTool::begin() {
  if (!Device->rasterState()) {
    Problem = Error{"",
                    "a region cannot start while a rasterizer has a command of "
                    "an earlier launch, expected another start",
                    ExitCode::Usage};
    Now = Phase::Behind;
    return;
  }
  if (Options.Save.empty())
    return;
  Expected<RegionWriter> Made = RegionWriter::create(Options.Save, *Device);
  if (Made)
    File = std::move(*Made);
  else
    Problem = Made.error();
}

void RegionTool::runBegins(const std::string &NameIn, uint32_t LaunchBlock) {
  Name = NameIn;
  ++Launches;
  ++OfKernel[Name];
  const bool WasBefore = Now == Phase::Before;
  choosePhase();
  if (WasBefore && isInside())
    begin();
  Device->setClocking(Now == Phase::Counted   ? Clocking::On
                      : Now == Phase::Warming ? Clocking::WarmUp
                                              : Clocking::Off);
  if (isInside() && File)
    File->begin(*Device, Name, LaunchBlock, Now == Phase::Counted);
}

Expected<Success> RegionTool::runEnded(const std::string &,
                                       const RunResult &R) {
  if (Problem)
    return *std::exchange(Problem, std::nullopt);
  if (!isInside() || !File)
    return Success{};
  // A launch that failed is no part of a region: it would fail again.
  if (R.End == Outcome::Done)
    return File->end();
  File.reset();
  return Success{};
}

/// The last launch of each kernel, as a setting names it.
std::string RegionTool::lastMarks() const {
  std::string Text;
  for (const auto &[Kernel, Count] : OfKernel)
    Text += fmt::format("{}{}:{}", Text.empty() ? "" : ", ", Kernel, Count);
  return Text;
}

Expected<Success> RegionTool::finished() const {
  const Mark *Missing = Now < Phase::Counted                  ? &Options.From
                        : Now == Phase::Counted && Options.To ? &*Options.To
                                                              : nullptr;
  if (Missing)
    return Error{
        "",
        fmt::format("region: {}={} was not reached, expected one of {}",
                    Missing == &Options.From ? "from" : "to", Missing->Text,
                    lastMarks()),
        ExitCode::Usage};
  if (Now == Phase::Counted && Options.Count && Counted < *Options.Count)
    return Error{
        "",
        fmt::format(
            "region: count={} was not reached, launches since from={}: {}",
            *Options.Count, Options.From.Text, Counted),
        ExitCode::Usage};
  return Success{};
}

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &) {
  Expected<RegionOptions> O = RegionOptions::parse(Text);
  if (!O)
    return O.error();
  return std::unique_ptr<Tool>(std::make_unique<RegionTool>(std::move(*O)));
}

std::vector<NamedFile> outputs(const std::string &Text) {
  const auto O = RegionOptions::parse(Text);
  return {{"--region", O ? O->Save : ""}};
}

} // namespace

const ToolKind tools::Region{
    .Make = make, .Outputs = outputs, .NeedsClock = true};

} // namespace vorion::isasim
