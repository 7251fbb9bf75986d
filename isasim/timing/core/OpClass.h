/// What the clock knows of an instruction of the program.
#pragma once

#include "core/CodeTable.h"
#include "timing/Latencies.h"
#include "vorion/isasim/Timing.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace vorion::isasim {

std::string_view name(OpClass C);

/// A unit as the clock knows it. Each takes its instructions in order.
enum class Port : uint8_t { Alu, Sfu, Lsu, Fpu, Count };

/// One instruction. Registers are numbered as in WarpState::R.
struct OpInfo {
  OpClass Class = OpClass::Alu;
  Port On = Port::Alu;
  uint8_t Rd = 0; ///< SinkRegister for none
  /// The one behind it where an atomic has a pair, which it reads, too.
  uint8_t HighRd = SinkRegister;
  uint8_t Sources[3]; ///< 0 (x0) for none
  /// Cycles from its beginning until what uses its result can issue. Of loads,
  /// from the memory's answer.
  uint16_t Latency = 1;
  /// Cycles until its unit takes the next.
  uint16_t Interval = 1;
  /// Cycles that it keeps one of the unit's places, 0 for none: an operation in
  /// flight in the FPU, or the divider among the ALUs.
  uint16_t Hold = 0;
  /// Cycles until the warp's next instruction can issue if it is fetched only
  /// then, else 0.
  uint8_t Redirect = 0;
  bool Spawns : 1 = false; ///< vx_wspawn
  /// Whether only its operands and its unit decide when it issues, and nothing
  /// of it is in the trace.
  bool IsPlain : 1 = true;
  /// Whether it keeps its unit for a cycle only.
  bool IsLight : 1 = true;
};
static_assert(sizeof(OpInfo) == 16, "the clock reads one after the other");

/// How often a unit has to begin for all \p Lanes of a warp.
uint32_t passes(Port On, const CoreTiming &Params, unsigned Lanes);

OpClass classOf(uint32_t Word);
/// By number of the instruction in the program, for warps of \p Lanes.
std::vector<OpInfo> describeProgram(const CodeTable &Code,
                                    const CoreTiming &Params, unsigned Lanes);

} // namespace vorion::isasim
