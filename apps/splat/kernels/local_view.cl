// The camera in local memory.
#pragma once

#include "layout.h"

static void take_view(__local splat_view *to,
                      __global const splat_view *camera) {
  __global const uint *words = (__global const uint *)camera;
  for (uint i = get_local_id(0); i < sizeof(splat_view) / sizeof(uint);
       i += get_local_size(0))
    ((__local uint *)to)[i] = words[i];
  barrier(CLK_LOCAL_MEM_FENCE);
}
