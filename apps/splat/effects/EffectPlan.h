/// Which effects a picture gets, and in which form.
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
  Compiled, ///< in the program, always done
  Flagged   ///< in the program, done where its bit of `effects` is set
};

std::string_view name(EffectCode C);

struct EffectDecision {
  const Effect *Subject = nullptr;
  Finding Detected;
  EffectCode Code = EffectCode::Absent;
  /// Whether it is done: compiled in, or flagged with its bit set. For an
  /// effect without code: whether it is on.
  bool Done = false;
};

/// What --effects asks for.
struct EffectRequest {
  enum class Mode {
    Auto,  ///< what is needed, and no code of anything else
    All,   ///< everything compiled in
    Flags, ///< everything compiled in behind run-time flags
    List   ///< of those decided by data: these and no others
  };
  Mode Selection = Mode::Auto;
  std::vector<const Effect *> List; ///< for Mode::List
  /// Compiled in if false, left out if true, whatever Selection says; for
  /// measuring.
  const Effect *Toggled = nullptr;
};

std::string_view name(EffectRequest::Mode M);

/// What the text of a request may be or list.
std::vector<std::string> effectChoices();

/// Reads "auto", "all", "flags" or names of effects joined by commas; of an
/// effect that an option decides, the error names the option.
Expected<EffectRequest> parseEffectRequest(const std::string &Text);

/// Compiles the code of \p E into \p P, a structure `Program` of
/// kernel_headers.py that takes it.
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
  /// For scenes that are not known yet: harmonics up to \p ShDegree and all
  /// that data could call for; the rest as \p O has it.
  /// and, of the view, \p F.
  static EffectPlan forAnyScene(int ShDegree, const RenderOptions &O,
                                const ViewFacts &F = {});

  const std::vector<EffectDecision> &decisions() const { return Decisions; }
  const EffectDecision &of(const Effect &E) const;
  bool done(const Effect &E) const { return of(E).Done; }
  bool compiled(const Effect &E) const {
    return of(E).Code != EffectCode::Absent;
  }

  /// The code of the effect with the macro \p Macro; of one by the camera only
  /// where it is on.
  std::optional<EffectSwitch> choiceOf(std::string_view Macro) const;
  /// Makes the choices of effects that \p P takes, a structure `Program` of
  /// kernel_headers.py.
  template <typename Program> void choose(Program &P) const {
    const auto Set = [&](std::string_view Macro, auto &Choice) {
      Choice = choiceOf(Macro);
    };
    if constexpr (requires { P.forEachEffect(Set); })
      P.forEachEffect(Set);
  }
  /// The bits of the effects that are done, which kernels get as `effects`.
  uint32_t flags() const;

  /// Effects that are needed but left out, as a list can ask: the picture
  /// differs.
  std::vector<const Effect *> missing() const;

private:
  std::vector<EffectDecision> Decisions;
};

} // namespace vorion::splat
