#include "vorion/support/Terminal.h"

#include "vorion/support/Environment.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace vorion {

bool canOverwrite() {
  const char *Kind = environmentVariable("TERM");
  return isatty(STDERR_FILENO) != 0 && Kind && std::string_view(Kind) != "dumb";
}

bool canColour() { return canOverwrite() && !environmentVariable("NO_COLOR"); }

std::optional<std::size_t> columnsOf(int File) {
  struct winsize Size{};
  if (::ioctl(File, TIOCGWINSZ, &Size) != 0 || Size.ws_col == 0)
    return std::nullopt;
  return Size.ws_col;
}

std::string barText(std::size_t Done, std::size_t All) {
  constexpr std::size_t Width = 20;
  const std::size_t Full = All == 0 ? 0 : std::min(Done, All) * Width / All;
  return fmt::format("[{:=<{}}{:<{}}]", "", Full, "", Width - Full);
}

std::string durationText(double Seconds) {
  // What is not known, or longer than anybody waits.
  if (!(Seconds >= 0 && Seconds < 1e9))
    return "unknown time";
  const auto Whole = static_cast<long>(std::ceil(Seconds));
  if (Whole < 120)
    return fmt::format("{} s", Whole);
  const long Minutes = (Whole + 30) / 60;
  return Minutes < 120 ? fmt::format("{} min", Minutes)
                       : fmt::format("{} h {} min", Minutes / 60, Minutes % 60);
}

std::string timeLeftText(double Seconds, std::size_t Done, std::size_t All) {
  if (Done == 0 || Done >= All)
    return "";
  const double Each = Seconds / static_cast<double>(Done);
  return fmt::format(", {} left",
                     durationText(Each * static_cast<double>(All - Done)));
}

} // namespace vorion
