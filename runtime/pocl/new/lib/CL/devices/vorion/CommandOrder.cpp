#include "CommandOrder.h"
#include "Device.h"
#include "Event.h"
#include "Queue.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace vorion {

namespace {

/// Whether the event is of a device whose clock wants to know.
bool isTimed(cl_event Event) {
  return Event->queue &&
         strcmp(Event->queue->device->ops->device_name, "vorion") == 0 &&
         Event->queue->device->data &&
         deviceOf(Event->queue->device).Info.dma_engines != 0;
}

CommandWaits &waitsOf(cl_event Event) {
  if (!Event->data)
    Event->data = new EventData;
  return eventData(Event)->Waits;
}

/// Whether the command brings data to the program.
bool isRead(cl_command_type Type) {
  switch (Type) {
  case CL_COMMAND_READ_BUFFER:
  case CL_COMMAND_READ_BUFFER_RECT:
  case CL_COMMAND_READ_IMAGE:
  case CL_COMMAND_MAP_BUFFER:
  case CL_COMMAND_MAP_IMAGE:
    return true;
  default:
    return false;
  }
}

void add(std::vector<uint64_t> &To, const CommandNumbers &Numbers) {
  if (Numbers)
    To.insert(To.end(), Numbers->begin(), Numbers->end());
}

bool isInOrder(cl_command_queue Queue) {
  return (Queue->properties & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE) == 0;
}

/// Whether it waits for all commands before it in its queue.
bool isBarrier(cl_event Event) {
  return Event->command_type == CL_COMMAND_BARRIER ||
         Event->command_type == CL_COMMAND_MARKER;
}

} // namespace

CommandScope::CommandScope(vx_device *TheDevice, cl_event Event)
    : Device(TheDevice) {
  if (!isTimed(Event))
    return;
  CommandWaits &Waits = waitsOf(Event);
  Own = Waits.Own;
  for (const CommandNumbers &Numbers : Waits.After)
    add(After, Numbers);
  if (!(Event->queue->properties & CL_QUEUE_HIDDEN))
    addQueue(Event);
  std::ranges::sort(After);
  After.erase(std::unique(After.begin(), After.end()), After.end());
  std::vector<uint64_t> HostAfter;
  for (const CommandNumbers &Numbers : Waits.HostAfter)
    add(HostAfter, Numbers);
  Waits.After.clear();
  Waits.HostAfter.clear();
  vx_command_begin(Device, After.data(), After.size(), HostAfter.data(),
                   HostAfter.size());
}

/// What the command waits for in its queue, and who waits for it.
void CommandScope::addQueue(cl_event Event) {
  QueueOrder &Queue = queueData(Event->queue).Order;
  add(After, Queue.Last);
  if (isInOrder(Event->queue)) {
    Queue.Last = Own;
    return;
  }
  if (isBarrier(Event)) {
    // One with a wait list would wait for that alone: this one waits too long.
    for (const CommandNumbers &Numbers : Queue.Since)
      add(After, Numbers);
    Queue.Since.clear();
  }
  if (Event->command_type == CL_COMMAND_BARRIER)
    Queue.Last = Own;
  else
    Queue.Since.push_back(Own);
}

CommandScope::~CommandScope() {
  if (!Own)
    return;
  uint64_t Number = 0;
  vx_command_end(Device, &Number);
  *Own = Number ? std::vector{Number} : std::move(After);
}

void hostWaited(cl_event Event) {
  if (!isTimed(Event) || !isRead(Event->command_type) || !eventData(Event))
    return;
  HostOrder &Host = deviceOf(Event->queue->device).Host;
  const std::lock_guard Guard(Host.Lock);
  if (std::exchange(Host.HasSent, false))
    Host.Reads.clear();
  Host.Reads.push_back(eventData(Event)->Waits.Own);
}

void hostSends(cl_event Event) {
  if (!isTimed(Event))
    return;
  HostOrder &Host = deviceOf(Event->queue->device).Host;
  const std::lock_guard Guard(Host.Lock);
  waitsOf(Event).HostAfter = Host.Reads;
  Host.HasSent = true;
}

} // namespace vorion

void pocl_vorion_add_dependency(cl_event Waiting, cl_event On) {
  // Numbers are those of one device.
  if (vorion::isTimed(Waiting) && vorion::isTimed(On) && On->data &&
      Waiting->queue->device == On->queue->device)
    vorion::waitsOf(Waiting).After.push_back(vorion::eventData(On)->Waits.Own);
}
