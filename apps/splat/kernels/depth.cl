// Where depths are asked for (effects/Depth.cpp): the lists are blended once
// more with depths for colours, so that the first channel of a pixel is the sum of
// its weights times depths, and nothing that draws the picture knows of it.

#include "layout.h"
#include "record.h"

// `depths`: the keys that project wrote. What no tile sees has no record.
__kernel void depths_for_colors(__global const uint *depths,
                                __global splat_record *records, uint count) {
  const uint i = get_global_id(0);
  if (i >= count || depths[i] >= CULLED)
    return;
  records[i].color[0] = as_float(depths[i]);
  records[i].color[1] = 0.0f;
  records[i].color[2] = 0.0f;
}
