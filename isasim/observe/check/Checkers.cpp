#include "observe/check/Checkers.h"

#include "observe/Tool.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

constexpr std::string_view Names[] = {
#define VORION_CHECK(NAME, MAKE, DOC) #NAME,
#include "observe/check/Checks.def"
#undef VORION_CHECK
};

/// By the number of their name.
constexpr std::unique_ptr<Check> (*Makers[])(Findings &, const Places &) = {
#define VORION_CHECK(NAME, MAKE, DOC) MAKE,
#include "observe/check/Checks.def"
#undef VORION_CHECK
};

/// A bit for each name in \p Text.
Expected<uint32_t> parse(std::string_view Text) {
  uint32_t Wanted = 0;
  while (true) {
    const size_t Comma = Text.find(',');
    const std::string_view Name = Text.substr(0, Comma);
    const auto *Found = std::find(std::begin(Names), std::end(Names), Name);
    if (Name == "all")
      Wanted = (1U << std::size(Names)) - 1;
    else if (Found != std::end(Names))
      Wanted |= 1U << (Found - std::begin(Names));
    else
      return Error{"",
                   fmt::format("check '{}', expected all or some of {}", Name,
                               fmt::join(Names, ",")),
                   ExitCode::Usage};
    if (Comma == std::string_view::npos)
      return Wanted;
    Text.remove_prefix(Comma + 1);
  }
}

} // namespace

Expected<std::unique_ptr<Checkers>>
Checkers::create(std::string_view Text,
                 std::function<void(std::string_view)> Say) {
  const Expected<uint32_t> Wanted = parse(Text);
  if (!Wanted)
    return Wanted.error();
  std::unique_ptr<Checkers> C(new Checkers(std::move(Say)));
  for (size_t N = 0; N != std::size(Makers); ++N)
    if (*Wanted >> N & 1)
      C->Each.push_back(Makers[N](C->Found, C->Where));
  return C;
}

std::vector<Observer *> Checkers::observers() {
  std::vector<Observer *> All = {this};
  for (const auto &O : Each)
    All.push_back(O.get());
  return All;
}

uint64_t Checkers::guardBytes() const {
  uint64_t Most = 0;
  for (const auto &C : Each)
    Most = std::max(Most, C->guardBytes());
  return Most;
}

void Checkers::runBegins(const RunStart &R) {
  Where.begin(R);
  Found.useProgram(R.Program);
}

void Checkers::runEnds(const RunResult &) { Found.sayRepeats(); }

namespace {

class CheckTool : public Tool {
public:
  explicit CheckTool(std::unique_ptr<Checkers> ChecksIn)
      : Checks(std::move(ChecksIn)) {}
  std::vector<Observer *> observers() override { return Checks->observers(); }
  uint64_t guardBytes() const override { return Checks->guardBytes(); }
  uint64_t findings() const override { return Checks->findings(); }

private:
  std::unique_ptr<Checkers> Checks;
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &To) {
  auto Checks = Checkers::create(Text, To.Say);
  if (!Checks)
    return Checks.error();
  return std::unique_ptr<Tool>(std::make_unique<CheckTool>(std::move(*Checks)));
}

} // namespace

const ToolKind tools::Check{.Make = make};

} // namespace vorion::isasim
