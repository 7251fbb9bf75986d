#include "Broken.h"

#include "device/Kernels.h"
#include "vorion/support/File.h"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <fmt/format.h>

namespace vorion::test {
namespace {

using splat::Path;
using splat::SimtSums;

constexpr std::string_view PlainProduct =
    "s.det_sharp = xx * yy - dot_in_order(b, c) * dot_in_order(b, c);";

} // namespace

const std::vector<BrokenKernel> &brokenKernels() {
  static const std::vector<BrokenKernel> All{
      {"determinant-by-difference",
       {},
       {{"covariance.cl", "s.det_sharp = dot_in_order(minors, minors);",
         PlainProduct}}},
      {"determinant-unchecked",
       {},
       {{"project.cl", "if (s.det <= 0.0f)", "if (false)"}}},
      {"dilation-fixed",
       {},
       {{"covariance.cl", "static float dot_in_order",
         "#undef DILATION\n#define DILATION 0.3f\nstatic float dot_in_order"}}},
      {"dilation-lost",
       {},
       {{"covariance.cl", "s.xx = xx + DILATION;", "s.xx = xx;"}}},
      {"non-finite-unchecked",
       {},
       {{"project.cl", "if (!isfinite(s.det))", "if (false)"},
        {"project.cl",
         "if (!(zero + finite_zero(color.x, color.y, color.z) == 0.0f))",
         "if (false)"}}},
      {"exponent-wraps", {}, {{"activate.cl", "clamp(x, -limit, limit)", "x"}}},
      {"zero-quaternion-unchecked",
       {},
       {{"activate.cl", "if (!(squares.x > 0.0f))", "if (false)"}}},
      {"quaternion-range",
       {},
       {{"activate.cl", "q *= quaternion_factor(q);", ""}}},
      // As PyTorch's normalize() does.
      {"quaternion-over-1e-12",
       {},
       {{"activate.cl", "q *= quaternion_factor(q);", ""},
        {"activate.cl", "const float norm = sqrt(squares.x);",
         "const float norm = fmax(sqrt(squares.x), 1e-12f);"}}},
      {"quaternion-not-normalised",
       {},
       {{"activate.cl", "const float norm = sqrt(squares.x);",
         "const float norm = 1.0f;"}}},
      {"opacity-of-9-bits",
       {},
       {{"project.cl", "float opacity = activated.w;",
         "float opacity = as_float(as_uint(activated.w) & 0xffff8000u);"}}},
      {"near-plane-at-0",
       {},
       {{"project.cl", "!(KEEP_DEPTH(z))", "!(z > 0.0f)"}}},
      {"behind-mirrored",
       {},
       {{"project.cl", "!(KEEP_DEPTH(z))", "z == 0.0f"}}},
      {"jacobian-unclamped",
       {},
       {{"project.cl", "if (USE_FIELD_OF_VIEW)", "if (false)"}}},
      {"depth-by-plain-sum",
       {},
       {{"camera_depth.cl", "return sum.x + sum.y;", "return sum.x;"}}},
      {"centre-of-one-float",
       {},
       {{"covariance.cl", "return p - high - low;", "return p - high;"}}},
      {"crop-by-plain-sum",
       {},
       {{"crop.cl", "return beside.x + beside.y;", "return beside.x;"}}},
      {"crop-by-plain-axes",
       {},
       {{"crop.cl",
         "crop->across_low[axis][k] * d.x +\n                      "
         "crop->across[axis][k] * d.y",
         "crop->across[axis][k] * d.y"}}},
      {"ordered-by-distance",
       {},
       {{"project.cl", "  return as_uint(z);\n}",
         "  return as_uint(sqrt(x * x + y * y + z * z));\n}"}}},
      {"rays-see-centres",
       Path::Simt,
       {{"blend_by_ray.cl", "const float depth = ray_depth(&frame[j], slope);",
         "const float depth = (float)(base + j);"}}},
      {"ray-window-once",
       Path::Simt,
       {{"blend_by_ray.cl", "group_live = live != 0;", "group_live = false;"}}},
      {"opencv-folds",
       {},
       {{"lens_opencv.cl", "return p.z > 0.0f && q < lens->limit;",
         "return p.z > 0.0f;"}}},
      // What only looks at the slope at the point itself.
      {"opencv-unfolds",
       {},
       {{"lens_opencv.cl", "return p.z > 0.0f && q < lens->limit;",
         "const lens_radial at_q = lens_radial_at(lens, q);\n"
         "  return p.z > 0.0f && at_q.value + 2.0f * q * at_q.slope > 0.0f;"}}},
      {"fisheye-folds",
       {},
       {{"lens_fisheye.cl", "return f.angle < lens->limit;", "return true;"}}},
      {"fisheye-unfolds",
       {},
       {{"lens_fisheye.cl", "return f.angle < lens->limit;",
         "return 1.0f + f.angle * f.angle * lens_growth(lens, f.angle * "
         "f.angle) > 0.0f;"}}},
      {"ties-reversed",
       {},
       {{"project.cl", "w->depths[i] = key;",
         "w->depths[count - 1 - i] = key;"},
        {"sort.cl", "value_of(&a, key[k], i + k * lanes, f, at)",
         "value_of(&a, key[k], f.kept ? count - 1 - i - k * lanes : i + k * "
         "lanes, f, at)"},
        {"sort.cl", "value_of(&a, key, i, f, at)",
         "value_of(&a, key, f.kept ? count - 1 - i : i, f, at)"}}},
      {"negative-tiles-wrap",
       {},
       {{"support.cl", "return (uint)fmin(fmax(v, 0.0f), (float)most);",
         "return min((uint)(int)floor(v), most);"}}},
      {"boxes-beyond-the-picture",
       {},
       {{"support.cl", "if (!(mean - extent < (float)size)) {",
         "if (false) {"}}},
      {"radius-of-16-bits",
       {},
       {{"support.cl", "*extent = (float2)(radius, radius);",
         "*extent = (float2)((float)(short)(int)radius, "
         "(float)(short)(int)radius);"}}},
      {"box-without-its-border",
       {},
       {{"project.cl", "g->extent[0] = pixel_extent(extent.x);",
         "g->extent[0] = pixel_extent(extent.x) * 0.9999999f;"}}},
      {"negative-colors",
       {},
       {{"sh.cl", "return fmax(color + 0.5f, 0.0f);", "return color + 0.5f;"}}},
      {"background-twice",
       {},
       {{"resolve.cl", "+ transmittance * background;",
         "+ 2.0f * transmittance * background;"}}},
      {"never-stops",
       {},
       {{"rasterize.cl", "vx_raster_setup((uint)records, options.cutoff,",
         "vx_raster_setup((uint)records, 0.0f,"},
        {"blend.cl", "#define SATURATED(t) ((t) < cutoff)",
         "#define SATURATED(t) (false)"}}},
      {"list-cut-at-8",
       {},
       {{"rasterize.cl", "(uint)sizeof(uint), count, x, y,",
         "(uint)sizeof(uint), min(8u, count), x, y,"},
        {"blend.cl", "const uint entries = min((uint)BATCH, range.y - base);",
         "const uint entries = base == range.x ? min(8u, range.y - base) "
         ": 0u;"}}},
      {"last-entry-lost",
       {},
       {{"rasterize.cl", "(uint)sizeof(uint), count, x, y,",
         "(uint)sizeof(uint), count - (count > 0u ? 1u : 0u), x, y,"},
        {"blend.cl", "const uint entries = min((uint)BATCH, range.y - base);",
         "const uint entries = min((uint)BATCH, range.y - base - 1u);"}}},
      {"last-column-lost",
       {},
       {{"rasterize.cl", "min((uint)TILE_SIZE, c->o.size[0] - x)",
         "min((uint)TILE_SIZE, c->o.size[0] - 1u - x)"},
        {"blend.cl", "x0 + PLACE_X(place) < width &&",
         "x0 + PLACE_X(place) < width - 1u &&"}}},
      // The rasterizer's own arithmetic is no kernel's; its datapath is held
      // against a scalar loop, and so are that loop's broken variants
      // (isasim/raster/HardCases_test.cpp).
      {"alpha-reaches-1",
       Path::Simt,
       {{"blend.cl", "fmin(0.99f, ", "fmin(1.0f, "}}},
      {"alpha-cut-at-200th",
       Path::Simt,
       {{"blend.cl", "alpha >= ALPHA_CUTOFF / 255.0f",
         "alpha >= 1.0f / 200.0f"}}},
      {"transmittance-of-bf16",
       Path::Simt,
       {{"blend.cl", "p.transmittance = blended ? next : p.transmittance;",
         "p.transmittance = blended ? as_float(as_uint(next) & 0xffff0000u) : "
         "p.transmittance;"}}},
      // Training.
      {"culled-go-back",
       {},
       {{"project_backward.cl", "if (depths[i] < CULLED) {", "if (true) {"}}},
      {"sixteenth-lost",
       {},
       {{"rasterize_backward.cl", "as_float(vr_grad_s());",
         "get_local_id(0) == 15 ? 0.0f : as_float(vr_grad_s());"},
        {"blend_backward.cl", "= sum_of_lanes(",
         "= lane == 15 ? 0.0f : sum_of_lanes("},
        {"blend_backward_atomics.cl",
         "const bool listed =", "const bool listed = e != 15 &&"},
        {"blend_backward_atomics.cl", "if (left - 1 - e >= own_last ||",
         "if (e == 15 || left - 1 - e >= own_last ||"}}},
      {"seventeenth-lost",
       {},
       {{"rasterize_backward.cl",
         "range.x + VR_GRAD_LANES * (next >> VR_GRAD_NEXT_BATCH_SHIFT);",
         "range.x;"},
        {"blend_backward.cl", "= sum_of_lanes(",
         "= first != 0 ? 0.0f : sum_of_lanes("},
        {"blend_backward_atomics.cl",
         "const bool listed =", "const bool listed = e < 16 &&"},
        {"blend_backward_atomics.cl", "if (left - 1 - e >= own_last ||",
         "if (e >= 16 || left - 1 - e >= own_last ||"}}},
      {"second-batch-lost",
       Path::Simt,
       {{"blend_backward_atomics.cl", "left -= entries;", "left = 0;"}},
       {SimtSums::Atomics, SimtSums::Warp}},
      // Whoever comes second at a sum loses what it adds.
      {"atomic-once",
       Path::Simt,
       {{"atomic_sum.cl", "if (found == expected)", "if (true)"}},
       {SimtSums::Atomics, SimtSums::Warp}},
      {"last-lane-lost",
       Path::Simt,
       {{"warp_sums.cl", "(*parts)[k][lane] = sum[k];",
         "(*parts)[k][lane] = lane == 15 ? 0.0f : sum[k];"}},
       {SimtSums::Warp}},
      {"warp-wants-all",
       Path::Simt,
       {{"warp_sums.cl", "if (!vx_vote_any(has))", "if (!vx_vote_all(has))"}},
       {SimtSums::Warp}},
      // The rasterizer's unit has variants of its own that must be noticed
      // (isasim/raster/HardBackward_test.cpp).
      {"reciprocal-rounded",
       Path::Simt,
       {{"pixel_backward.cl", "s.x / (1.0f - alpha)",
         "s.x * (1.0f / (1.0f - alpha))"}}},
      {"quaternion-gradient-unbounded",
       {},
       {{"project_backward.cl", "fmin(2.0f * factor / length, 0x1p104f)",
         "2.0f * factor / length"}}},
      {"drift-not-held",
       {},
       {{"rolling.cl", "ROLLING_END ? rolling_drift(r, j)",
         "ROLLING_END ? rolling_drift(r, lens_rows_at(view, lens, r->p, "
         "false))"}}},
      {"dilation-not-sheared",
       {},
       {{"rolling.cl", "(a.xx * a.yx + a.xy * a.yy)", "0.0f"}}},
      {"shear-forgotten-behind",
       {},
       {{"rolling_backward.cl", "by_way = 2.0f * DILATION",
         "by_way = 0.0f * DILATION"}}},
      {"near-plane-of-the-pose",
       {},
       {{"project.cl", "KEEP_DEPTH(rolling_depth(&own))", "KEEP_DEPTH(z)"}}},
      {"points-anywhere",
       {},
       {{"unscented.cl", "within &= dot(way, way) <= lens->most_spread;", ""}}},
      {"points-forget-their-shift",
       {},
       {{"unscented_backward.cl", "-2.8284271f * by_off[6]",
         "0.0f * by_off[6]"}}},
      {"held-slope-of-no-depth",
       {},
       {{"lens_pinhole.cl", "along - by.x.x - by.y.y", "- by.x.x - by.y.y"}}},
      {"faint-come-back",
       Path::Simt,
       {{"blend_backward.cl", "(power >= MIN_POWER)", "true"},
        {"blend_backward_atomics.cl", "(power >= MIN_POWER)", "true"},
        {"pixel_backward.cl", "if (!(alpha >= ALPHA_CUTOFF / 255.0f))",
         "if (false)"}}},
      {"background-lost",
       {},
       {{"upstream.cl", "(red * r + green * g + blue * b) - by_alpha[i]",
         "-by_alpha[i]"}}},
      {"absolute-sums-signed",
       Path::Simt,
       {{"pixel_backward.cl", "fabs(g->conic[0] * vx + g->conic[1] * vy)",
         "g->conic[0] * vx + g->conic[1] * vy"}}},
      {"points-of-a-pixel-lost",
       {},
       {{"depth_loss.cl", "k < count && points[k].x == pixel", "k == i"}}},
      {"pose-of-one-float",
       {},
       {{"pose.cl", "high.xyz - low.xyz;", "high.xyz;"}}},
      {"mask-by-product",
       {},
       {{"mask.cl", "photo[i].w ? picture[i] : (float4)(0.0f)",
         "picture[i] * (float)photo[i].w"}}},
      {"mask-forgotten-behind",
       {},
       {{"mask.cl", "if (i >= pixels || photo[i].w)", "if (true)"}}},
      {"exposure-offset-lost",
       {},
       {{"exposure.cl", "{p.x, p.y, p.z, 1.0f}", "{p.x, p.y, p.z, 0.0f}"}}},
      {"weight-of-a-logit",
       {},
       {{"regularize.cl", "opacity * a.w * (1.0f - a.w)", "opacity * a.w"}}},
      {"dead-are-drawn",
       {},
       {{"mcmc.cl", "geometry[PLANE_LOGIT * count + i] > dead_logit", "true"}}},
      {"shares-unbounded",
       {},
       {{"mcmc.cl", "#define MOST_SHARES 51", "#define MOST_SHARES 1000000"}}},
      {"opaque-take-steps",
       {},
       {{"mcmc.cl", "rate / (1.0f + exp(100.0f * (scale.w - 0.005f)))",
         "rate"}}},
      {"adam-uncorrected",
       {},
       {{"adam.cl", "sqrt(v) * correction", "sqrt(v)"}}},
      {"adam-without-epsilon",
       {},
       {{"adam.cl", "(sqrt(v) * correction + epsilon)",
         "(sqrt(v) * correction)"}}},
      {"adam-epsilon-under-the-root",
       {},
       {{"adam.cl", "(sqrt(v) * correction + epsilon)",
         "sqrt(v * correction * correction + epsilon)"}}},
      {"ssim-without-c1",
       {},
       {{"loss.cl", "#define C1 1e-4f", "#define C1 0.0f"}}},
      {"ssim-without-c2",
       {},
       {{"loss.cl", "#define C2 9e-4f", "#define C2 0.0f"}}},
      {"ssim-weight-lost",
       {},
       {{"loss.cl", "per_absolute * side - per_ssim * ssim;",
         "per_absolute * side;"}}},
      {"sign-of-equal",
       {},
       {{"loss.cl", "x > y ? 1.0f : x < y ? -1.0f : 0.0f",
         "x >= y ? 1.0f : -1.0f"}}},
  };
  return All;
}

const BrokenKernel &brokenKernel(std::string_view Name) {
  const auto &All = brokenKernels();
  const auto Found = std::ranges::find(All, Name, &BrokenKernel::Name);
  assert(Found != All.end() && "a case names a kernel that does not exist");
  return *Found;
}

Expected<Success> writeKernels(const std::string &Folder,
                               const BrokenKernel &B) {
  std::error_code Failed;
  std::filesystem::create_directories(Folder, Failed);
  for (const std::string_view File : splat::kernelFiles()) {
    std::string Text(splat::kernelSource(File));
    for (const KernelEdit &E : B.Edits) {
      if (E.File != File)
        continue;
      const std::size_t At = Text.find(E.Guard);
      if (At == std::string::npos ||
          Text.find(E.Guard, At + 1) != std::string::npos)
        return Error{std::string(File),
                     fmt::format("'{}' of the broken kernel {}, expected it "
                                 "once",
                                 E.Guard, B.Name),
                     ExitCode::Internal};
      Text.replace(At, E.Guard.size(), E.Instead);
    }
    if (auto W = writeFileAtomically(Folder + "/" + std::string(File), Text);
        !W)
      return W;
  }
  return Success{};
}

} // namespace vorion::test
