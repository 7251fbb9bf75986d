#include "commands/ExploreSpace.h"

#include "commands/PictureOptions.h"
#include "commands/TrainedOptions.h"
#include "device/Device.h"
#include "explore/Trials.h"
#include "render/OwnProcess.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace vorion::splat {
namespace {

/// A process has devices of one set of options.
Expected<Success> checkSettings(const std::string &Settings,
                                const DeviceOptions &Base) {
  DeviceOptions Machine = changed(Base, Settings);
  Machine.set("VORION_TIME", "off"); // the machine is checked, not measured
  const auto Opened = inOwnProcess([&]() -> Expected<std::string> {
    const auto D = Device::open("", Machine);
    return D ? D->name() : Expected<std::string>(D.error());
  });
  return Opened ? Expected<Success>(Success{}) : Opened.error();
}

/// What the device says of a setting, whose variable nobody has set.
std::string withoutVariable(const std::string &What) {
  constexpr std::string_view Variable = "VORION_SET: ";
  return What.starts_with(Variable) ? What.substr(Variable.size()) : What;
}

/// The options by which a picture, or an iteration, is computed.
struct ComputingOptions {
  CLI::App App;
  DrawArguments Draw;
  TrainRequest Train;

  explicit ComputingOptions(Work W) {
    if (W == Work::Frames)
      addDrawOptions(App, Draw);
    else {
      addTrainPathOptions(App, Train);
      // A space's tiles are those of frames: iterations have other sizes.
      App.remove_option(App.get_option("--tile"));
    }
  }
  /// Those that take a value, as help has them.
  std::vector<std::string> names() const {
    std::vector<std::string> Names;
    for (const CLI::Option *O : App.get_options())
      if (O->get_items_expected_min() > 0)
        Names.push_back(O->get_name());
    return Names;
  }
};

/// By each kind of work that takes the option.
Expected<Success> checkArguments(const std::vector<std::string> &Words,
                                 const Workload &Does) {
  const std::string &Option = Words.front();
  std::vector<std::string> Known;
  bool IsKnown = false;
  for (const Work W : AllWork) {
    if (!Does.has(W))
      continue;
    ComputingOptions Of(W);
    const std::vector<std::string> Names = Of.names();
    for (const std::string &Name : Names)
      if (std::ranges::find(Known, Name) == Known.end())
        Known.push_back(Name);
    if (std::ranges::find(Names, Option) == Names.end())
      continue;
    IsKnown = true;
    if (auto Parsed = parseOptions(Of.App, Words); !Parsed)
      return Parsed;
    if (auto Parsed = parseDrawTexts(Of.Draw); !Parsed)
      return Parsed;
  }
  if (IsKnown)
    return Success{};
  const char *What = !Does.has(Work::Iterations) ? "a picture"
                     : !Does.has(Work::Frames)   ? "an iteration"
                                                 : "a picture or an iteration";
  return Error{
      "", fmt::format(
              "{} is not an option for computing {}, expected one of {}{}",
              Option, What, fmt::join(Known, ", "), didYouMean(Option, Known))};
}

} // namespace

std::set<std::string> computingOptions(Work W) {
  const std::vector<std::string> Names = ComputingOptions(W).names();
  return {Names.begin(), Names.end()};
}

Expected<Success> checkSpace(const Space &S, const Workload &Does,
                             const DeviceOptions &Base,
                             const std::string &Where) {
  if (auto Alone = checkSettings("", Base); !Alone)
    return Alone;
  for (const Parameter &P : S)
    for (const Alternative &A : P.Others)
      if (const auto Fits = A.Arguments.empty()
                                ? checkSettings(A.Settings, Base)
                                : checkArguments(A.Arguments, Does);
          !Fits)
        return Error{Where, fmt::format("parameters.{}: {}", P.Name,
                                        withoutVariable(Fits.error().What))};
  return Success{};
}

} // namespace vorion::splat
