#include "observe/check/Checkers.h"

#include "observe/check/Barriers.h"
#include "observe/check/Bounds.h"
#include "observe/check/Races.h"
#include "observe/check/Uninit.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

enum Check : unsigned {
#define VORION_CHECK(NAME, DOC) NAME,
#include "observe/check/Checks.def"
#undef VORION_CHECK
  NumChecks
};

constexpr std::string_view Names[] = {
#define VORION_CHECK(NAME, DOC) #NAME,
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
      Wanted = (1U << NumChecks) - 1;
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

Checkers::~Checkers() = default;

Expected<std::unique_ptr<Checkers>>
Checkers::create(std::string_view Text,
                 std::function<void(std::string_view)> Say) {
  const Expected<uint32_t> Wanted = parse(Text);
  if (!Wanted)
    return Wanted.error();
  std::unique_ptr<Checkers> C(new Checkers(std::move(Say)));
  const auto Wants = [&](Check Which) { return *Wanted >> Which & 1; };
  C->GuardsWanted = Wants(bounds);
  if (Wants(bounds))
    C->Each.push_back(std::make_unique<BoundsCheck>(C->Found, C->Where));
  if (Wants(align))
    C->Each.push_back(std::make_unique<AlignCheck>(C->Found, C->Where));
  if (Wants(uninit)) {
    auto Own = std::make_unique<UninitCheck>(C->Found, C->Where);
    C->Uninit = Own.get();
    C->Each.push_back(std::move(Own));
  }
  if (Wants(race))
    C->Each.push_back(std::make_unique<RaceCheck>(C->Found, C->Where));
  if (Wants(barrier))
    C->Each.push_back(std::make_unique<BarrierCheck>(C->Found));
  return C;
}

std::vector<Observer *> Checkers::observers() {
  std::vector<Observer *> All = {this};
  for (const auto &O : Each)
    All.push_back(O.get());
  return All;
}

void Checkers::allocated(uint32_t Address, uint64_t Bytes, std::string Name) {
  Where.Held.add(Address, Bytes, std::move(Name));
  if (Uninit)
    Uninit->allocated(Address, Bytes);
}

void Checkers::written(uint32_t Address, uint64_t Bytes) {
  if (Uninit)
    Uninit->written(Address, Bytes);
}

void Checkers::runBegins(const RunStart &R) {
  Where.begin(R);
  Found.useProgram(R.Program);
}

void Checkers::runEnds(const RunResult &) { Found.sayRepeats(); }

} // namespace vorion::isasim
