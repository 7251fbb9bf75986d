// From (r, g, b, transmittance) to the picture: the background shows through
// what is left, and the fourth channel becomes alpha.

__kernel void resolve(__global const float4 *pixels, __global float4 *picture,
                      uint count, float red, float green, float blue) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const float4 p = pixels[i];
  picture[i] = (float4)(p.x + p.w * red, p.y + p.w * green, p.z + p.w * blue,
                        1.0f - p.w);
}
