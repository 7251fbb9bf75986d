/// `--watchdog`: the machine ends a run that takes longer.

#include "observe/Tool.h"
#include "vorion/isasim/Machine.h"

#include <charconv>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

class WatchdogTool : public Tool {
public:
  explicit WatchdogTool(double Seconds) : Seconds(Seconds) {}
  Expected<Success> attach(Machine &M) override {
    M.setWatchdog(Seconds);
    return Success{};
  }

private:
  double Seconds;
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &) {
  double Seconds = 0;
  const char *End = Text.data() + Text.size();
  const auto Read = std::from_chars(Text.data(), End, Seconds);
  if (Read.ec != std::errc() || Read.ptr != End || !(Seconds > 0))
    return Error{
        "", fmt::format("watchdog of '{}', expected seconds above 0", Text),
        ExitCode::Usage};
  return std::unique_ptr<Tool>(std::make_unique<WatchdogTool>(Seconds));
}

} // namespace

const ToolKind tools::Watchdog{.Make = make};

} // namespace vorion::isasim
