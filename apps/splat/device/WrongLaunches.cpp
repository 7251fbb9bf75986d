// Launches and choices that must not compile. Compiled for its errors alone:
// clang's -verify compares them with the comments.
#include "device/Launcher.h"
#include "kernels/adam.cl.h"
#include "kernels/scan.cl.h"
#include "kernels/sort.cl.h"

using namespace vorion::splat;

void launch(Launcher &Launch, const cl::Buffer &In, const cl::Buffer &Out) {
  using kernels::scan::scan_apply;
  using kernels::scan::scan_partials;
  // As it should be.
  Launch.run(1, 1, scan_partials{.sums = In, .count = 3U});

  // A number of another type.
  // expected-error@+1 {{no viable conversion}}
  scan_partials{.sums = In, .count = 3};
  // expected-error@+1 {{no viable conversion}}
  scan_partials{.sums = In, .count = 3.0F};
  // expected-error@+1 {{no viable conversion}}
  scan_partials{.sums = In, .count = std::size_t{3}};
  // A number for a buffer, and a buffer for a number.
  // expected-error@+1 {{no viable conversion}}
  scan_partials{.sums = 3U, .count = 3U};
  // expected-error@+1 {{no viable conversion}}
  scan_partials{.sums = In, .count = In};
  // None.
  // expected-error@+1 {{no matching constructor}}
  scan_partials{.sums = In};
  // In another order.
  // expected-error@+1 {{order}}
  scan_apply{.sums = In, .in = In, .out = Out, .count = 3U, .chunk = 1U};
  // Of another name, and no launch at all.
  // expected-error@+1 {{counts}}
  scan_partials{.sums = In, .counts = 3U};
  // expected-error@+1 {{no matching member function}}
  Launch.run(1, 1, In);
}

void choose() {
  kernels::adam::Program{.MOMENTS_BY_PLANE = true};
  // Of a program that does not take it, or of another name.
  // expected-error@+1 {{MOMENTS_BY_PLANE}}
  kernels::sort::Program{.MOMENTS_BY_PLANE = true};
  // expected-error@+1 {{MOMENTS_BY_PLANES}}
  kernels::adam::Program{.MOMENTS_BY_PLANES = true};
}
