; All steps together, in order; functions for another machine stay as they are.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-lower-divergence -S < %s | FileCheck %s
; RUN: vorion-opt -mtriple=riscv32 -passes=vorion-lower-divergence -S < %s | FileCheck %s --check-prefix=OTHER
; CHECK-LABEL: @cases(
; CHECK-NOT: switch
; CHECK: vx_split
; CHECK: ret void
; OTHER: switch
define void @cases(i32 %x, ptr %p) {
  switch i32 %x, label %out [ i32 1, label %a
                              i32 9, label %b ]
a:
  store i32 1, ptr %p
  br label %out
b:
  store i32 2, ptr %p
  br label %out
out:
  ret void
}
