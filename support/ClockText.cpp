#include "vorion/support/ClockText.h"

#include <charconv>
#include <fmt/format.h>

namespace vorion {
namespace {

constexpr std::string_view Unit = "MHz";

/// A clock that \p Text gives; nothing if it gives none that a machine can
/// have.
std::optional<uint32_t> mhzOf(std::string_view Text) {
  const bool HasUnit = Text.ends_with(Unit);
  if (HasUnit)
    Text.remove_suffix(Unit.size());
  uint32_t Mhz = 0;
  const char *End = Text.data() + Text.size();
  const auto [Rest, Wrong] =
      std::from_chars(Text.data(), Text.data() + Text.size(), Mhz);
  const uint32_t Least = HasUnit ? 1 : 2;
  if (Wrong != std::errc() || Rest != End || Mhz < Least || Mhz > MostClockMhz)
    return std::nullopt;
  return Mhz;
}

} // namespace

Expected<ClockText> ClockText::parse(std::string_view Text) {
  if (Text.empty())
    return ClockText{Runs::AsConfigured, {}};
  if (Text == "off" || Text == "0" || Text == "false")
    return ClockText{Runs::Never, {}};
  if (Text == "on" || Text == "1" || Text == "true")
    return ClockText{Runs::Always, {}};
  if (Text == "profiled")
    return ClockText{Runs::Profiled, {}};
  if (const auto Mhz = mhzOf(Text))
    return ClockText{Runs::Always, Mhz};
  return Error{"",
               fmt::format("'{}', expected on, off, profiled, or a clock of 2 "
                           "to {} MHz",
                           Text, MostClockMhz),
               ExitCode::Usage};
}

std::string ClockText::ofMhz(uint32_t Mhz) {
  return fmt::format("{}{}", Mhz, Unit);
}

std::string clockedMachine(std::string_view Machine, uint64_t Mhz,
                           uint64_t Version) {
  return fmt::format("{}, {} MHz, clock version {}", Machine, Mhz, Version);
}

} // namespace vorion
