#include "render/EffectCosts.h"

#include "device/ClockedMachine.h"
#include "effects/Registry.h"
#include "render/FrameTime.h"
#include "render/OwnProcess.h"

#include <fmt/format.h>
#include <sstream>

namespace vorion::splat {

namespace {

struct Figures {
  uint64_t Instructions = 0, Cycles = 0;
  std::string On; ///< as EffectCosts has it
};

Figures figuresOf(const RenderResult &R) {
  Figures F;
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
      const auto R = render(L, P, Inputs.Gaussians, View, Inputs.Options,
                            Inputs.KeepPairs);
      if (!R)
        return R.error();
      const Figures F = figuresOf(*R);
      return fmt::format("{} {} {}", F.Instructions, F.Cycles, F.On);
    });
    if (!Text)
      return Text.error();
    Figures F;
    std::istringstream Said(*Text);
    Said >> F.Instructions >> F.Cycles >> std::ws;
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
      "measured: the frame with the effect less the frame without, "
      "each the first of a process; as asked {} warp "
      "instructions{}\n",
      Costs.Instructions,
      Costs.Cycles ? fmt::format(", {} cycles of {}", Costs.Cycles, Costs.On)
                   : "");
  for (const EffectCost &C : Costs.Effects) {
    Text +=
        fmt::format("  {:<17}{:<4}", C.Subject->Name, C.Done ? "on" : "off");
    if (!C.Failure.empty()) {
      Text += fmt::format("not to be told: {}\n", C.Failure);
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

} // namespace vorion::splat
