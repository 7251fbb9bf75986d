// What Spirv_test.cpp runs twice: compiled from here, and from SPIR-V that
// another compiler made of it. All kernels take the same arguments.

#define ITEM                                                                   \
  const uint i = get_global_id(0);                                             \
  const uint l = get_local_id(0);                                              \
  const float x = (int)in[i] * 0.01f - 3.0f

typedef struct {
  char tag;
  long wide;
  float3 point;
  short few[3];
} Record;

constant int table[4] = {3, 1, 4, 1};

__attribute__((noinline)) float4 scale(float4 v, char4 by, float2 offset) {
  return v * convert_float4(by) + (float4)(offset, offset.yx);
}

kernel void vectors(global uint *out, global const uint *in, local uint *t) {
  ITEM;
  float4 v = scale((float4)(x, -x, 2 * x, 1), (char4)(1, 2, 3, (char)i),
                   (float2)(x, 1));
  v = clamp(v, -3.0f, 7.0f) + min(v, v.wzyx) + step(0.5f, v) + mix(v, v.xxyy, x);
  out[i] = as_uint(dot(v, v)) ^ as_uint(length(v)) ^ as_uint(distance(v.xy, v.zw)) ^
           as_uint(cross(v.xyz, v.yzx).y);
}

kernel void memory(global uint *out, global const uint *in, local uint *t) {
  ITEM;
  Record r = {(char)i, (long)i << 33, {x, 2, 3}, {(short)i, 5, table[i & 3]}};
  Record copy[2] = {r, r};
  copy[i & 1].few[i % 3] += 9;
  char3 c = vload3(i & 3, (global const char *)in);
  ushort8 h = vload8(i & 3, (global const ushort *)in);
  float f = vload_half(i, (global const half *)in);
  uint4 part;
  vstore4(vload4(i & 3, in) + (uint4)(1, 2, 3, 4), 0, (uint *)&part);
  out[i] = copy[0].few[i % 3] + (uint)(copy[1].wide >> 30) + copy[0].tag + c.z + h.s7 + (isnan(f) ? 1 : 2) +
           as_uint(copy[1].point.x) + part.w;
}

kernel void integers(global uint *out, global const uint *in, local uint *t) {
  ITEM;
  const uint a = in[i];
  const long w = (long)a * (long)i - 5000000000L;
  const char16 many = (char16)((char)a);
  out[i] = mul_hi(a, 77u) + mad_sat((short)a, (short)i, (short)3) + rotate(a, i & 31) + clz(a) + popcount(a) +
           abs_diff((int)a, 7) + hadd(a, i) + rhadd((uchar)a, (uchar)i) + add_sat((char)a, (char)i) +
           sub_sat((ushort)i, (ushort)a) + upsample((ushort)a, (ushort)i) + mad24((int)i, 5, 6) + mul24(i, 3u) +
           (uint)(w / 7 + w % 13) + (uint)(mul_hi(w, w) >> 3) + bitselect(a, i, 0xff00u) +
           select(a, i, (uint)(x > 0)) + convert_uchar_sat(x * 100) + convert_int_rtp(x) +
           convert_char16_sat(convert_short16(many) * (short)3).sf + any((int2)(i, -(int)i)) + all((int4)(-1, -2, (int)a, -3)) +
           shuffle((uint4)(a, i, 5, 6), (uint4)(i & 3)).x + shuffle2((uint2)(a, 7), (uint2)(i, 8), (uint2)(i & 3)).y;
}

kernel void math(global uint *out, global const uint *in, local uint *t) {
  ITEM;
  float part, c;
  int e, q, sign;
  float y = sin(x) + cos(x) * exp(x) - pow(fabs(x), 1.5f) + atan2(x, 2.0f) + cbrt(x) + log1p(fabs(x));
  y += fract(x, &part) + modf(x, &c) + frexp(x, &e) + sincos(x, &c) + remquo(x, 0.7f, &q);
  y += lgamma_r(fabs(x) + 1, &sign) + ldexp(x, 3) + rsqrt(fabs(x) + 1) + native_exp(x) + half_cos(x);
  y += nextafter(x, 1.0f) + fma(x, x, part) + mad(x, x, c) + hypot(x, c) + fmod(x, 0.3f) + copysign(1.0f, x);
  y += (isfinite(y) ? 1 : 0) + (isless(x, y) ? 2 : 0) + (signbit(x) ? 4 : 0) + smoothstep(0.0f, 1.0f, x);
  float4 v = exp2((float4)(x)) + round((float4)(x, y, x, y)) + convert_float4(isgreater((float4)(x), (float4)(y)));
  out[i] = as_uint(y) + e + q + sign + as_uint(v.w);
}

kernel void components(global uint *out, global const uint *in, local uint *t) {
  ITEM;
  global uint4 *v = (global uint4 *)out + i / 4;
  switch (i & 3) {
  case 0: v->x = in[i] + l; break;
  case 1: v->y = in[i] * 3; break;
  case 2: v->z = as_uint(x); break;
  default: v->w = i;
  }
}

kernel __attribute__((reqd_work_group_size(32, 1, 1))) void groups(global uint *out, global const uint *in, local uint *t) {
  ITEM;
  local uint kept[64];
  local uint sum;
  if (l == 0)
    sum = 0;
  event_t copied = async_work_group_copy(t, in + get_group_id(0) * 32, 32, 0);
  wait_group_events(1, &copied);
  kept[l] = t[31 - l];
  kept[l + 32] = i;
  barrier(CLK_LOCAL_MEM_FENCE);
  atomic_add(&sum, kept[63 - l] & 15);
  uint left = kept[(l + 1) % 32];
  for (uint step = 16; step > 0; step /= 2) {
    barrier(CLK_LOCAL_MEM_FENCE);
    if (l < step)
      kept[l] += kept[l + step];
  }
  barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
  atomic_max(out + get_global_size(0), sum);
  atomic_inc((volatile global int *)out + get_global_size(0) + 1);
  out[i] = kept[0] + left * 3 + sum + get_num_groups(0) + get_local_size(1) + get_global_offset(0) + get_work_dim();
}

kernel void flow(global uint *out, global const uint *in, local uint *t) {
  ITEM;
  uint a = in[i] | 1, n = 0;
  while (a != 1 && n < 100) {
    a = a & 1 ? a * 3 + 1 : a / 2;
    ++n;
    if (n % 17 == 16)
      continue;
    switch (a % 7) {
    case 0: n += 1; break;
    case 1: n ^= 3;
    case 2: n += 2; break;
    case 5: goto out;
    default: break;
    }
  }
out:
  out[i] = n * 1000 + a % 1000 + (x > 0 && a > 2 ? 7 : 0);
}
