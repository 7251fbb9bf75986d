#include "observe/Trace.h"

#include "core/Isa.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

std::string result(const Commit &C) {
  std::string Text;
  bool Same = true;
  const uint32_t *First = nullptr;
  for (size_t L = 0; L != C.Result.size(); ++L) {
    if (!(C.LaneMask >> L & 1))
      continue;
    if (!First)
      First = &C.Result[L];
    Same &= C.Result[L] == *First;
    Text += fmt::format(" {:08x}", C.Result[L]);
  }
  if (First && Same)
    Text = fmt::format(" {:08x}", *First);
  return Text.empty() ? Text : " ->" + Text;
}

} // namespace

void Trace::commit(const Commit &C) {
  std::string Text = disassemble(C.Word, C.Pc);
  std::replace(Text.begin(), Text.end(), '\t', ' ');
  const std::string Symbol = Program ? Program->symbolize(C.Pc) : "";
  fmt::print(Out, "{}.{} 0x{:08x} <{}> {:04x} {}{}\n", C.Core, C.Warp, C.Pc,
             Symbol, C.LaneMask, Text, result(C));
}

} // namespace vorion::isasim
