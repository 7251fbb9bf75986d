#include "observe/check/Checkers.h"

#include "observe/NameList.h"
#include "observe/Tool.h"

#include <algorithm>

namespace vorion::isasim {

namespace {

constexpr std::string_view Names[] = {
#define VORION_CHECK(NAME, MAKE) #NAME,
#include "observe/check/Checks.def"
};

/// By the number of their name.
constexpr std::unique_ptr<Check> (*Makers[])(Reporter, const Places &) = {
#define VORION_CHECK(NAME, MAKE) MAKE,
#include "observe/check/Checks.def"
};

} // namespace

Expected<std::unique_ptr<Checkers>>
Checkers::create(std::string_view Text,
                 std::function<void(std::string_view)> Report) {
  const Expected<uint32_t> Wanted = parseNameList("check", Text, Names);
  if (!Wanted)
    return Wanted.error();
  std::unique_ptr<Checkers> C(new Checkers(std::move(Report)));
  for (size_t N = 0; N != std::size(Makers); ++N)
    if (*Wanted >> N & 1)
      C->Checks.push_back(Makers[N](Reporter(C->Reports, Names[N]), C->Where));
  return C;
}

std::vector<Observer *> Checkers::observers() {
  std::vector<Observer *> All = {this};
  for (const auto &O : Checks)
    All.push_back(O.get());
  return All;
}

uint64_t Checkers::guardBytes() const {
  uint64_t Most = 0;
  for (const auto &C : Checks)
    Most = std::max(Most, C->guardBytes());
  return Most;
}

void Checkers::runBegins(const RunStart &R) {
  Where.begin(R);
  Reports.useProgram(R.Program);
}

void Checkers::runEnds(const RunResult &) { Reports.reportRepeats(); }

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
  auto Checks = Checkers::create(Text, To.Report);
  if (!Checks)
    return Checks.error();
  return std::unique_ptr<Tool>(std::make_unique<CheckTool>(std::move(*Checks)));
}

} // namespace

const ToolKind tools::Check{.Make = make, .Names = Names};

} // namespace vorion::isasim
