#include "observe/check/Bounds.h"

#include "core/Isa.h"
#include "raster/Command.h"
#include "vorion/isasim/Machine.h"

#include <bit>
#include <fmt/format.h>

namespace vorion::isasim {

std::string describeAccess(const Step &S, unsigned Lane, const Places &Where) {
  constexpr const char *Names[] = {"load", "store", "atomic"};
  const uint32_t Address = S.Access->Addresses[Lane];
  return fmt::format("{} of {} byte{} at 0x{:08x}, {}", Names[S.Access->What],
                     S.Access->Bytes, S.Access->Bytes == 1 ? "" : "s", Address,
                     Where.describe(Address, S, Lane));
}

void BoundsCheck::runBegins(const RunStart &R) {
  Starts.assign(R.Device.config().cores(), Culprit());
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
      Out.add("bounds", Culprit::of(S, L), describeAccess(S, L, Where));
  }
}

void BoundsCheck::checkRange(const RasterWork &W, const char *What,
                             uint32_t Address, uint64_t Bytes) {
  if (Where.Held.empty() || Bytes == 0 || Where.Held.find(Address, Bytes))
    return;
  Out.add("bounds", Starts[W.Core],
          fmt::format("{} of a tile command, {} bytes at 0x{:08x}, {}", What,
                      Bytes, Address, Where.Held.describe(Address)));
}

void BoundsCheck::rasterCommand(const RasterWork &W) {
  using namespace raster;
  if (!ModePushed.get(W.What.Mode))
    checkRange(W, "index list", W.What.List, uint64_t{W.What.Count} * 4);
  const unsigned Rows = TileShapeHeight.get(W.What.TileShape);
  const unsigned Width = TileShapeWidth.get(W.What.TileShape);
  const uint32_t Pitch = W.What.OutputPitch;
  const bool Back = W.What.isBackward();
  for (unsigned Row = 0; Row < Rows; ++Row) {
    if (!ModeDrain.get(W.What.Mode))
      checkRange(W, "row of output", W.What.Output + Row * Pitch,
                 Width * sizeof(Pixel));
    if (Back || ModeKeepLast.get(W.What.Mode))
      checkRange(W, "row of last contributors", W.What.Last + Row * (Pitch / 4),
                 Width * sizeof(uint32_t));
    if (Back)
      checkRange(W, "row of gradients", W.What.Upstream + Row * Pitch,
                 Width * sizeof(Pixel));
  }
}

void AlignCheck::fetch(const Step &S) {
  if (!S.Access)
    return;
  for (uint32_t Left = S.LaneMask; Left; Left &= Left - 1) {
    const auto L = static_cast<unsigned>(std::countr_zero(Left));
    if (S.Access->Addresses[L] % S.Access->Bytes != 0)
      Out.add("align", Culprit::of(S, L),
              "misaligned " + describeAccess(S, L, Where));
  }
}

std::unique_ptr<Check> makeBoundsCheck(Findings &Out, const Places &Where) {
  return std::make_unique<BoundsCheck>(Out, Where);
}

std::unique_ptr<Check> makeAlignCheck(Findings &Out, const Places &Where) {
  return std::make_unique<AlignCheck>(Out, Where);
}

} // namespace vorion::isasim
