/// Checker of misaligned accesses, before they trap.

#include "observe/check/Check.h"

#include <bit>

namespace vorion::isasim {

namespace {

class AlignCheck : public Check {
public:
  AlignCheck(Reporter Out, const Places &Where) : Out(Out), Where(Where) {}

  void fetch(const Step &S) override {
    if (!S.Access)
      return;
    for (uint32_t Left = S.LaneMask; Left; Left &= Left - 1) {
      const auto Lane = static_cast<unsigned>(std::countr_zero(Left));
      if (S.Access->Addresses[Lane] % S.Access->Bytes != 0)
        Out.add(Culprit::of(S, Lane),
                "misaligned " + Where.describeAccess(S, Lane));
    }
  }

private:
  Reporter Out;
  const Places &Where;
};

} // namespace

std::unique_ptr<Check> makeAlignCheck(Reporter Out, const Places &Where) {
  return std::make_unique<AlignCheck>(Out, Where);
}

} // namespace vorion::isasim
