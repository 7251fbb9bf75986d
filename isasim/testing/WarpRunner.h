/// Runs instructions on one warp with chosen registers and active lanes.
#pragma once

#include "core/Atomics.h"
#include "core/Core.h"
#include "core/Warps.h"
#include "core/Watch.h"
#include "mem/Memory.h"
#include "testing/ElfBuilder.h"
#include "testing/Encode.h"
#include "vorion/isasim/TrapCause.h"

#include <algorithm>
#include <array>

namespace vorion::isasim::testing {

using Lanes16 = std::array<uint32_t, MaxLanes>;

inline Lanes16 all(uint32_t Value) {
  Lanes16 Lanes;
  Lanes.fill(Value);
  return Lanes;
}
inline Lanes16 laneNumbers() {
  Lanes16 Lanes;
  for (uint32_t L = 0; L != MaxLanes; ++L)
    Lanes[L] = L;
  return Lanes;
}
/// 1 in the lanes of \p Mask, 0 in the others.
inline Lanes16 bitsOf(uint32_t Mask) {
  Lanes16 Lanes;
  for (uint32_t L = 0; L != MaxLanes; ++L)
    Lanes[L] = Mask >> L & 1;
  return Lanes;
}

class WarpRunner {
public:
  WarpRunner(const ExecTable &Table, const std::vector<uint32_t> &Words,
             const Config &ShapeIn = smallShape())
      : Exec(Table), Shape(ShapeIn), Storage(std::move(*Memory::create(Shape))),
        Program(codeImage(Words)), Code(*Program, Exec), Only(Shape, 0) {
    Storage->load(*Program);
    Watcher.prepare(Code, Shape.WarpsPerCore, 1);
    reset();
  }

  /// The core as at the start, with all lanes active; memory stays.
  void reset() {
    Only.reset(Code, VX_IMAGE_BASE, 0, 0, Storage->view(0), &Watcher);
    setMask(&warp(), 0xFFFF);
  }

  static Config smallShape() {
    Config C;
    C.SocketsPerCluster = C.CoresPerSocket = 1;
    C.GlobalBytes = 1 << 20;
    return C;
  }

  WarpState &warp() { return Only.warps()[0]; }
  void setActive(uint32_t Mask) { setMask(&warp(), Mask); }
  void setX(unsigned N, const Lanes16 &V) { set(XBase + N, V); }
  void setF(unsigned N, const Lanes16 &V) { set(FBase + N, V); }
  Lanes16 getX(unsigned N) { return get(XBase + N); }
  Lanes16 getF(unsigned N) { return get(FBase + N); }
  /// Runs until the warp stops: at the end of the code, which is a fetch
  /// fault, unless something comes first.
  void run(uint32_t Quantum = 1000) { Only.runRound(Exec, Quantum); }
  /// The atomic that the warp waits for executes; false if it traps.
  bool completeAtomic() {
    if (!amoNow(&warp(), warp().Next, amoKind(warp().Next)))
      return false;
    Core::complete(warp());
    return true;
  }
  /// Starts again at the first instruction; registers stay.
  void rewind() {
    warp().Next = Code.begin();
    warp().Why = Stop::Ready;
    warp().Fflags = 0;
  }
  bool ranToEnd() {
    return warp().Why == Stop::Trapped && cause() == TrapCause::FetchFault &&
           warp().Next == Code.begin() + Code.count();
  }
  TrapCause cause() { return static_cast<TrapCause>(warp().FaultCause); }
  std::byte *global(uint32_t Address) { return Storage->global(Address, 1); }

  const ExecTable &Exec;
  Config Shape;
  Watch Watcher; ///< of nobody, so that the observed level can run
  std::unique_ptr<Memory> Storage;
  std::shared_ptr<const Image> Program;
  CodeTable Code;
  Core Only;

private:
  void set(unsigned R, const Lanes16 &V) {
    std::copy(V.begin(), V.end(), warp().lanes(R * sizeof(LaneWords)));
  }
  Lanes16 get(unsigned R) {
    Lanes16 V;
    std::copy_n(warp().lanes(R * sizeof(LaneWords)), MaxLanes, V.begin());
    return V;
  }
};

/// Every level that this host runs, and the observed one.
inline std::vector<const ExecTable *> allTables() {
  const ExecLevels L = hostLevels();
  std::vector<const ExecTable *> Tables(L.Tables, L.Tables + L.Count);
  Tables.push_back(&execTable(true));
  return Tables;
}

/// Active lanes that tests try: one at each end, all, all but one, patterns.
inline constexpr uint32_t MaskPatterns[] = {0x0001, 0x8000, 0xFFFF, 0x7FFF,
                                            0x5555, 0x0FF0, 0x9A31};

} // namespace vorion::isasim::testing
