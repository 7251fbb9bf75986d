/// The effects of a picture, and the form of their code.
#pragma once

#include "device/Program.h"
#include "effects/Effect.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// The code of an effect in the kernels.
enum class EffectCode {
  Absent,   ///< not in the program
  Compiled, ///< in the program, unconditional
  Flagged   ///< in the program, done if its bit of `effects` is set
};

std::string_view name(EffectCode C);

struct EffectDecision {
  const Effect *Subject = nullptr;
  Finding Detected;
  EffectCode Code = EffectCode::Absent;
  /// Whether it is done: compiled in, or flagged with its bit set; for an
  /// effect without code, whether it is on.
  bool Done = false;
};

/// The value of --effects.
struct EffectRequest {
  enum class Mode {
    Auto,  ///< only the needed effects
    All,   ///< all effects compiled in
    Flags, ///< all effects behind run-time flags
    List   ///< of the effects decided by data, only these
  };
  Mode Selection = Mode::Auto;
  std::vector<const Effect *> List; ///< for Mode::List
  /// This effect is inverted: compiled in if it would be absent, and vice
  /// versa; for measurements.
  const Effect *Toggled = nullptr;
};

std::string_view name(EffectRequest::Mode M);

/// The valid words of a request.
std::vector<std::string> effectChoices();

/// Parses "auto", "all", "flags" or a comma-separated list of effects. For an
/// effect that an option decides, the error names the option.
Expected<EffectRequest> parseEffectRequest(const std::string &Text);

/// Selects the code of \p E in \p P, a structure `Program` of kernel_headers.py
/// that has this choice.
template <typename Program> void compile(Program &P, const Effect &E) {
  P.forEachEffect([&](std::string_view Macro, auto &Choice) {
    if (Macro == E.Macro)
      Choice = EffectSwitch::compiled();
  });
}

class EffectPlan {
public:
  EffectPlan() = default;
  EffectPlan(const EffectRequest &R, const EffectInputs &In);
  /// The plan for an unknown scene: harmonics up to \p ShDegree and all effects
  /// that data may need; the others follow from \p O and the view's \p F.
  static EffectPlan forAnyScene(int ShDegree, const RenderOptions &O,
                                const ViewFacts &F = {});

  const std::vector<EffectDecision> &decisions() const { return Decisions; }
  const EffectDecision &of(const Effect &E) const;
  bool done(const Effect &E) const { return of(E).Done; }
  bool compiled(const Effect &E) const {
    return of(E).Code != EffectCode::Absent;
  }

  /// The code of the effect with the macro \p Macro; empty for an effect
  /// decided by the camera that is off.
  std::optional<EffectSwitch> choiceOf(std::string_view Macro) const;
  /// Sets the effect choices of \p P, a structure `Program` of
  /// kernel_headers.py.
  template <typename Program> void choose(Program &P) const {
    const auto Set = [&](std::string_view Macro, auto &Choice) {
      Choice = choiceOf(Macro);
    };
    if constexpr (requires { P.forEachEffect(Set); })
      P.forEachEffect(Set);
  }
  /// The bits of the effects that are done, passed to kernels as `effects`.
  uint32_t flags() const;

  /// Effects that are needed but omitted by a list, which changes the picture.
  std::vector<const Effect *> missing() const;

private:
  std::vector<EffectDecision> Decisions;
};

} // namespace vorion::splat
