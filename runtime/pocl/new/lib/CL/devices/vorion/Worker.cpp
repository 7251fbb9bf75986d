#include "Worker.h"
#include "CommandOrder.h"
#include "Launch.h"
#include "Messages.h"

#include <csignal>
#include <set>

extern "C" {
#include "common.h"
#include "pocl_util.h"
}

namespace vorion {

namespace {

/// All workers there are. It is never destroyed: who waits for them does so
/// while static objects go.
struct Registry {
  std::mutex Lock;
  std::set<Worker *> Workers;
};
Registry &registry() {
  static auto &Only = *new Registry;
  return Only;
}

} // namespace

Worker::Worker(vx_device *Device, KernelCache &Kernels)
    : Device(Device), Kernels(Kernels), Thread([this] { run(); }) {
  std::lock_guard Guard(registry().Lock);
  registry().Workers.insert(this);
}

Worker::~Worker() {
  {
    std::lock_guard Guard(registry().Lock);
    registry().Workers.erase(this);
  }
  {
    std::lock_guard Guard(Lock);
    Ending = true;
  }
  Changed.notify_all();
  Thread.join();
}

bool Worker::isElsewhere() const { return getpid() != Process; }

/// Nothing would ever execute \p Command. PoCL holds the lock of its event, so
/// another thread says so.
static void failElsewhere(_cl_command_node *Command) {
  static std::once_flag Told;
  std::call_once(Told, [Command] {
    tellFailure(Command->sync.event.event->context, CL_OUT_OF_RESOURCES,
                "this process was forked after the device was opened, and has "
                "none of its threads, expected one that opens it itself");
  });
  std::thread([Command] {
    pocl_update_event_finished(CL_OUT_OF_RESOURCES, "failElsewhere", __LINE__,
                               Command->sync.event.event, "forked");
  }).detach();
}

void Worker::push(_cl_command_node *Command) {
  if (isElsewhere()) {
    failElsewhere(Command);
    return;
  }
  {
    std::lock_guard Guard(Lock);
    Ready.push_back(Command);
  }
  Changed.notify_all();
}

void Worker::finish() {
  std::unique_lock Guard(Lock);
  Changed.wait(Guard, [this] { return Ready.empty() && !Executing; });
}

void Worker::finishAll() {
  std::lock_guard Guard(registry().Lock);
  for (Worker *W : registry().Workers)
    W->finish();
}

void Worker::finishBeforeExit() {
  if (gettid() != getpid())
    return;
  // exit() ends the objects of its own thread before those of all.
  struct Finishing {
    const pid_t Process = getpid();
    ~Finishing() {
      if (getpid() == Process) // a forked one has no workers
        finishAll();
    }
  };
  thread_local const Finishing AtItsEnd;
}

void Worker::run() {
  // What a run writes may meet the limit of a file's size (ulimit -f): an error
  // of the write, whatever the program does with the signal.
  sigset_t Limit;
  sigemptyset(&Limit);
  sigaddset(&Limit, SIGXFSZ);
  pthread_sigmask(SIG_BLOCK, &Limit, nullptr);
  for (;;) {
    std::unique_lock Guard(Lock);
    Changed.wait(Guard, [this] { return Ending || !Ready.empty(); });
    if (Ready.empty())
      return;
    _cl_command_node *Command = Ready.front();
    Ready.pop_front();
    Executing = true;
    Guard.unlock();
    execute(Command);
    Guard.lock();
    Executing = false;
    Changed.notify_all();
  }
}

void Worker::execute(_cl_command_node *Command) {
  cl_event Event = Command->sync.event.event;
  // PoCL's own commands, which bring a buffer to where it is used, only wait:
  // a buffer that a failed command was given is no dependency.
  if (Event->dependency_failed &&
      !(Event->queue->properties & CL_QUEUE_HIDDEN)) {
    pocl_update_event_finished(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST,
                               __func__, __LINE__, Event, "dependent");
    return;
  }
  const CommandScope Scope(Device, Event);
  // PoCL's own way to execute a kernel command cannot fail.
  if (Command->type != CL_COMMAND_NDRANGE_KERNEL) {
    pocl_exec_command(Command);
    return;
  }
  const cl_int Status = runKernel(Device, Kernels, Command);
  pocl_update_event_finished(Status, __func__, __LINE__, Event, "kernel");
}

} // namespace vorion
