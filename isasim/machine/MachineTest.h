/// What the tests of whole machines share: small machines with programs, and
/// what they leave in memory.
#pragma once

#include "testing/ElfBuilder.h"
#include "testing/Instructions.h"
#include "vorion/isasim/Machine.h"

#include <memory>
#include <span>
#include <vector>

namespace vorion::isasim::testing {

/// Two places in global memory that programs use.
inline constexpr uint32_t Counter = VX_GLOBAL_BASE,
                          Slots = VX_GLOBAL_BASE + 0x1000;

inline Config smallConfig() {
  Config C;
  C.GlobalBytes = 1 << 20;
  C.HostThreads = 1;
  return C;
}

inline Config oneCore() {
  Config C = smallConfig();
  C.SocketsPerCluster = C.CoresPerSocket = 1;
  return C;
}

/// A program that turns all 16 lanes on, does \p Body and ends.
inline std::vector<uint32_t> onAllLanes(const std::vector<uint32_t> &Body) {
  std::vector<uint32_t> Words = {lui(5, 0x10000), addi(5, 5, -1),
                                 encode(Op::VX_TMC, {.Rs1 = 5})};
  Words.insert(Words.end(), Body.begin(), Body.end());
  Words.push_back(encode(Op::VX_TMC, {.Rs1 = 0}));
  return Words;
}

inline std::unique_ptr<Machine> machineFor(const Config &C,
                                           const std::vector<uint32_t> &Words) {
  auto M = Machine::create(C);
  EXPECT_TRUE(M) << M.error().What;
  (*M)->load(codeImage(Words));
  return std::move(*M);
}

inline uint32_t wordAt(const Machine &M, uint32_t Address) {
  uint32_t Word = 0;
  EXPECT_TRUE(M.read(Address, std::as_writable_bytes(std::span(&Word, 1))));
  return Word;
}

} // namespace vorion::isasim::testing
