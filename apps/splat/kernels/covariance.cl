// From a scaled, rotated Gaussian to its covariance on the picture (EWA:
// Zwicker et al. 2001, "EWA volume splatting", with the 3DGS clamp). The order
// of operations is that of reference/Projection.h, which gives the same bits.

typedef struct {
  float xx, xy, yy; // with the dilation
  float det;        // of that
  float det_sharp;  // without the dilation
} screen_covariance;

static float dot_in_order(float3 a, float3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Covariance on the picture of a Gaussian at depth z whose camera-space x/z and
// y/z, already clamped, are `ratio`. The determinant of B B^T + h I is taken as
// the sum of B's squared minors and h tr + h^2 (Cauchy-Binet): the difference
// xx yy - xy^2 would lose a needle's whole short axis in fp32.
static screen_covariance project_covariance(__constant const splat_view *view,
                                            float z, float2 ratio, float3 scale,
                                            float4 unit) {
  const float w = unit.x, x = unit.y, y = unit.z, k = unit.w;
  // Columns of Q diag(s).
  const float3 q0 = (float3)(1.0f - 2.0f * (y * y + k * k),
                             2.0f * (x * y + w * k), 2.0f * (x * k - w * y)) *
                    scale.x;
  const float3 q1 = (float3)(2.0f * (x * y - w * k),
                             1.0f - 2.0f * (x * x + k * k),
                             2.0f * (y * k + w * x)) *
                    scale.y;
  const float3 q2 = (float3)(2.0f * (x * k + w * y), 2.0f * (y * k - w * x),
                             1.0f - 2.0f * (x * x + y * y)) *
                    scale.z;
  __constant const float *r = view->rotation;
  const float3 r0 = (float3)(r[0], r[1], r[2]);
  const float3 r1 = (float3)(r[3], r[4], r[5]);
  const float3 r2 = (float3)(r[6], r[7], r[8]);
  const float3 a0 = (float3)(dot_in_order(r0, q0), dot_in_order(r0, q1),
                             dot_in_order(r0, q2));
  const float3 a1 = (float3)(dot_in_order(r1, q0), dot_in_order(r1, q1),
                             dot_in_order(r1, q2));
  const float3 a2 = (float3)(dot_in_order(r2, q0), dot_in_order(r2, q1),
                             dot_in_order(r2, q2));
  const float fx = view->focal[0], fy = view->focal[1];
  const float3 b = (fx / z) * a0 + (-fx * (ratio.x * z) / (z * z)) * a2;
  const float3 c = (fy / z) * a1 + (-fy * (ratio.y * z) / (z * z)) * a2;
  const float xx = dot_in_order(b, b);
  const float yy = dot_in_order(c, c);
  const float3 minors = (float3)(b.x * c.y - b.y * c.x, b.x * c.z - b.z * c.x,
                                 b.y * c.z - b.z * c.y);

  screen_covariance s;
  s.xx = xx + DILATION;
  s.xy = dot_in_order(b, c);
  s.yy = yy + DILATION;
  s.det_sharp = dot_in_order(minors, minors);
  s.det = s.det_sharp + DILATION * (xx + yy) + DILATION * DILATION;
  return s;
}
