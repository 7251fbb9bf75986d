/// The dependences of a device's commands, for its clock
/// (docs/adr/0011-command-processor.md): events of wait lists, the command
/// before in an in-order queue, and what the host has read.
#pragma once

#include "vorion.h"

#include <vorion/runtime.h>

#include <memory>
#include <mutex>
#include <vector>

namespace vorion {

/// Numbers of a command that has been executed: its own, or of what it waited
/// for if it is none of the clock's. Empty before.
using CommandNumbers = std::shared_ptr<std::vector<uint64_t>>;

/// Of an event. Changed by who has the event's lock, and by the worker when
/// nothing else is to be known.
struct CommandWaits {
  CommandNumbers Own = std::make_shared<std::vector<uint64_t>>();
  std::vector<CommandNumbers> After, HostAfter;
};

/// Of a queue. Used by the worker alone.
struct QueueOrder {
  /// What the next command waits for: the last one of an in-order queue, the
  /// last barrier of another.
  CommandNumbers Last;
  /// Of a queue that is not in order: commands since the last barrier.
  std::vector<CommandNumbers> Since;
};

/// Of the program's thread that uses a device.
struct HostOrder {
  std::mutex Lock;
  /// Reads that it has waited for since it last sent something, or before that.
  std::vector<CommandNumbers> Reads;
  bool HasSent = false; ///< a command behind these
};

/// While the worker executes a command: its copies and runs are a command of
/// the clock.
class CommandScope {
public:
  CommandScope(vx_device *Device, cl_event Event);
  ~CommandScope();
  CommandScope(const CommandScope &) = delete;
  CommandScope &operator=(const CommandScope &) = delete;

private:
  void addQueue(cl_event Event);

  vx_device *Device;
  /// The event may be gone at the end. Null if the device has no such clock.
  CommandNumbers Own;
  std::vector<uint64_t> After;
};

/// The program has waited for \p Event. If this has read something for it, what
/// it enqueues from now on depends on that.
void hostWaited(cl_event Event);
/// The program enqueues the command of \p Event.
void hostSends(cl_event Event);

} // namespace vorion
