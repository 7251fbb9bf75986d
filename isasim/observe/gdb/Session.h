/// What goes on between a debugger and a run.
#pragma once

#include "observe/gdb/Call.h"
#include "observe/gdb/Connection.h"
#include "observe/gdb/Target.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion::isasim::gdb {

/// Signals as gdb numbers them (its include/gdb/signals.def).
enum Signal : unsigned {
  SigInt = 2,
  SigIll = 4,
  SigTrap = 5,
  SigSegv = 11,
  SigSys = 12 ///< a call needs the rest of the machine, which stands still
};

/// Tells a debugger of stops, does what it asks for, and knows what it waits
/// for.
class Session final : public Observer {
public:
  Session() = default;
  /// For a debugger that is connected already.
  explicit Session(int Socket) : WasConnected(true), StopNext(true) {
    Peer.adopt(Socket);
  }
  ~Session() override;
  Expected<unsigned> listen(unsigned Port) { return Peer.listen(Port); }

  void runBegins(const RunStart &R) override;
  void fetch(const Step &S) override;
  void commit(const Commit &C) override;
  void trap(const Trap &T) override;
  void runEnds(const RunResult &R) override;

private:
  struct Watchpoint {
    uint32_t Address, Bytes;
    bool Reads, Writes;
    bool operator==(const Watchpoint &) const = default;
  };

  /// Whether a step is not done yet, since its lane does not run on: it waits
  /// for the other side of a branch, or for lanes that stay in a loop.
  bool isSteppedLaneOff(uint32_t Active) const;

  /// \p S is running.
  void stop(WarpState &S, uint32_t Mask, unsigned Reason,
            const std::string &More, ThreadId Cause = 0);

  /// gdb has looked at a breakpoint at \p S for one lane, and goes on without
  /// the user's having seen it, as where a condition does not hold or a
  /// breakpoint is another thread's: the other active lanes stop there, too,
  /// one after the other. Meanwhile those it was done with are behind it in
  /// gdb's eyes, though the warp runs only when it has been offered to all.
  void offerToOthers(const Step &S);

  /// Whether the debugger has just let one lane go over the breakpoint that it
  /// stands at.
  bool stepsOverBreakpoint() const;

  std::string stopReply() const;
  void tellStop(unsigned Reason, const std::string &More);

  /// Answers the debugger until it lets the machine go on. Calls that it makes
  /// run in here, and stops within them come back to here.
  void serve(unsigned Reason, const std::string &More);

  bool movePc(uint32_t Pc);
  void beginCall();
  void runCall();
  void endCall(bool UndoWrites);
  void resume(ThreadId Step);

  /// Whether the debugger has made the current lane return to its stack, which
  /// is how it calls functions: its breakpoint lies there. Where a call that
  /// has ended was made within another one, that one's address is put back.
  bool beginsCall() const;

  /// Whether the debugger has gone.
  bool answer(std::string_view Packet);
  void answerMemory(std::string_view Packet);
  void answerRegister(std::string_view Packet);
  void answerPoint(std::string_view Packet);
  void answerQuery(std::string_view Packet);
  void answerTransfer(std::string_view Packet);
  void answerContinue(std::string_view Packet);
  std::string threadList() const;
  std::string programPath() const;

  void reply(bool Done) { Peer.send(Done ? "OK" : "E01"); }

  Connection Peer;
  Target Lanes;
  std::vector<std::shared_ptr<Call>> Calls; ///< each made while the last stood
  bool CallBegins = false; ///< its first instruction is not a step's end
  /// What the debugger has put into a thread's ra since the machine last ran.
  std::optional<std::pair<ThreadId, uint32_t>> ReturnTo;
  std::optional<uint32_t> CallEntry; ///< what it has put into the pc then
  /// A call has ended, and registers after the pc are still being put back.
  bool RestoresRegisters = false;
  bool WasConnected = false, StopNext = false;
  bool Waiting = false; ///< gdb waits for the machine to stop
  /// gdb shows the last stop: only then it asks which threads there are.
  bool UserLooks = false;
  const WarpState *Stepping = nullptr;
  ThreadId Stepped = 0; ///< whose step it is; 0: any lane's of the warp
  /// The step is over a breakpoint that is lifted for it: it ends behind one
  /// instruction, so that the breakpoint is back for the lanes that run.
  bool StepsOver = false;
  ThreadId Current = 1; ///< of the last stop, or the one that gdb chose
  unsigned StopSignal = SigTrap;
  std::string StopDetail, WatchReason;
  ThreadId WatchThread = 0;             ///< which has touched what is watched
  std::shared_ptr<const Image> Program; ///< that runs
  bool KnowsPrograms = false; ///< gdb wants to be told of other programs
  bool EntersProgram = false; ///< it has not been told of this one
  std::set<uint32_t> Breakpoints;
  std::set<uint32_t> Lifted; ///< breakpoints, since the machine stopped
  std::vector<Watchpoint> Watched;
  unsigned Fetches = 0, ExitStatus = 0;
};

} // namespace vorion::isasim::gdb
