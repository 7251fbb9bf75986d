// A static variable is one for all lanes: what another lane wrote before a
// barrier is read after it, though every run of the function writes it first.
// REQUIRES: vorion-clang
// RUN: vorion-clang -O2 -I %include -S %s -o - | FileCheck %s
#include "vorion.h"

// CHECK-LABEL: scalar:
// CHECK: sw zero, %lo(Scalar)([[AT:[a-z0-9]+]])
// CHECK: vx_bar
// CHECK: vx_bar
// CHECK: lw {{.*}}%lo(Scalar)([[AT]])
static int Scalar;
int scalar(void) {
  Scalar = 0;
  vx_bar(0, 1);
  if (vx_thread_id() == 7)
    Scalar = 5;
  vx_bar(0, 1);
  return Scalar;
}

// CHECK-LABEL: element:
// CHECK: sw zero, %lo(Array)
// CHECK: vx_bar
// CHECK: vx_bar
// CHECK: lw {{.*}}%lo(Array)
static int Array[1];
int element(void) {
  Array[0] = 0;
  vx_bar(0, 1);
  if (vx_thread_id() == 7)
    Array[0] = 5;
  vx_bar(0, 1);
  return Array[0];
}

// CHECK-LABEL: member:
// CHECK: sw zero, %lo(Pair
// CHECK: vx_bar
// CHECK: vx_bar
// CHECK: lw {{.*}}%lo(Pair
static struct {
  int First, Second;
} Pair;
int member(void) {
  Pair.Second = 0;
  vx_bar(0, 1);
  if (vx_thread_id() == 7)
    Pair.Second = 5;
  vx_bar(0, 1);
  return Pair.Second;
}

// One that nothing writes has one value for all, which is known.
// CHECK-LABEL: unwritten:
// CHECK: li a0, 3
// CHECK-NEXT: ret
static int Unwritten = 3;
int unwritten(void) { return Unwritten; }
