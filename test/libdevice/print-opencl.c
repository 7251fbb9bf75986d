// What OpenCL's printf adds: vectors, and `l` for 64 bits. A C program passes
// the same words that a kernel would: vectors by the ABI's own rules.
// REQUIRES: vorion-clang, vorion-link, vorion-sim
// RUN: vorion-clang -O2 %s -o %t.elf && vorion-sim %t.elf | FileCheck %s
#include <vorion.h>
#include <vorion_print.h>

typedef float float2 __attribute__((ext_vector_type(2)));
typedef float float3 __attribute__((ext_vector_type(3)));
typedef float float4 __attribute__((ext_vector_type(4)));
typedef float float16 __attribute__((ext_vector_type(16)));
typedef double double2 __attribute__((ext_vector_type(2)));
typedef double double3 __attribute__((ext_vector_type(3)));
typedef signed char char2 __attribute__((ext_vector_type(2)));
typedef unsigned char uchar8 __attribute__((ext_vector_type(8)));
typedef short short4 __attribute__((ext_vector_type(4)));
typedef int int3 __attribute__((ext_vector_type(3)));
typedef long long long2 __attribute__((ext_vector_type(2)));

static int print(const char *format, ...) {
  va_list list;
  va_start(list, format);
  const int result = vx_vprintf_opencl(format, list);
  va_end(list);
  return result;
}

int main(void) {
  if (vx_core_id() != 0 || vx_thread_id() != 3)
    return 0;
  // CHECK: 1.500000 -0.1 1e-40 0x1.8p+0 inf nan
  print("%f %g %.0e %a %f %lf\n", 1.5f, -0.1f, 1e-40f, 1.5f, 1.0f / 0.0f,
        0.0f / 0.0f);
  // CHECK-NEXT: 1.0,2.0 3.00,4.00,5.00 6,7,8,9
  print("%.1v2hlf %.2v3hlf %v4hlg\n", (float2){1, 2}, (float3){3, 4, 5},
        (float4){6, 7, 8, 9});
  // CHECK-NEXT: 0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15 42
  print("%v16hlg %d\n",
        (float16){0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}, 42);
  // CHECK-NEXT: 0.1 1e-300,-2.5 0x1p+0,0x1p+1,0x1.999999999999ap-4
  print("%.16lg %v2lg %v3la\n", 0.1, (double2){1e-300, -2.5},
        (double3){1, 2, 0.1});
  // CHECK-NEXT: -1,2 01,02,03,04,05,06,07,ff -300,4,5,6 7,-8,9
  print("%v2hhd %02v8hhx %v4hd %v3hld\n", (char2){-1, 2},
        (uchar8){1, 2, 3, 4, 5, 6, 7, 255}, (short4){-300, 4, 5, 6},
        (int3){7, -8, 9});
  // CHECK-NEXT: -5000000000,6000000000 -5000000000 18446744073709551615
  print("%v2ld %ld %lu\n", (long2){-5000000000, 6000000000}, -5000000000ll,
        ~0ull);
  // CHECK-NEXT: -1 good
  if (print("%v5d\n", 1) == -1 && print("") == 0)
    print("%d %s\n", -1, "good");
  return 0;
}
