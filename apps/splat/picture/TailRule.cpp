#include "picture/TailRule.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace vorion::splat {

namespace {

template <typename T> bool readAll(std::string_view Text, T &Value) {
  const auto [End, Wrong] =
      std::from_chars(Text.data(), Text.data() + Text.size(), Value);
  return Wrong == std::errc() && End == Text.data() + Text.size();
}

bool readCount(std::string_view Value, TailRule &R) {
  constexpr uint32_t Most = 1U << 24;
  return readAll(Value, R.Count) && R.Count >= 1 && R.Count <= Most;
}

bool readShare(std::string_view Value, TailRule &R) {
  return readAll(Value, R.OccludedShare) && R.OccludedShare > 0 &&
         R.OccludedShare <= 1;
}

bool readLast(std::string_view Value, TailRule &R) {
  constexpr uint32_t Most = 255; // times a list's length fits a word
  const std::size_t Slash = Value.find('/');
  return Slash != std::string_view::npos &&
         readAll(Value.substr(0, Slash), R.LastOver) &&
         readAll(Value.substr(Slash + 1), R.LastUnder) && R.LastOver >= 1 &&
         R.LastOver <= R.LastUnder && R.LastUnder <= Most;
}

bool readReason(std::string_view Reason, TailRule &R) {
  const std::size_t Colon = Reason.find(':');
  const std::string_view Kind = Reason.substr(0, Colon);
  if (Colon == std::string_view::npos)
    return false;
  const std::string_view Value = Reason.substr(Colon + 1);
  if (Kind == "count")
    return readCount(Value, R);
  if (Kind == "occluded")
    return readShare(Value, R);
  return Kind == "last" && readLast(Value, R);
}

} // namespace

uint32_t TailRule::shareBits() const {
  if (OccludedShare <= 0)
    return 0;
  // Not below: a share of the pixels that is reached must hand over.
  return static_cast<uint32_t>(
      std::ceil(static_cast<double>(OccludedShare) * 65536.0));
}

Expected<TailRule> parseTailRule(const std::string &Text) {
  TailRule R;
  if (Text == "off")
    return R;
  std::string_view Rest = Text;
  for (;;) {
    const std::size_t Comma = Rest.find(',');
    if (!readReason(Rest.substr(0, Comma), R))
      return Error{"",
                   fmt::format("--pixel-unit {}: expected off, or one or more "
                               "of count:N, occluded:SHARE (up to 1) and "
                               "last:A/B (A <= B <= 255), joined by commas",
                               Text),
                   ExitCode::Usage};
    if (Comma == std::string_view::npos)
      return R;
    Rest.remove_prefix(Comma + 1);
  }
}

std::string toString(const TailRule &R) {
  std::string Text;
  const auto Add = [&Text](const std::string &Reason) {
    Text += (Text.empty() ? "" : ",") + Reason;
  };
  if (R.Count != 0)
    Add(fmt::format("count:{}", R.Count));
  if (R.OccludedShare > 0)
    Add(fmt::format("occluded:{}", R.OccludedShare));
  if (R.LastOver != 0)
    Add(fmt::format("last:{}/{}", R.LastOver, R.LastUnder));
  return Text.empty() ? "off" : Text;
}

} // namespace vorion::splat
