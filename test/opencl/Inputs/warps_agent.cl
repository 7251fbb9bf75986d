// A core has one Raster Agent, so its warps cannot share it.
#include <vorion.h>

kernel void places(global uint *out) {
  vr_wait();
  out[get_global_id(0)] = vx_warp_id() << 8 | vx_core_id();
}
