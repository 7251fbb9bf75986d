#include "Worker.h"
#include "Launch.h"

extern "C" {
#include "common.h"
#include "pocl_util.h"
}

namespace vorion {

Worker::Worker(vx_device *Device, KernelCache &Kernels)
    : Device(Device), Kernels(Kernels), Thread([this] { run(); }) {}

Worker::~Worker() {
  {
    std::lock_guard Guard(Lock);
    Ending = true;
  }
  Changed.notify_one();
  Thread.join();
}

void Worker::push(_cl_command_node *Command) {
  {
    std::lock_guard Guard(Lock);
    Ready.push_back(Command);
  }
  Changed.notify_one();
}

void Worker::run() {
  for (;;) {
    std::unique_lock Guard(Lock);
    Changed.wait(Guard, [this] { return Ending || !Ready.empty(); });
    if (Ready.empty())
      return;
    _cl_command_node *Command = Ready.front();
    Ready.pop_front();
    Guard.unlock();
    execute(Command);
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
  // PoCL's own way to execute a kernel command cannot fail.
  if (Command->type != CL_COMMAND_NDRANGE_KERNEL) {
    pocl_exec_command(Command);
    return;
  }
  const cl_int Status = runKernel(Device, Kernels, Command);
  pocl_update_event_finished(Status, __func__, __LINE__, Event, "kernel");
}

} // namespace vorion
