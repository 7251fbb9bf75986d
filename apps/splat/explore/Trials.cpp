#include "explore/Trials.h"

#include "io/Hash.h"
#include "io/Inside.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// What differs from the base, as one text.
std::string differenceOf(const Space &S, const Choices &C) {
  return fmt::format("{} {}", settingsOf(S, C),
                     fmt::join(argumentsOf(S, C), " "));
}

const Part &partOf(const ExplorePlan &P, const Task &What) {
  return P.Does.Parts[What.Of];
}

Provenance provenanceOf(const ExplorePlan &P, const Trial &Of) {
  Provenance From = P.From;
  for (const Provenance *More : {&partOf(P, *Of.What).From, &Of.What->From})
    From.insert(More->begin(), More->end());
  From["settings"] = differenceOf(P.Parameters, Of.Machine);
  return From;
}

Trial trialOf(const ExplorePlan &P, const Task &What, const Choices &Machine) {
  const auto Does = static_cast<std::size_t>(partOf(P, What).Does);
  return {seenBy(P.Options[Does], P.Parameters, Machine), &What};
}

/// What a machine does in all, by weight.
struct Total {
  double Weight = 0, Milliseconds = 0, Joules = 0;

  void add(double By, const Json &Measured, Work Does) {
    Weight += By;
    Milliseconds += By * Measured[timeKey(Does)].get<double>();
    Joules += By * Measured["chip_joules"]["value"].get<double>();
  }
  Speed speed() const { return {1e3 * Weight / Milliseconds, Joules / Weight}; }
};

} // namespace

std::string Trial::name(const Space &S) const {
  const bool IsBase = nameOf(S, Machine) == "base";
  return fmt::format("{}@{}",
                     IsBase ? "base"
                            : fnv1a64(differenceOf(S, Machine)).substr(0, 12),
                     What->Name);
}

std::vector<Trial> trialsOf(const ExplorePlan &P, const std::vector<Task> &Of,
                            const std::vector<Choices> &Machines) {
  std::vector<Trial> All;
  std::set<std::string> Names;
  for (const Choices &C : Machines)
    for (const Task &What : Of)
      if (Trial One = trialOf(P, What, C);
          Names.insert(One.name(P.Parameters)).second)
        All.push_back(std::move(One));
  return All;
}

std::vector<StudyPoint> studyPoints(const ExplorePlan &P,
                                    const std::vector<Trial> &Trials) {
  std::vector<StudyPoint> All;
  All.reserve(Trials.size());
  for (const Trial &Of : Trials) {
    StudyPoint &One = All.emplace_back();
    One.Name = Of.name(P.Parameters);
    One.From = provenanceOf(P, Of);
    One.Measure =
        [&P, Of,
         Files = fmt::format("{}/work/{}", P.Folder, asFileName(One.Name))] {
          return measureTask(P.Setup, partOf(P, *Of.What), *Of.What,
                             {nameOf(P.Parameters, Of.Machine),
                              settingsOf(P.Parameters, Of.Machine),
                              argumentsOf(P.Parameters, Of.Machine)},
                             Files);
        };
    One.Describe = described;
  }
  return All;
}

PointStore storeOf(const ExplorePlan &P,
                   std::function<void(std::string_view)> Log) {
  return {P.Folder, isMeasurement, std::move(Log)};
}

Expected<Measured> measured(const ExplorePlan &P, PointStore &Kept,
                            const std::vector<Task> &Of,
                            const Choices &Machine) {
  Measured M;
  M.Machine = Machine;
  std::array<Total, AllWork.size()> All;
  std::vector<Total> ByPart(P.Does.Parts.size());
  for (const Task &What : Of) {
    const Trial One = trialOf(P, What, Machine);
    const auto Found = Kept.get(One.name(P.Parameters), provenanceOf(P, One));
    if (!Found)
      return Found.error();
    M.Tasks.push_back(*Found);
    if (Found->contains("refused")) {
      M.Refused = (*Found)["refused"].get<std::string>();
      continue;
    }
    const Part &In = partOf(P, What);
    for (Total *To :
         {&All[static_cast<std::size_t>(In.Does)], &ByPart[What.Of]})
      To->add(In.Weight, *Found, In.Does);
    M.Is.Area =
        std::max(M.Is.Area, (*Found)["chip_um2"]["value"].get<double>() / 1e6);
  }
  if (!M.Refused.empty())
    return M;
  for (const Work W : AllWork)
    if (P.Does.has(W))
      M.Is.of(W) = All[static_cast<std::size_t>(W)].speed();
  for (std::size_t I = 0; I < ByPart.size(); ++I) {
    const Total &Is = ByPart[I],
                &Kind = All[static_cast<std::size_t>(P.Does.Parts[I].Does)];
    M.Parts.push_back({Is.speed(), Is.Milliseconds / Kind.Milliseconds,
                       Is.Joules / Kind.Joules});
  }
  return M;
}

} // namespace vorion::splat
