// Messages name the built-in functions as the program does, and show few overloads of each.
// REQUIRES: vorion-clang, vorion-cl-link
// RUN: not vorion-clang %s -o %t.elf 2> %t.txt
// RUN: FileCheck %s --input-file=%t.txt --implicit-check-not=_cl_ --implicit-check-not=_builtin_renames --implicit-check-not=fshow-overloads
// RUN: grep -c 'note: candidate function' %t.txt | FileCheck %s --check-prefix=COUNT
// COUNT: {{^}}8{{$}}
#define TWICE(x) ((x) * two)
kernel void k(global float *out, global int *p) {
  // CHECK: messages.cl:[[@LINE+1]]:12: error: no matching function for call to 'sin'
  out[0] = sin(p);
  // CHECK-NEXT: 10 |   out[0] = sin(p);
  // CHECK-NEXT: ^~~{{$}}
  // CHECK-NEXT: opencl-c.h:{{[0-9]+:[0-9]+}}: note: candidate function not viable: no known conversion
  // CHECK: note: remaining {{[0-9]+}} candidates omitted{{$}}
  // CHECK-NEXT: messages.cl:[[@LINE+1]]:12: error: no matching function for call to 'clamp'
  out[1] = clamp(out[2], 1);
  // CHECK: note: remaining {{[0-9]+}} candidates omitted{{$}}
  // A program's own macros stay.
  // CHECK-NEXT: messages.cl:[[@LINE+1]]:12: error: use of undeclared identifier 'two'
  out[2] = TWICE(out[3]);
  // CHECK: messages.cl:7:25: note: expanded from macro 'TWICE'
}
// CHECK: error: {{.*}}messages.cl: 3 errors, expected OpenCL C that compiles
