#include "raster/UnitTables.h"
#include "timing/common/DatapathUnits.h"
#include "vorion/isasim/Timing.h"

#include <fmt/format.h>

namespace vorion::isasim {

/// The groups' descriptions, in the order of the list.
static constexpr std::pair<std::string_view, std::string_view> Groups[] = {
#define GROUP(NAME, MEMBER, WHAT) {#NAME, WHAT},
#include "vorion/isasim/TimingParams.def"
};

std::string timingMarkdown() {
  std::string Text;
  for (const auto &[Group, What] : Groups) {
    // A column for each set of numbers that has a name.
    const unsigned Sets = Group == "core" ? unsigned(CorePreset::Count) : 1;
    Text += fmt::format("\n`timing.{}`: {}\n\n| parameter |", Group, What);
    for (unsigned N = 0; N != Sets; ++N)
      Text +=
          fmt::format(" {} |", Sets == 1 ? "`prototype-on-chip`"
                                         : name(static_cast<CorePreset>(N)));
    Text += " unit | source |\n|---|";
    for (unsigned N = 0; N != Sets; ++N)
      Text += "--:|";
    Text += "---|---|\n";
    for (const TimingParam &P : timingParams()) {
      if (P.Group != Group)
        continue;
      Text += fmt::format("| `{}` |", P.Name);
      for (unsigned N = 0; N != Sets; ++N) {
        TimingConfig C;
        C.Core = numbersOf(static_cast<CorePreset>(N));
        Text += P.WordOf ? fmt::format(" {} |", P.WordOf(C))
                         : fmt::format(" {} |", P.Of(C));
      }
      Text += fmt::format(" {} | {} |\n", P.Unit, P.Source);
    }
  }
  constexpr std::string_view Head =
      "| unit | latency | interval | fp32 multipliers | fp32 adders | product "
      "bits | adder bits | table bits | choice bits | register bits | area, "
      "um^2 | source |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|\n";
  Text += fmt::format("\nUnits of a rasterizer's lane\n\n{}", Head);
  const auto Row = [&Text](const DatapathUnit &U) {
    Text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.0f} "
        "| {} |\n",
        U.Name, U.Latency, U.Interval, U.Multipliers, U.Adders, U.ProductBits,
        U.AdderBits, U.TableBits, U.ChoiceBits, U.RegisterBits, area(U),
        U.Source);
  };
  // A lane as it is, then what can be there instead of its units.
  const auto Lane = datapathUnits({});
  for (const DatapathUnit &U : Lane)
    Row(U);
  const auto Others = [&](raster::LaneUnits Units) {
    for (size_t N = 0; N != Lane.size(); ++N)
      if (datapathUnits(Units)[N].Name != Lane[N].Name)
        Row(datapathUnits(Units)[N]);
  };
  const auto ForFrontEnds = [](bool AreOpaque, auto Use) {
    for (uint8_t N = 1; N != std::size(raster::FrontEnds); ++N)
      if (raster::FrontEnds[N].IsOpaque == AreOpaque)
        Use({.FrontEnd = N});
  };
  ForFrontEnds(false, Others);
  for (uint8_t Exp = 1; Exp != raster::ExpUnitCount; ++Exp)
    Others({.Exp = Exp});
  for (uint8_t Blend = 1; Blend != raster::BlendUnitCount; ++Blend)
    Others({.Blend = Blend});
  Text += fmt::format(
      "\nFront ends of opaque primitives, in place of all but the gather\n\n{}",
      Head);
  ForFrontEnds(true, [&](raster::LaneUnits Units) {
    Row(datapathUnits(Units).front());
  });
  Text += fmt::format(
      "\nUnits of a pair of lanes in the backward mode, beyond two lanes\n\n{}",
      Head);
  for (size_t R = 0; R != std::size(raster::ReciprocalUnits); ++R)
    for (const DatapathUnit &U : backwardUnits(static_cast<unsigned>(R)))
      if (R == 0 || U.Name == raster::ReciprocalUnits[R].Name)
        Row(U);
  const raster::LaneUnits Rays{
      .FrontEnd = raster::frontEndRowOf(raster::VR_PRIMITIVE_RAY)};
  for (const DatapathUnit &U : backwardUnits(0, Rays).subspan(1))
    Row(U);
  return Text;
}

} // namespace vorion::isasim
