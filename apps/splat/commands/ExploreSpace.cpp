#include "commands/ExploreSpace.h"

#include "commands/PictureOptions.h"
#include "device/Device.h"
#include "explore/Study.h"
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
  const auto Opened = inOwnProcess([&]() -> Expected<std::string> {
    const auto D = Device::open("", changed(Base, Settings));
    return D ? D->name() : Expected<std::string>(D.error());
  });
  return Opened ? Expected<Success>(Success{}) : Opened.error();
}

/// What the device says of a setting, whose variable nobody has set.
std::string withoutVariable(const std::string &What) {
  constexpr std::string_view Variable = "VORION_SET: ";
  return What.starts_with(Variable) ? What.substr(Variable.size()) : What;
}

/// Those of \p App that take a value.
std::vector<std::string> optionsOf(const CLI::App &App) {
  std::vector<std::string> Names;
  for (const CLI::Option *O : App.get_options())
    if (O->get_items_expected_min() > 0)
      Names.push_back(O->get_name());
  return Names;
}

Expected<Success> checkArguments(const std::vector<std::string> &Words) {
  CLI::App App;
  DrawArguments A;
  addDrawOptions(App, A);
  const std::vector<std::string> Known = optionsOf(App);
  const std::string &Option = Words.front();
  if (std::ranges::find(Known, Option) == Known.end())
    return Error{"", fmt::format("{} is no option of how a picture is "
                                 "computed, expected one of {}{}",
                                 Option, fmt::join(Known, ", "),
                                 didYouMean(Option, Known))};
  if (auto Parsed = parseOptions(App, Words); !Parsed)
    return Parsed;
  return parseDrawTexts(A);
}

} // namespace

Expected<Success> checkSpace(const Space &S, const DeviceOptions &Base,
                             const std::string &Where) {
  if (auto Alone = checkSettings("", Base); !Alone)
    return Alone;
  for (const Parameter &P : S)
    for (const Alternative &A : P.Others)
      if (const auto Fits = A.Arguments.empty()
                                ? checkSettings(A.Settings, Base)
                                : checkArguments(A.Arguments);
          !Fits)
        return Error{Where, fmt::format("parameters.{}: {}", P.Name,
                                        withoutVariable(Fits.error().What))};
  return Success{};
}

} // namespace vorion::splat
