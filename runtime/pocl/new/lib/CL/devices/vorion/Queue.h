/// What the driver keeps for an OpenCL queue.
#pragma once

#include "CommandOrder.h"

#include <pthread.h>

namespace vorion {

struct QueueData {
  pthread_cond_t Finished = PTHREAD_COND_INITIALIZER; ///< with the queue's lock
  QueueOrder Order;
};

inline QueueData &queueData(cl_command_queue Queue) {
  return *static_cast<QueueData *>(Queue->data);
}

} // namespace vorion
