/// Checker of accesses outside what the work-item may touch.
#include "core/Isa.h"
#include "observe/check/Check.h"
#include "raster/WorkLog.h"
#include "vorion/support/Letters.h"

#include <bit>
#include <fmt/format.h>
#include <vector>

namespace vorion::isasim {

class BoundsCheck : public Check {
public:
  BoundsCheck(Reporter Out, const Places &Where) : Out(Out), Where(Where) {}
  /// What runs over the end of a buffer does not reach the next one.
  uint64_t guardBytes() const override { return 4096; }
  void runBegins(const RunStart &R) override;
  void fetch(const Step &S) override;
  void rasterCommand(const raster::CommandWork &W) override;

private:
  void checkRange(const raster::CommandWork &W, const char *What,
                  uint32_t Address, uint64_t Bytes);

  Reporter Out;
  const Places &Where;
  std::vector<Culprit> Starts; ///< who started a command last, by core
};

void BoundsCheck::runBegins(const RunStart &R) {
  Starts.assign(R.Shape.cores(), Culprit());
}

void BoundsCheck::fetch(const Step &S) {
  if (S.Insn.Csr == static_cast<uint16_t>(raster::Csr::Start))
    Starts[S.Core] =
        Culprit::of(S, static_cast<unsigned>(std::countr_zero(S.LaneMask)));
  if (!S.Access)
    return;
  for (uint32_t Left = S.LaneMask; Left; Left &= Left - 1) {
    const auto L = static_cast<unsigned>(std::countr_zero(Left));
    if (!Where.isOwn(S.Access->Addresses[L], S.Access->Bytes, S, L))
      Out.add(Culprit::of(S, L), Where.describeAccess(S, L));
  }
}

void BoundsCheck::checkRange(const raster::CommandWork &W, const char *What,
                             uint32_t Address, uint64_t Bytes) {
  if (Where.Held.empty() || Bytes == 0 || Where.Held.find(Address, Bytes))
    return;
  Out.add(Starts[W.Core],
          fmt::format("{} of a tile command, {} at 0x{:08x}, {}", What,
                      counted(Bytes, "byte"), Address,
                      Where.Held.describe(Address)));
}

void BoundsCheck::rasterCommand(const raster::CommandWork &W) {
  using namespace raster;
  const Job &J = W.What;
  if (!J.TakesPushed)
    checkRange(W, "index list", J.List, uint64_t{J.Count} * 4);
  if (J.KeepsCounts)
    checkRange(W, "counts", J.Last, CountsBytes);
  for (unsigned Row = 0; Row < J.Height; ++Row) {
    if (J.usesOutput())
      checkRange(W, "row of output", J.Output + Row * J.OutputPitch,
                 J.Width * J.pixelBytes());
    if (J.IsLimited)
      checkRange(W, "row of limits", J.Limit + Row * (J.OutputPitch / 4),
                 J.Width * sizeof(uint32_t));
    if (J.StartsLate)
      checkRange(W, "row of first entries", J.From + Row * (J.OutputPitch / 4),
                 J.Width * sizeof(uint32_t));
    if (J.IsBackward || J.KeepsLast)
      checkRange(W, "row of last contributors",
                 J.Last + Row * (J.OutputPitch / 4),
                 J.Width * sizeof(uint32_t));
    if (J.IsBackward)
      checkRange(W, "row of gradients", J.Upstream + Row * J.OutputPitch,
                 J.Width * sizeof(Pixel));
  }
}

std::unique_ptr<Check> makeBoundsCheck(Reporter Out, const Places &Where) {
  return std::make_unique<BoundsCheck>(Out, Where);
}

} // namespace vorion::isasim
