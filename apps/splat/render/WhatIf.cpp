#include "render/WhatIf.h"

#include "device/ClockedMachine.h"
#include "render/Bottleneck.h"
#include "render/FrameTime.h"
#include "render/OwnProcess.h"
#include "render/Report.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// A setting helps a stage if it saves more than this share of its time, and
/// others are worth a try if it saves less than that one.
constexpr double Least = 0.005, Much = 0.1;

double milliseconds(const Json &Time) {
  return Time["cycles"].get<double>() / (1e3 * Time["clock_mhz"].get<double>());
}

bool isTimed(const Json &Stage) {
  return Stage.contains("time") && Stage.value("of_the_frame", true);
}

/// Of the stage \p Name of \p Frame; empty where it has none.
std::optional<double> stageMilliseconds(const Json &Frame,
                                        const std::string &Name) {
  double Sum = 0;
  bool IsThere = false;
  for (const Json &Stage : Frame["stages"])
    if (isTimed(Stage) && Stage["name"] == Name) {
      Sum += milliseconds(Stage["time"]);
      IsThere = true;
    }
  return IsThere ? std::optional(Sum) : std::nullopt;
}

/// The value of \p Key among a report's changes of its machine.
unsigned changedValue(const Json &Time, const std::string &Key,
                      unsigned Default) {
  for (const Json &Change : Time["machine_changes"])
    if (const auto Text = Change.get<std::string>();
        Text.starts_with(Key + "="))
      return static_cast<unsigned>(std::stoul(Text.substr(Key.size() + 1)));
  return Default;
}

/// Cycles of all \p Unit of \p Time by the cycles of one.
std::size_t channelsOf(const Json &Time) {
  for (const Json &A : Time["activities"])
    if (A["unit"] == "dram channels" && Time["cycles"].get<double>() > 0)
      return static_cast<std::size_t>(
          std::lround(A["count"].get<double>() / Time["cycles"].get<double>()));
  return 1;
}

/// A setting with more of what a stage at \p Of waits for; empty if more of
/// nothing helps.
std::string settingFor(const Bottleneck &Of, const Roof &At, const Json &Time) {
  // Of the bandwidth: more accesses in flight would wait for DRAM.
  constexpr double MostLatency = 0.5;
  const std::size_t Cores = Time["cores"].size();
  if (Of.Helps == "timing.dram.channels" ||
      (Of.Helps == "warps_per_core" && At.Memory > MostLatency))
    return fmt::format("timing.dram.channels={}", 2 * channelsOf(Time));
  if (Of.Helps == "cores")
    return fmt::format("cores={}", 2 * Cores);
  if (Of.Helps == "warps_per_core") {
    constexpr unsigned Most = 32;
    const unsigned Warps = changedValue(Time, "warps_per_core", 1);
    return Warps < Most ? fmt::format("warps_per_core={}", 2 * Warps) : "";
  }
  if (Of.Helps == "rasterizers")
    return fmt::format("cores={},rasterizers={}", Cores,
                       2 * Time["rasterizers"].size());
  if (Of.Helps == "timing.link")
    return "timing.link.to_l2_mbps=0,timing.link.from_l2_mbps=0";
  return "";
}

/// The setting of \p All with which the stage \p Name is fastest.
const WhatIf *fastest(const std::vector<WhatIf> &All, const std::string &Name) {
  const WhatIf *Best = nullptr;
  for (const WhatIf &W : All)
    if (const auto Ms = stageMilliseconds(W.Frame, Name);
        Ms && (!Best || *Ms < *stageMilliseconds(Best->Frame, Name)))
      Best = &W;
  return Best;
}

std::string change(double Before, double After) {
  return Before > 0 ? fmt::format("{:+.1f} %", 100 * (After / Before - 1)) : "";
}

/// What helps the stage \p Name: a setting that was measured, with its time,
/// and
/// \p Try, which was not, if that is not much.
Json helpsOf(const Json &Frame, const std::string &Name, const std::string &Try,
             const std::vector<WhatIf> &All) {
  Json Helps = Json::array();
  const double Before = *stageMilliseconds(Frame, Name);
  double Saved = 0;
  if (const WhatIf *Best = fastest(All, Name)) {
    const double After = *stageMilliseconds(Best->Frame, Name);
    Saved = Before > 0 ? 1 - After / Before : 0;
    if (Saved > Least)
      Helps.push_back({{"set", Best->Settings}, {"ms", After}});
  }
  if (!Try.empty() && Saved < Much &&
      std::ranges::find(All, Try, &WhatIf::Settings) == All.end())
    Helps.push_back({{"set", Try}, {"ms", nullptr}});
  return Helps;
}

/// The same as text; adds what is not measured to \p Missing.
std::string helpText(const Json &Bound, bool AreAnyMeasured,
                     std::set<std::string> &Missing) {
  std::string Text;
  for (const Json &Help : Bound["helps"]) {
    const auto Set = Help["set"].get<std::string>();
    Text += (Text.empty() ? "" : "; ") + printable(Set) + ": ";
    if (Help["ms"].is_null()) {
      Missing.insert(Set);
      Text += "not measured";
    } else {
      const double Before = Bound["ms"], After = Help["ms"];
      Text += fmt::format("{:.3f} to {:.3f} ms, {}, measured", Before, After,
                          change(Before, After));
    }
  }
  if (!Text.empty())
    return Text;
  return AreAnyMeasured ? "no setting that was measured" : "nothing known";
}

std::string whatIfTable(const Json &Frame, const std::vector<WhatIf> &All,
                        const std::string &Hash) {
  const auto Letter = [](std::size_t N) {
    return N < 26 ? std::string(1, static_cast<char>('A' + N))
                  : fmt::format("{}", N + 1);
  };
  std::string Text = fmt::format("\n{:<18}{:>10}", "what if, ms", "as it is");
  for (std::size_t N = 0; N < All.size(); ++N)
    Text += fmt::format("{:>10}{:>10}", Letter(N), "");
  Text += '\n';
  const auto Row = [&](const std::string &Name, const auto &Value) {
    const std::optional<double> Before = Value(Frame);
    Text += fmt::format("{:<18}{:>10.3f}", Name, Before.value_or(0));
    for (const WhatIf &W : All) {
      const std::optional<double> After = Value(W.Frame);
      Text += After ? fmt::format("{:>10.3f}{:>10}", *After,
                                  change(Before.value_or(0), *After))
                    : fmt::format("{:>10}{:>10}", "-", "");
    }
    Text += '\n';
  };
  for (const Json &Bound : boundsJson(Frame, All)) {
    const auto Name = Bound["stage"].get<std::string>();
    Row(Name, [&](const Json &F) { return stageMilliseconds(F, Name); });
  }
  for (const auto &[Name, Key] :
       {std::pair("frame", "frame_ms"), std::pair("frames per second", "fps")})
    Row(Name, [Of = Key](const Json &F) {
      return std::optional(F[Of].get<double>());
    });
  for (std::size_t N = 0; N < All.size(); ++N)
    Text += fmt::format("{}: {}; {}\n", Letter(N), printable(All[N].Settings),
                        All[N].PictureHash == Hash ? "the same picture"
                                                   : "another picture");
  return Text;
}

} // namespace

Expected<std::vector<WhatIf>>
measureWhatIf(const std::vector<std::string> &Settings,
              const std::function<DeviceOpener(const std::string &)> &OpenWith,
              const std::string &KernelFolder, const RenderPlan &Plan,
              const EffectInputs &In, const Camera &C,
              const std::function<void(std::string_view)> &Progress) {
  std::vector<WhatIf> All;
  for (const std::string &Set : Settings) {
    if (Progress)
      Progress(fmt::format("what if {}", printable(Set)));
    const auto Text = inOwnProcess([&]() -> Expected<std::string> {
      const auto D = OpenWith(Set)();
      if (!D)
        return D.error();
      Launcher L(*D, KernelFolder, {});
      const auto R =
          render(L, Plan, In.Gaussians, C, In.Options, /*KeepPairs=*/false);
      if (!R)
        return R.error();
      L.recordBuilds();
      return jsonText(Json{{"frame", frameJson(R->Stages)},
                           {"picture", pictureHash(R->Picture)}});
    });
    if (!Text)
      return Text.error();
    Json Said = ownJson<Json>(*Text);
    if (Said["frame"].is_null())
      return Error{"",
                   fmt::format("--what-if {}: the frame has no time, expected "
                               "a Vorion device with all launches timed",
                               printable(Set)),
                   ExitCode::Usage};
    All.push_back({Set, std::move(Said["frame"]), Said["picture"]});
  }
  return All;
}

Json boundsJson(const Json &Frame, const std::vector<WhatIf> &All) {
  Json Bounds = Json::array();
  std::set<std::string> Seen;
  for (const Json &First : Frame["stages"]) {
    const auto Name = First["name"].get<std::string>();
    if (!isTimed(First) || !Seen.insert(Name).second)
      continue;
    StageTimes Runs;
    for (const Json &Stage : Frame["stages"])
      if (isTimed(Stage) && Stage["name"] == Name)
        Runs.push_back(&Stage["time"]);
    const Bottleneck Most = bottleneckOf(Runs);
    const Roof At = roofOf(Runs, Most);
    Bounds.push_back(
        {{"stage", Name},
         {"ms", *stageMilliseconds(Frame, Name)},
         {"unit", Most.Unit},
         {"reason", Most.Reason},
         {"share", Most.Share},
         {"work_share", At.Work},
         {"memory_share", At.Memory},
         {"helps",
          helpsOf(Frame, Name, settingFor(Most, At, Frame["sum"]), All)}});
  }
  return Bounds;
}

Json whatIfJson(const std::vector<WhatIf> &All, const std::string &Hash) {
  Json List = Json::array();
  for (const WhatIf &W : All)
    List.push_back({{"set", W.Settings},
                    {ClockedMachineKey, clockedMachine(W.Frame["sum"])},
                    {"same_picture", W.PictureHash == Hash},
                    {"time", W.Frame}});
  return List;
}

std::string boundsText(const Json &Frame, const std::vector<WhatIf> &All,
                       const std::string &Hash) {
  if (Frame.is_null())
    return {};
  std::string Text =
      fmt::format("{:<18}{:<32}{}\n", "stage", "bound by", "what helps");
  std::set<std::string> Missing;
  for (const Json &Bound : boundsJson(Frame, All)) {
    const auto Reason = fmt::format(
        "{}: {}, {:.0f} %", Bound["unit"].get<std::string>(),
        Bound["reason"].get<std::string>(), 100 * Bound["share"].get<double>());
    Text += fmt::format("{:<18}{:<32}{}\n", Bound["stage"].get<std::string>(),
                        Reason, helpText(Bound, !All.empty(), Missing));
  }
  if (!Missing.empty() && !Hash.empty()) {
    Text += "to measure:";
    for (const std::string &Set : Missing)
      Text += " --what-if " + Set;
    Text += '\n';
  }
  return Text + (All.empty() ? "" : whatIfTable(Frame, All, Hash)) + '\n';
}

} // namespace vorion::splat
