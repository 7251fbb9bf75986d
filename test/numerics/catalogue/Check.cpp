#include "Check.h"

#include "Broken.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace vorion::test {
namespace {

using splat::Path;
constexpr Path Paths[] = {Path::Raster, Path::Simt};

class Checker {
public:
  Checker(const CheckPlan &P, Machine &M, Rows &R, bool Loud)
      : Plan(P), Device(M), Kept(R), Loud(Loud) {}

  /// The case as it stands, then its settings and its broken kernels.
  Expected<Success> all(const HardCase &C);

  CheckCounts Counts;

private:
  Expected<Success> setting(const HardCase &C, Path P, const Setting &S);
  Expected<Success> broken(const HardCase &C, Path P, const BrokenKernel &B);
  Expected<Success> keep(const nlohmann::json &Row);
  /// Whether it is this one's turn, of those that are more than the case
  /// itself.
  bool inShare() { return Turn++ % Plan.OneIn == 0; }
  const Judge &judgeOf(const HardCase &C, const splat::RenderOptions &O);

  const CheckPlan &Plan;
  Machine &Device;
  Rows &Kept;
  bool Loud;
  std::uint32_t Turn = 0;
  /// The last one, with what it is for.
  std::string JudgedFor;
  std::optional<Judge> Last;
};

const Judge &Checker::judgeOf(const HardCase &C,
                              const splat::RenderOptions &O) {
  const std::string Key =
      fmt::format("{} {} {} {} {} {} {} {} {}", C.Name, name(O.Reach),
                  name(O.Convention), O.Antialiased, O.Dilation, O.Cutoff,
                  O.Background[0], O.Background[1], O.Background[2]);
  if (!Last || Key != JudgedFor)
    Last.emplace(C, O);
  JudgedFor = Key;
  return *Last;
}

Expected<Success> Checker::keep(const nlohmann::json &Row) {
  const bool Good = Row["broken"].get<std::string>().empty();
  ++Counts.Checked;
  ++(Good ? Counts.Kept : Counts.Failed);
  if (!Good || Loud)
    fmt::print("{}: {}{}\n", Row["key"].get<std::string>(),
               Good ? "kept" : "BROKEN: " + Row["broken"].get<std::string>(),
               Row.contains("error")
                   ? fmt::format(" (error {:.2g}, fp32's {:.2g}, bound {:.2g}, "
                                 "doubtful {:.2f} %, off by {:.2g})",
                                 Row["error"].get<double>(),
                                 Row["single"].get<double>(),
                                 Row["bound"].get<double>(),
                                 100 * Row["doubtful"].get<double>(),
                                 Row["doubtful_error"].get<double>())
                   : "");
  std::fflush(stdout);
  return Success{};
}

Expected<Success> Checker::setting(const HardCase &C, Path P,
                                   const Setting &S) {
  const std::string Key = C.Name + " " + flagsOf(P, S);
  if (const nlohmann::json *Row = Kept.find(Key))
    return keep(*Row);
  const splat::RenderOptions O = turned(C.Options, P, S);
  const auto R = Device.render(C, O, "");
  Verdict V;
  if (R)
    V = judgeOf(C, O).judge(*R, allowanceOf(S, O), /*OwnOptions=*/S.empty());
  else
    V.Broken = R.error().What;
  const nlohmann::json Row{{"key", Key},
                           {"case", C.Name},
                           {"path", name(P)},
                           {"settings", S.size()},
                           {"error", V.Error},
                           {"single", V.Single},
                           {"bound", V.Bound},
                           {"doubtful", V.Doubtful},
                           {"doubtful_error", V.DoubtfulError},
                           {"broken", V.Broken}};
  if (auto Done = Kept.add(Row); !Done)
    return Done;
  return keep(Row);
}

Expected<Success> Checker::broken(const HardCase &C, Path P,
                                  const BrokenKernel &B) {
  const std::string Key =
      fmt::format("{} {} with {}", C.Name, flagsOf(P, {}), B.Name);
  if (const nlohmann::json *Row = Kept.find(Key))
    return keep(*Row);
  const std::string Folder = Plan.Scratch + "/" + std::string(B.Name);
  if (auto Written = writeKernels(Folder, B); !Written)
    return Written;
  const splat::RenderOptions O = turned(C.Options, P, {});
  const auto R = Device.render(C, O, Folder);
  // A fault of the machine is noticed too; that it does not compile is not.
  std::string Noticed;
  if (R)
    Noticed = judgeOf(C, O).judge(*R, 0, /*OwnOptions=*/true).Broken;
  else if (R.error().Code != ExitCode::InputFile)
    Noticed = R.error().What;
  const nlohmann::json Row{
      {"key", Key},
      {"case", C.Name},
      {"path", name(P)},
      {"kernel", B.Name},
      {"noticed", Noticed},
      {"broken", !Noticed.empty() ? ""
                 : R              ? "not noticed"
                                  : "the broken kernel does not compile"}};
  if (auto Done = Kept.add(Row); !Done)
    return Done;
  return keep(Row);
}

Expected<Success> Checker::all(const HardCase &C) {
  for (const Path P : Paths) {
    if (auto Done = setting(C, P, {}); !Done)
      return Done;
    std::vector<Setting> Settings;
    if (Plan.Alone)
      Settings = eachAlone(P);
    for (std::uint32_t I = 0; I < Plan.Random; ++I)
      Settings.push_back(combination(P, Plan.Seed + I));
    for (const Setting &S : Settings)
      if (!S.empty() && inShare())
        if (auto Done = setting(C, P, S); !Done)
          return Done;
    for (const std::string &Name : C.NoticedIn) {
      const BrokenKernel &B = brokenKernel(Name);
      if (Plan.Broken && (!B.Only || *B.Only == P) && inShare())
        if (auto Done = broken(C, P, B); !Done)
          return Done;
    }
  }
  return Success{};
}

} // namespace

Expected<CheckCounts> check(const CheckPlan &P, bool Loud) {
  auto M = Machine::open();
  if (!M)
    return M.error();
  auto R = Rows::open(P.RowFile);
  if (!R)
    return R.error();
  const std::vector<HardCase> All = catalogue();
  for (const std::string &Name : P.Cases)
    if (std::ranges::find(All, Name, &HardCase::Name) == All.end())
      return Error{"", fmt::format("no case {}, expected one of --list", Name),
                   ExitCode::Usage};
  Checker C(P, *M, *R, Loud);
  for (const HardCase &Case : All)
    if (P.Cases.empty()
            ? P.Long || !Case.Long
            : std::ranges::find(P.Cases, Case.Name) != P.Cases.end())
      if (auto Done = C.all(Case); !Done)
        return Done.error();
  return C.Counts;
}

} // namespace vorion::test
