; What a block reads that lanes come to on both sides of a branch counts as different between them.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-repeated-blocks -S < %s | FileCheck %s
; CHECK-LABEL: @both(
; CHECK: or:
; CHECK: load i32, ptr @g, {{.*}}!vorion.divergent
@g = global i32 0
define i32 @both(i32 %x, i32 %y) {
  %a = trunc i32 %x to i1
  br i1 %a, label %and, label %or
and:
  %b = trunc i32 %y to i1
  br i1 %b, label %yes, label %or
or:
  %v = load i32, ptr @g, align 4
  br label %meet
yes:
  br label %meet
meet:
  %r = phi i32 [ 1, %yes ], [ %v, %or ]
  ret i32 %r
}
