/// Checker of integer divisions by zero, whose results OpenCL C leaves open.

#include "core/Isa.h"
#include "core/State.h"
#include "observe/check/Check.h"

#include <bit>

namespace vorion::isasim {

namespace {

class DivisionCheck : public Check {
public:
  explicit DivisionCheck(Reporter Out) : Out(Out) {}

  void fetch(const Step &S) override {
    if (S.Insn.Opcode != Op::RV_DIV && S.Insn.Opcode != Op::RV_DIVU &&
        S.Insn.Opcode != Op::RV_REM && S.Insn.Opcode != Op::RV_REMU)
      return;
    const LaneWords &Divisors = S.State.Registers[XBase + S.Insn.Rs2];
    for (uint32_t Left = S.LaneMask; Left; Left &= Left - 1) {
      const auto Lane = static_cast<unsigned>(std::countr_zero(Left));
      if (Divisors[Lane] == 0)
        Out.add(Culprit::of(S, Lane), "division by zero");
    }
  }

private:
  Reporter Out;
};

} // namespace

std::unique_ptr<Check> makeDivisionCheck(Reporter Out, const Places &) {
  return std::make_unique<DivisionCheck>(Out);
}

} // namespace vorion::isasim
