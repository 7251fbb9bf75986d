// How the cores' way back adds up what 16 work-items have.
#pragma once

#define LANES 16

// As a tree, halves onto halves.
static float sum_of_lanes(__local const float *p) {
  const float c0 = (p[0] + p[8]) + (p[4] + p[12]);
  const float c1 = (p[1] + p[9]) + (p[5] + p[13]);
  const float c2 = (p[2] + p[10]) + (p[6] + p[14]);
  const float c3 = (p[3] + p[11]) + (p[7] + p[15]);
  return (c0 + c2) + (c1 + c3);
}
