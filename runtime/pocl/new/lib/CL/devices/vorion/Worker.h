/// The thread that executes a device's commands, one after the other in the
/// order in which they became ready. PoCL holds locks while it submits a
/// command, so nothing may execute there.
#pragma once

#include "KernelCache.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <unistd.h>

namespace vorion {

class Worker {
public:
  Worker(vx_device *Device, KernelCache &Kernels);
  /// Executes what was pushed, then ends the thread.
  ~Worker();

  /// \p Command waits for nothing any more; if something that it depends on
  /// has failed, it is not executed and fails, too. So does every command of a
  /// forked process.
  void push(_cl_command_node *Command);

  /// Waits until all commands that are ready have been executed.
  void finish();

  /// Whether this process was forked from the one that has the thread.
  bool isElsewhere() const;

  /// For a thread of the program: if it is the first one, and it ends or calls
  /// exit(), it waits until all workers have executed what they were given.
  /// Only then do static objects go, of which LLVM and the simulator have some.
  static void finishBeforeExit();

private:
  void run();
  void execute(_cl_command_node *Command);
  static void finishAll();

  vx_device *Device;
  KernelCache &Kernels;
  std::mutex Lock;
  std::condition_variable Changed;
  std::deque<_cl_command_node *> Ready;
  bool Executing = false;
  bool Ending = false;
  const pid_t Process = getpid();
  std::thread Thread;
};

} // namespace vorion
