; One return, and a way to it from an endless loop, which is never taken.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-unify-exits -S < %s | FileCheck %s
; CHECK-LABEL: @two(
; CHECK-COUNT-1: ret i32
; CHECK-NOT: ret i32
; CHECK-LABEL: @endless(
; CHECK: endless:
; CHECK-NEXT: br i1 true, label %loop, label %out
define i32 @two(i32 %x) {
  %odd = trunc i32 %x to i1
  br i1 %odd, label %a, label %b
a:
  ret i32 1
b:
  ret i32 2
}

define void @endless(i32 %x) {
  %odd = trunc i32 %x to i1
  br i1 %odd, label %loop, label %out
loop:
  br label %loop
out:
  ret void
}
