#include "Check.h"

#include "Broken.h"
#include "Contributors.h"
#include "Oracle.h"
#include "TrainingCase.h"
#include "vorion/support/TemporaryFolder.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace vorion::test {
namespace {

using splat::Path;
constexpr Path Paths[] = {Path::Raster, Path::Simt};

class Checker {
public:
  /// \p Scratch: folder for the broken kernels' sources.
  Checker(const CheckPlan &P, Machine &M, Rows &R, std::string Scratch,
          bool Verbose)
      : Plan(P), Device(M), Kept(R), Scratch(std::move(Scratch)),
        Verbose(Verbose) {}

  /// The case as it stands, then its settings and its broken kernels.
  Expected<Success> all(const HardCase &C);
  Expected<Success> all(const TrainingCase &C);

  CheckCounts Counts;

private:
  Expected<Success> setting(const HardCase &C, Path P, const Setting &S);
  /// What is beside the picture: depths, normals, pixels' contributors.
  Expected<Success> layers(const HardCase &C, Path P);
  Expected<Success> broken(const HardCase &C, Path P, const BrokenKernel &B);
  /// As it stands, or with broken kernels.
  Expected<Success> training(const TrainingCase &C, const Way &W,
                             const BrokenKernel *B);
  /// The row of a check with \p B, of which \p Detected says what it was, or
  /// why it did not run.
  nlohmann::json rowOf(const std::string &Key, const std::string &Case,
                       std::string_view Way, const BrokenKernel &B,
                       const Expected<std::string> &Detected);
  Expected<Success> oracle(const HardCase &C, const Setting &S);
  Expected<Success> keep(const nlohmann::json &Row,
                         const splat::Image *Picture = nullptr);
  Expected<Success> keepNew(const nlohmann::json &Row,
                            const splat::Image *Picture = nullptr);
  /// The row of an earlier run; tells the plan's listener what begins if there
  /// is none.
  const nlohmann::json *find(const std::string &Key);
  /// Whether it is this one's turn, of those that are more than the case
  /// itself.
  bool inShare() { return Turn++ % Plan.OneIn == 0; }
  const Judge &judgeOf(const HardCase &C, const splat::RenderOptions &O);

  const CheckPlan &Plan;
  Machine &Device;
  Rows &Kept;
  std::string Scratch;
  bool Verbose;
  uint32_t Turn = 0;
  /// The last one, with what it is for.
  std::string JudgedKey;
  std::optional<Judge> Last;
};

const Judge &Checker::judgeOf(const HardCase &C,
                              const splat::RenderOptions &O) {
  const std::string Key =
      fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}", C.Name, name(O.Reach),
                  name(O.Convention), O.Antialiased, O.Dilation, O.Cutoff,
                  O.AlphaCutoff, O.DepthBits, O.ShLimit, O.Background[0],
                  O.Background[1], O.Background[2]);
  if (!Last || Key != JudgedKey)
    Last.emplace(C, O);
  JudgedKey = Key;
  return *Last;
}

const nlohmann::json *Checker::find(const std::string &Key) {
  const nlohmann::json *Row = Kept.find(Key);
  if (!Row && Plan.Progress)
    Plan.Progress(Key);
  return Row;
}

Expected<Success> Checker::keep(const nlohmann::json &Row,
                                const splat::Image *Picture) {
  const bool Good = Row["broken"].get<std::string>().empty();
  ++Counts.Checked;
  ++(Good ? Counts.Kept : Counts.Failed);
  std::string Found;
  if (Row.contains("doubtful"))
    Found = fmt::format(
        " (error {:.2g}, fp32's {:.2g}, bound {:.2g}, doubtful {:.2f} %, off "
        "by {:.2g})",
        Row["error"].get<double>(), Row["single"].get<double>(),
        Row["bound"].get<double>(), 100 * Row["doubtful"].get<double>(),
        Row["doubtful_error"].get<double>());
  else if (Row.contains("error"))
    Found = fmt::format(" (error {:.2g}, bound {:.2g})",
                        Row["error"].get<double>(), Row["bound"].get<double>());
  else if (Row.contains("digits"))
    Found =
        fmt::format(" (fp64 has {:.1f} digits, {} of {} pixels decide too "
                    "closely)",
                    Row["digits"].get<double>(), Row["close"].get<uint64_t>(),
                    Row["pixels"].get<uint64_t>());
  else
    Found = fmt::format(" ({})", Row["noticed"].get<std::string>());
  if (Plan.Listener)
    Plan.Listener(Row, Picture);
  if ((!Good && !Plan.Listener) || Verbose)
    fmt::print("{}: {}{}\n", Row["key"].get<std::string>(),
               Good ? "kept" : "BROKEN: " + Row["broken"].get<std::string>(),
               Found);
  std::fflush(stdout);
  return Success{};
}

Expected<Success> Checker::keepNew(const nlohmann::json &Row,
                                   const splat::Image *Picture) {
  if (auto Done = Kept.add(Row); !Done)
    return Done;
  return keep(Row, Picture);
}

/// Of a picture.
nlohmann::json pictureRow(const std::string &Key, const HardCase &C, Path P,
                          std::size_t Settings, const Verdict &V) {
  return {{"key", Key},
          {"case", C.Name},
          {"path", name(P)},
          {"settings", Settings},
          {"error", V.Error},
          {"single", V.Single},
          {"bound", V.Bound},
          {"doubtful", V.Doubtful},
          {"doubtful_error", V.DoubtfulError},
          {"broken", V.Broken}};
}

Expected<Success> Checker::setting(const HardCase &C, Path P,
                                   const Setting &S) {
  const std::string Key = C.Name + " " + flagsOf(P, S);
  if (const nlohmann::json *Row = find(Key))
    return keep(*Row);
  const splat::RenderOptions O = turned(C.Options, P, S);
  const auto R = Device.render(C, O, "");
  Verdict V;
  if (R)
    V = judgeOf(C, O).judge(*R, allowanceOf(S, O, C.Scene.size()),
                            /*OwnOptions=*/S.empty());
  else if (!C.MayExceedMemory || S.empty() ||
           R.error().Code != ExitCode::LimitReached)
    V.Broken = R.error().What;
  return keepNew(pictureRow(Key, C, P, S.size(), V), R ? &R->Picture : nullptr);
}

Expected<Success> Checker::layers(const HardCase &C, Path P) {
  const std::string Key = fmt::format("{} {} layers", C.Name, flagsOf(P, {}));
  if (const nlohmann::json *Row = find(Key))
    return keep(*Row);
  const splat::RenderOptions O = turned(C.Options, P, {});
  const auto Plain = Device.render(C, O, "");
  auto R = Device.render(C, O, "", /*Layers=*/true);
  Verdict V;
  if (!Plain || !R)
    V.Broken = (Plain ? R : Plain).error().What;
  else if (Plain->Picture.Render != R->Picture.Render ||
           Plain->Picture.Alpha != R->Picture.Alpha ||
           R->Depths->Alpha.size() != R->Picture.Alpha.size())
    V.Broken = "a layer changes the picture";
  else {
    for (std::size_t I = 0; I < R->Depths->Depth.size(); ++I) {
      R->Picture.Render[3 * I] = R->Depths->Depth[I];
      R->Picture.Render[3 * I + 1] = R->Picture.Render[3 * I + 2] = 0;
    }
    V = Judge(C, O, Judge::Shown::Depths).judge(*R, 0, /*OwnOptions=*/false);
    if (const Judge Normals(C, O, Judge::Shown::Normals);
        V.Broken.empty() && Normals.isSettled()) {
      R->Picture.Render = R->Normals->Render;
      V.Broken = Normals.judge(*R, 0, /*OwnOptions=*/false).Broken;
      if (!V.Broken.empty())
        V.Broken = "normals: " + V.Broken;
    }
    if (V.Broken.empty() && R->Lists)
      V.Broken = wrongContributors(C, O, *R->Lists);
  }
  return keepNew(pictureRow(Key, C, P, /*Settings=*/1, V));
}

nlohmann::json Checker::rowOf(const std::string &Key, const std::string &Case,
                              std::string_view Way, const BrokenKernel &B,
                              const Expected<std::string> &Detected) {
  // A fault of the machine is noticed too; that it does not compile is not.
  std::string What;
  if (Detected)
    What = *Detected;
  else if (Detected.error().Code != ExitCode::InputFile)
    What = Detected.error().What;
  return {{"key", Key},
          {"case", Case},
          {"path", Way},
          {"kernel", B.Name},
          {"noticed", What},
          {"broken", !What.empty() ? ""
                     : Detected    ? "not noticed"
                                   : "the broken kernel does not compile"}};
}

Expected<Success> Checker::broken(const HardCase &C, Path P,
                                  const BrokenKernel &B) {
  const std::string Key =
      fmt::format("{} {} with {}", C.Name, flagsOf(P, {}), B.Name);
  if (const nlohmann::json *Row = find(Key))
    return keep(*Row);
  const std::string Folder = Scratch + "/" + std::string(B.Name);
  if (auto Written = writeKernels(Folder, B); !Written)
    return Written;
  const splat::RenderOptions O = turned(C.Options, P, {});
  const auto R = Device.render(C, O, Folder);
  return keepNew(
      rowOf(Key, C.Name, name(P), B,
            R ? Expected<std::string>(
                    judgeOf(C, O).judge(*R, 0, /*OwnOptions=*/true).Broken)
              : R.error()),
      R ? &R->Picture : nullptr);
}

Expected<Success> Checker::oracle(const HardCase &C, const Setting &S) {
  const std::string Key =
      fmt::format("{} {} oracle", C.Name, flagsOf(Path::Raster, S));
  if (const nlohmann::json *Row = find(Key))
    return keep(*Row);
  const splat::RenderOptions O = turned(C.Options, Path::Raster, S);
  OracleVerdict V = compareWithOracle(C, O, Plan.Oracle);
  if (V.Broken.empty() && !(V.digits() >= C.ExactDigits))
    V.Broken = fmt::format("fp64 has {:.1f} digits, expected {}", V.digits(),
                           C.ExactDigits);
  const nlohmann::json Row{{"key", Key},         {"case", C.Name},
                           {"oracle", S.size()}, {"digits", V.digits()},
                           {"pixels", V.Pixels}, {"close", V.Close},
                           {"broken", V.Broken}};
  return keepNew(Row);
}

Expected<Success> Checker::all(const HardCase &C) {
  // Of lenses and shutters it has no formulas.
  if (Plan.Oracle != 0 && C.Options.Optics->isPinhole() && !C.Options.Rolling &&
      C.Options.Through == splat::Spread::Jacobian && !C.Options.Near) {
    // Without dilation a footprint is all that its determinant is.
    const auto Sharp = std::ranges::find(knobs(), "--dilation 0", &Knob::Flags);
    for (const Setting &S : {Setting{}, Setting{&*Sharp}})
      if (auto Done = oracle(C, S); !Done)
        return Done;
  }
  for (const Path P : Paths) {
    if (auto Done = setting(C, P, {}); !Done)
      return Done;
    if (auto Done = layers(C, P); !Done)
      return Done;
    std::vector<Setting> Settings;
    if (Plan.Alone)
      Settings = eachAlone(P);
    for (uint32_t I = 0; I < Plan.Random; ++I)
      Settings.push_back(combination(P, Plan.Seed + I));
    for (const Setting &S : Settings)
      if (!S.empty() && inShare())
        if (auto Done = setting(C, P, S); !Done)
          return Done;
    for (const std::string &Name : C.FoundIn) {
      const BrokenKernel &B = brokenKernel(Name);
      if (Plan.Broken && (!B.Only || *B.Only == P) && inShare())
        if (auto Done = broken(C, P, B); !Done)
          return Done;
    }
  }
  return Success{};
}

Expected<Success> Checker::training(const TrainingCase &C, const Way &W,
                                    const BrokenKernel *B) {
  std::string Flags = C.Blends ? " " + flagsOf(W.Blending, {}) : "";
  if (W.Sums != splat::SimtSums::Ordered)
    Flags += fmt::format(" --simt-sums {}", name(W.Sums));
  const std::string Key =
      C.Name + Flags + (B ? fmt::format(" with {}", B->Name) : "");
  if (const nlohmann::json *Row = find(Key))
    return keep(*Row);
  const std::string Folder = B ? Scratch + "/" + std::string(B->Name) : "";
  if (B)
    if (auto Written = writeKernels(Folder, *B); !Written)
      return Written;
  splat::Launcher L = Device.launcher(Folder);
  const auto F = C.Run(L, W);
  nlohmann::json Row;
  if (B)
    Row = rowOf(Key, C.Name, name(W), *B,
                F ? Expected<std::string>(F->Broken) : F.error());
  else
    Row = {{"key", Key},
           {"case", C.Name},
           {"path", name(W)},
           {"settings", 0},
           {"error", F ? F->Error : 0},
           {"bound", F ? F->Bound : 0},
           {"broken", F ? F->Broken : F.error().What}};
  return keepNew(Row);
}

Expected<Success> Checker::all(const TrainingCase &C) {
  for (const Way &W : waysOf(C)) {
    if (auto Done = training(C, W, nullptr); !Done)
      return Done;
    for (const std::string &Name : C.FoundIn) {
      const BrokenKernel &B = brokenKernel(Name);
      if (Plan.Broken && (!B.Only || *B.Only == W.Blending) &&
          (B.Sums.empty() ||
           std::ranges::find(B.Sums, W.Sums) != B.Sums.end()) &&
          inShare())
        if (auto Done = training(C, W, &B); !Done)
          return Done;
    }
  }
  return Success{};
}

} // namespace

Expected<CheckCounts> check(const CheckPlan &P, bool Verbose) {
  auto M = Machine::open(P.Machine);
  if (!M)
    return M.error();
  auto R = Rows::open(P.RowFile);
  if (!R)
    return R.error();
  const std::vector<HardCase> Pictures = catalogue();
  const std::vector<TrainingCase> Training = trainingCases();
  for (const std::string &Name : P.Cases)
    if (std::ranges::find(Pictures, Name, &HardCase::Name) == Pictures.end() &&
        std::ranges::find(Training, Name, &TrainingCase::Name) ==
            Training.end())
      return Error{"", fmt::format("no case {}, expected one of --list", Name),
                   ExitCode::Usage};
  const auto Named = [&](const std::string &Name) {
    return std::ranges::find(P.Cases, Name) != P.Cases.end();
  };
  std::optional<TemporaryFolder> Temporary;
  if (P.Broken && P.Scratch.empty()) {
    auto Made = TemporaryFolder::make("splat-hard-cases");
    if (!Made)
      return Made.error();
    Temporary.emplace(std::move(*Made));
  }
  Checker C(P, *M, *R, Temporary ? Temporary->path() : P.Scratch, Verbose);
  for (const HardCase &Case : Pictures)
    if (P.Cases.empty() ? P.Long || !Case.Long : Named(Case.Name))
      if (auto Done = C.all(Case); !Done)
        return Done.error();
  for (const TrainingCase &Case : Training)
    if (P.Cases.empty() || Named(Case.Name))
      if (auto Done = C.all(Case); !Done)
        return Done.error();
  return C.Counts;
}

} // namespace vorion::test
