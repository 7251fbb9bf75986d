#include "render/EffectCosts.h"

#include "device/ClockedMachine.h"
#include "effects/Registry.h"
#include "render/FrameTime.h"
#include "render/OwnProcess.h"
#include "render/Report.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

namespace vorion::splat {

namespace {

struct Figures {
  uint64_t Instructions = 0, Cycles = 0;
  double Seconds = 0; ///< of the host's processors
  std::string Hash;   ///< of the picture
  std::string On;     ///< as EffectCosts has it
};

/// Of this process so far, by all its threads.
double processorSeconds() {
  timespec Spent{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &Spent);
  return double(Spent.tv_sec) + 1e-9 * double(Spent.tv_nsec);
}

Figures figuresOf(const RenderResult &R) {
  Figures F;
  F.Hash = pictureHash(R.Picture);
  for (const StageReport &S : R.Stages)
    for (const KernelReport &K : S.Kernels)
      if (K.Counters)
        F.Instructions += K.Counters->WarpInstructions;
  if (const auto Time = frameTime(R.Stages)) {
    F.Cycles = Time->Cycles;
    F.On = clockedMachine(*Time);
  }
  return F;
}

class Measurer {
public:
  Measurer(const DeviceOpener &Opener, const std::string &Folder,
           const EffectInputs &Inputs, const Camera &View)
      : Open(Opener), KernelFolder(Folder), Inputs(Inputs), View(View) {}

  RenderPlan plan(const EffectRequest &R) const {
    return planRender(EffectPlan(R, Inputs), Inputs.Options);
  }

  /// Of the frame by \p P, the first of a process: caches that a frame before
  /// left full of its picture have made the next one 15 % slower.
  Expected<Figures> measure(const RenderPlan &P) const {
    const auto Text = inOwnProcess([&]() -> Expected<std::string> {
      const auto D = Open();
      if (!D)
        return D.error();
      Launcher L(*D, KernelFolder, {});
      const double Begin = processorSeconds();
      const auto R = render(L, P, Inputs.Gaussians, View, Inputs.Options,
                            Inputs.KeepPairs);
      if (!R)
        return R.error();
      const double Seconds = processorSeconds() - Begin;
      L.recordBuilds();
      const Figures F = figuresOf(*R);
      return fmt::format("{} {} {} {} {}", F.Instructions, F.Cycles, Seconds,
                         F.Hash, F.On);
    });
    if (!Text)
      return Text.error();
    Figures F;
    std::istringstream Said(*Text);
    Said >> F.Instructions >> F.Cycles >> F.Seconds >> F.Hash >> std::ws;
    std::getline(Said, F.On);
    return F;
  }

private:
  const DeviceOpener &Open;
  const std::string &KernelFolder;
  const EffectInputs &Inputs;
  const Camera &View;
};

bool samePrograms(const RenderPlan &A, const RenderPlan &B) {
  return A.Programs == B.Programs && A.Effects.flags() == B.Effects.flags();
}

int64_t difference(uint64_t A, uint64_t B) {
  return static_cast<int64_t>(A) - static_cast<int64_t>(B);
}

EffectCost costOf(const Effect &E, bool Done, const Figures &Asked,
                  const Figures &Switched) {
  const Figures &With = Done ? Asked : Switched;
  const Figures &Without = Done ? Switched : Asked;
  return {&E,
          Done,
          difference(With.Instructions, Without.Instructions),
          difference(With.Cycles, Without.Cycles),
          {}};
}

EffectRequest requestOf(EffectRequest::Mode M) {
  EffectRequest R;
  R.Selection = M;
  return R;
}

double percent(double Part, double Whole) {
  return Whole > 0 ? 100 * Part / Whole : 0;
}

} // namespace

Expected<EffectCosts>
measureEffects(const DeviceOpener &Open, const std::string &KernelFolder,
               const EffectRequest &Request, const EffectInputs &In,
               const Camera &C,
               const std::function<void(std::string_view)> &Progress) {
  const Measurer M(Open, KernelFolder, In, C);
  const auto Tell = [&](std::string_view What) {
    if (Progress)
      Progress(fmt::format("measuring {}", What));
  };
  Tell("the frame");
  const RenderPlan Asked = M.plan(Request);
  const auto Frame = M.measure(Asked);
  if (!Frame)
    return Frame.error();
  EffectCosts Costs{Frame->Instructions, Frame->Cycles, Frame->On, {}};
  for (const Effect *E : effects::all()) {
    if (E->Macro.empty())
      continue;
    EffectRequest Switched = Request;
    Switched.Toggled = E;
    const RenderPlan Plan = M.plan(Switched);
    if (samePrograms(Plan, Asked))
      continue;
    Tell(E->Name);
    const bool Done = Asked.Effects.done(*E);
    // Without what it needs, a frame may end in an error: that is no failure of
    // what was asked for.
    const auto Other = M.measure(Plan);
    if (Other)
      Costs.Effects.push_back(costOf(*E, Done, *Frame, *Other));
    else
      Costs.Effects.push_back({E, Done, 0, 0, Other.error().What});
  }
  return Costs;
}

std::string toString(const EffectCosts &Costs) {
  std::string Text = fmt::format(
      "measured: the frame with the effect minus the frame without it, each "
      "the first frame of a process; as requested {} warp instructions{}\n",
      Costs.Instructions,
      Costs.Cycles ? fmt::format(", {} cycles of {}", Costs.Cycles, Costs.On)
                   : "");
  for (const EffectCost &C : Costs.Effects) {
    Text +=
        fmt::format("  {:<17}{:<4}", C.Subject->Name, C.Done ? "on" : "off");
    if (!C.Failure.empty()) {
      Text += fmt::format("unknown: {}\n", C.Failure);
      continue;
    }
    Text += fmt::format("{} {:+} warp instructions ({:+.2f} %)",
                        C.Done ? "costs" : "saved", C.Instructions,
                        percent(static_cast<double>(C.Instructions),
                                static_cast<double>(Costs.Instructions)));
    if (Costs.Cycles)
      Text += fmt::format(", {:+} cycles ({:+.2f} %)", C.Cycles,
                          percent(static_cast<double>(C.Cycles),
                                  static_cast<double>(Costs.Cycles)));
    Text += '\n';
  }
  return Text;
}

Expected<std::vector<ModeCost>>
measureModes(const DeviceOpener &Clocked, const DeviceOpener &Plain,
             const std::string &KernelFolder, const EffectInputs &In,
             const Camera &C, unsigned Runs,
             const std::function<void(std::string_view)> &Progress) {
  using Mode = EffectRequest::Mode;
  constexpr std::array Modes{Mode::Auto, Mode::Flags, Mode::All};
  const Measurer Timed(Clocked, KernelFolder, In, C);
  const Measurer Quick(Plain, KernelFolder, In, C);
  const auto Tell = [&](std::string_view What, Mode M) {
    if (Progress)
      Progress(fmt::format("{} {}", What, name(M)));
  };
  std::vector<ModeCost> Costs;
  for (const Mode M : Modes) {
    Tell("the clock with", M);
    const auto F = Timed.measure(Timed.plan(requestOf(M)));
    if (!F)
      return F.error();
    if (F->Cycles == 0)
      return Error{"",
                   "the frame has no modelled time, expected a Vorion device "
                   "with timing on for all launches",
                   ExitCode::Usage};
    Costs.push_back({M, F->Instructions, F->Cycles, F->On, F->Hash, {}});
  }
  for (unsigned Run = 0; Run < Runs; ++Run)
    for (ModeCost &Cost : Costs) {
      Tell("the host's time with", Cost.Selection);
      const auto F = Quick.measure(Quick.plan(requestOf(Cost.Selection)));
      if (!F)
        return F.error();
      Cost.Seconds.push_back(F->Seconds);
    }
  for (ModeCost &Cost : Costs)
    std::ranges::sort(Cost.Seconds);
  return Costs;
}

std::string verdictOf(const std::vector<ModeCost> &Modes) {
  const ModeCost &Least =
      *std::ranges::min_element(Modes, {}, &ModeCost::Cycles);
  std::vector<std::string> Others;
  for (const ModeCost &M : Modes)
    if (&M != &Least)
      Others.push_back(
          fmt::format("{} {:.1f} % more", name(M.Selection),
                      percent(static_cast<double>(M.Cycles - Least.Cycles),
                              static_cast<double>(Least.Cycles))));
  const bool Same = std::ranges::all_of(
      Modes, [&](const ModeCost &M) { return M.Hash == Modes.front().Hash; });
  return fmt::format("{} takes the fewest cycles, {}: {}; the pictures {}",
                     name(Least.Selection), Least.Cycles,
                     fmt::join(Others, ", "),
                     Same ? "have the same bits" : "differ");
}

} // namespace vorion::splat
