; A short side becomes a select; one that writes to memory stays.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-select-sides -S < %s | FileCheck %s
; CHECK-LABEL: @short(
; CHECK-NOT: br i1
; CHECK: select i1
; CHECK-LABEL: @writes(
; CHECK: br i1
define i32 @short(i32 %x, i32 %y) {
  %odd = trunc i32 %x to i1
  br i1 %odd, label %side, label %meet
side:
  %a = add i32 %y, 7
  br label %meet
meet:
  %r = phi i32 [ %a, %side ], [ %y, %0 ]
  ret i32 %r
}

define void @writes(i32 %x, ptr %p) {
  %odd = trunc i32 %x to i1
  br i1 %odd, label %side, label %meet
side:
  store i32 %x, ptr %p
  br label %meet
meet:
  ret void
}
