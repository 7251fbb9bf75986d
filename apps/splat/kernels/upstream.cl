// What blending's way back starts from: a pixel's gradient by the colour in
// front of the background, and by the final transmittance, through which the
// background shows and which alpha is 1 minus.

// A mesh is the background where it is, and alpha is 1 there
// (effects/Mesh.cpp).
#pragma vorion choice effect USE_MESH

__kernel void upstream(__global const float *by_render,
                       __global const float *by_alpha,
                       __global float4 *gradients, uint count,
#if USE_MESH
                       __global const float4 *behind,
#endif
                       float red, float green, float blue) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const float r = by_render[3 * i];
  const float g = by_render[3 * i + 1];
  const float b = by_render[3 * i + 2];
  float alpha = by_alpha[i];
#if USE_MESH
  const float4 own = behind[i];
  red = own.x;
  green = own.y;
  blue = own.z;
  alpha *= 1.0f - own.w;
#endif
  gradients[i] = (float4)(r, g, b, (red * r + green * g + blue * b) - alpha);
}
