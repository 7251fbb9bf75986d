// What colour's way from spherical harmonics (sh.cl) and its way back
// (sh_backward.cl) share: the normalisations of the real spherical harmonics,
// by band and polynomial.
#pragma once

#define SH_C0 0.28209479177387814f
#define SH_C1 0.4886025119029199f
#define SH_C2XY 1.0925484305920792f
#define SH_C2ZZ 0.31539156525252005f
#define SH_C2XX 0.5462742152960396f
#define SH_C3Y 0.5900435899266435f
#define SH_C3XYZ 2.890611442640554f
#define SH_C3XZZ 0.4570457994644658f
#define SH_C3ZZZ 0.3731763325901154f
#define SH_C3ZXX 1.445305721320277f

static float squared_length(float3 v) {
  return v.x * v.x + v.y * v.y + v.z * v.z;
}
