#include "observe/check/Findings.h"

#include "core/Isa.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

/// Places in the program that are reported; what comes after is counted only.
constexpr size_t MostPlaces = 50;

} // namespace

void Findings::useProgram(std::shared_ptr<const Image> ProgramIn) {
  if (Program == ProgramIn)
    return;
  Program = std::move(ProgramIn);
  Source = std::make_unique<SourceLines>(Program);
}

void Findings::add(std::string_view Check, const Culprit &C,
                   const std::string &What, uint32_t Other) {
  ++Total;
  const Key K{std::string(Check), Program.get(), C.Pc, Other};
  if (Counts[K]++ != 0 || Counts.size() > MostPlaces)
    return;
  ++Reported;
  std::string Text = disassemble(C.Word, C.Pc);
  std::replace(Text.begin(), Text.end(), '\t', ' ');
  Report(
      fmt::format("check: {}: {}: {}\n  core {}, warp {}, lane {}, pc 0x{:08x} "
                  "<{}>: {}",
                  Check, place(C.Pc), What, C.Core, C.Warp, C.Lane, C.Pc,
                  Program->symbolize(C.Pc), Text));
}

void Findings::reportRepeats() {
  if (Total != Reported)
    Report(fmt::format(
        "check: {} at {}; each location is reported once, {} at most",
        counted(Total, "finding"), counted(Counts.size(), "place"),
        MostPlaces));
  Reported = Total;
}

} // namespace vorion::isasim
