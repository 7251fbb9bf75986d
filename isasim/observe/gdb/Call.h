/// A call of a guest's function by the debugger (gdb: "print f(1)"). gdb writes
/// the arguments, a return address that is no code, and the pc; one lane then
/// runs alone while the rest of the machine stands still, until it goes to that
/// address. gdb reads the result, and writes the registers and the pc back.
#pragma once

#include "core/State.h"
#include "observe/gdb/Target.h"
#include "vorion/isasim/TrapCause.h"

#include <functional>
#include <vector>

namespace vorion::isasim::gdb {

class Call {
public:
  /// The lane of \p T is to run from \p Entry, and to come back to \p ReturnTo.
  /// \p Written: what the debugger wrote since the machine last ran.
  Call(Target &Lanes, ThreadId T, uint32_t Entry, uint32_t ReturnTo,
       std::vector<RegisterWrite> Written);
  Call(const Call &) = delete;
  Call &operator=(const Call &) = delete;

  /// Whether the debugger has moved \p T, by writing \p Pc, to where it was
  /// before: that ends this call.
  bool endsWith(ThreadId T, uint32_t Pc) const {
    return T == Lane && Pc == PcBefore;
  }
  /// Whether it has moved it to the return address instead of running it there.
  bool returnsWith(ThreadId T, uint32_t Pc) const {
    return T == Lane && Pc == ReturnTo;
  }
  void goBack();

  enum class Pause {
    Returned, ///< at the return address
    Trapped,
    /// At what needs the rest of the machine (a rasterizer), or not allowed to
    /// run any more.
    Stuck,
    Ended, ///< end() was called meanwhile
  };
  /// Runs the lane. \p MustStop is asked now and then; true makes it Stuck.
  Pause run(const std::function<bool()> &MustStop);
  bool isRunning() const { return Running; }
  /// Of what has trapped.
  TrapCause cause() const { return static_cast<TrapCause>(Warp.FaultCause); }

  /// The warp is as it was before the call, but for the registers that the
  /// debugger has written since. With \p UndoWrites those that it wrote for the
  /// call are undone too.
  void end(bool UndoWrites);

private:
  Target &Lanes;
  const ThreadId Lane;
  WarpState &Warp;
  WarpState Saved;
  uint32_t Entry, ReturnTo;
  uint32_t PcBefore = 0; ///< as the lane showed it
  std::vector<RegisterWrite> Written;
  bool Running = false, Over = false, IsBack = false;
};

} // namespace vorion::isasim::gdb
