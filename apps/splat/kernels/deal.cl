// Who draws what: jobs are dealt to the rasterizers like cards, forth and back.
// Row r of the deal gives each rasterizer one job, in rising order if r is even,
// else in falling order, and belongs to core r modulo the cores of each socket.
// So the rule knows list lengths and nothing of time.
#pragma once

#include <vorion.h>

typedef struct {
  uint row;
  uint job;
} deal;

static deal job_of_row(uint row) {
  const uint rasterizers = vx_num_sockets();
  const uint own = vx_core_id() / (vx_num_cores() / rasterizers);
  const deal d = {row, row * rasterizers +
                           (row % 2 == 0 ? own : rasterizers - 1 - own)};
  return d;
}

// This core's jobs; one that is not below their number, in the last row, is
// nobody's, and none follow it.
static deal first_job(void) {
  return job_of_row(vx_core_id() % (vx_num_cores() / vx_num_sockets()));
}

static deal next_job(deal d) {
  return job_of_row(d.row + vx_num_cores() / vx_num_sockets());
}
