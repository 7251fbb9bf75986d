// Merges the depth parts of a picture, which were blended apart: part k adds
// what the parts before it let through, C = sum T_in(k) C(k) with
// T_in(0) = 1, T_in(k+1) = T_in(k) T(k) (paper, "z-tiling").

__kernel void merge(__global const float4 *parts, __global float4 *pixels,
                    uint count, uint num_parts) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  float4 sum = (float4)(0.0f, 0.0f, 0.0f, 1.0f);
  for (uint k = 0; k < num_parts; ++k) {
    const float4 part = parts[k * count + i];
    sum = (float4)(sum.x + sum.w * part.x, sum.y + sum.w * part.y,
                   sum.z + sum.w * part.z, sum.w * part.w);
  }
  pixels[i] = sum;
}
