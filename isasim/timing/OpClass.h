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

/// One instruction. Registers are numbered as in WarpState::R.
struct OpInfo {
  OpClass Class = OpClass::Alu;
  Unit On = Unit::Alu;
  uint8_t Rd = 0;     ///< SinkRegister for none
  uint8_t Sources[3]; ///< 0 (x0) for none
  uint8_t Latency = 1, Interval = 1;
};

OpClass classOf(uint32_t Word);
/// By number of the instruction in the program.
std::vector<OpInfo> describeProgram(const CodeTable &Code,
                                    const CoreTiming &Params);

} // namespace vorion::isasim
