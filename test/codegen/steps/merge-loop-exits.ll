; A loop that lanes leave in two places leaves by one new latch, and reads behind it where to go on.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-merge-loop-exits -S < %s | FileCheck %s
; CHECK-LABEL: @search(
; CHECK: loop.latch:
; CHECK: %loop.repeat = phi i1
; CHECK: br i1 %loop.repeat, label %{{.*}}, label %loop.leave
; CHECK: loop.leave:
; CHECK: icmp eq i32 %loop.which, 0
define i32 @search(ptr %p, i32 %x) {
entry:
  br label %head
head:
  %at = phi ptr [ %p, %entry ], [ %next, %body ]
  %v = load i32, ptr %at
  %found = icmp eq i32 %v, %x
  br i1 %found, label %yes, label %body
body:
  %next = getelementptr i8, ptr %at, i32 4
  %end = icmp eq i32 %v, 0
  br i1 %end, label %no, label %head
yes:
  ret i32 1
no:
  ret i32 0
}
