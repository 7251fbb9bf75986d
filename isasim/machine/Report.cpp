#include "machine/Report.h"

#include "core/Isa.h"
#include "mem/SourceLines.h"

#include <fmt/format.h>
#include <map>

namespace vorion::isasim {

namespace {

std::string place(uint32_t Pc, const std::string &Symbol) {
  return Symbol.empty() ? fmt::format("0x{:08x}", Pc)
                        : fmt::format("0x{:08x} <{}>", Pc, Symbol);
}

std::string instruction(uint32_t Word, uint32_t Pc) {
  std::string Text = disassemble(Word, Pc);
  for (char &C : Text)
    if (C == '\t')
      C = ' ';
  return Text;
}

/// "  source file.cl:7 in helper\n  called from file.cl:12 in kernel\n".
std::string sourceLines(const std::vector<SourcePlace> &Places) {
  std::string Text;
  for (const SourcePlace &P : Places) {
    Text += Text.empty() ? "  source " : "  called from ";
    Text += P.text();
    Text += P.Function.empty() ? "\n" : " in " + P.Function + "\n";
  }
  return Text;
}

/// The compiler's unimp: csrrw zero, cycle, zero.
constexpr uint32_t Unimp = 0xC0001073;

/// What a user should know of \p T beyond its cause; mostly nothing.
std::string_view explanation(const Trap &T) {
  if (T.Instruction == Unimp)
    return "  unimp: work-items of one group would reach different barriers, "
           "or the program executes a trap\n";
  if (T.Cause == TrapCause::DivergentBranch)
    return "  a branch without vx_split must be uniform across active lanes; "
           "in a kernel, a barrier depends on it\n";
  return "";
}

bool namesAddress(TrapCause Cause) {
  switch (Cause) {
  case TrapCause::FetchFault:
  case TrapCause::MisalignedFetch:
  case TrapCause::LoadFault:
  case TrapCause::StoreFault:
  case TrapCause::MisalignedLoad:
  case TrapCause::MisalignedStore:
  case TrapCause::DivergentJump:
    return true;
  default:
    return false;
  }
}

} // namespace

std::string waitsFor(const WarpState &S) {
  switch (S.Why) {
  case Stop::Ready:
    return "running";
  case Stop::Ended:
    return "ended";
  case Stop::Trapped:
    return "trapped";
  case Stop::Atomic:
    return "at an atomic";
  case Stop::RasterCsr:
    return "waits for the rasterizer";
  case Stop::GlobalBarrier:
    return fmt::format("waits at barrier {} of the device for {} cores",
                       S.BarrierId, S.BarrierCount);
  case Stop::LocalBarrier:
    return fmt::format("waits at barrier {} for {} warps", S.BarrierId,
                       S.BarrierCount);
  }
  return {};
}

Trap makeTrap(const WarpState &S, const std::shared_ptr<const Image> &Program) {
  Trap T;
  T.Cause = static_cast<TrapCause>(S.FaultCause);
  T.Pc = S.pcOf(S.Next);
  T.Core = S.Owner->id();
  T.Warp = S.WarpId;
  T.LaneMask = S.Mask;
  T.Lane = S.FaultLane;
  T.Address = S.FaultAddress;
  T.Instruction = S.Next->Word;
  if (Program) {
    T.Symbol = Program->symbolize(T.Pc);
    T.Source = SourceLines(Program).chain(T.Pc);
  }
  return T;
}

std::string trapReport(const Trap &T) {
  std::string Text = fmt::format("core {}, warp {}, lane {}: {}", T.Core,
                                 T.Warp, T.Lane, describe(T.Cause));
  if (namesAddress(T.Cause))
    Text += fmt::format(" at 0x{:08x}", T.Address);
  Text += fmt::format("\n  pc {}: {}\n", place(T.Pc, T.Symbol),
                      instruction(T.Instruction, T.Pc));
  Text += explanation(T);
  Text += sourceLines(T.Source);
  Text += fmt::format("  active lanes 0x{:04x}\n", T.LaneMask);
  return Text;
}

std::string warpReport(const std::vector<std::unique_ptr<Core>> &Cores,
                       const std::shared_ptr<const Image> &Program) {
  std::optional<SourceLines> Sources;
  if (Program)
    Sources.emplace(Program);
  // Lines without the warp's name, in order of first use, and whose they are.
  std::vector<std::string> Lines;
  std::map<std::string, std::string> Who;
  for (const auto &C : Cores)
    for (const WarpState &S : C->warps()) {
      if (S.Why == Stop::Ended)
        continue;
      const uint32_t Pc = S.pcOf(S.Next);
      std::string Line =
          fmt::format("{}\n    pc {}: {}, active lanes 0x{:04x}", waitsFor(S),
                      place(Pc, Program ? Program->symbolize(Pc) : ""),
                      instruction(S.Next->Word, Pc), S.Mask);
      if (Sources)
        if (const auto Place = Sources->find(Pc))
          Line += ", " + Place->text();
      std::string &Names = Who[Line];
      if (Names.empty())
        Lines.push_back(Line);
      Names +=
          fmt::format("{}{}.{}", Names.empty() ? "" : " ", C->id(), S.WarpId);
    }
  std::string Text;
  for (const std::string &Line : Lines)
    Text += fmt::format("  core.warp {}: {}\n", Who[Line], Line);
  return Text;
}

} // namespace vorion::isasim
