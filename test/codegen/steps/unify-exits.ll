; One return, and a way to it from an endless loop, which is never taken. A dead end that several branches go to is copied for
; each where its way would close a loop through the later one.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-unify-exits -S < %s | FileCheck %s
; CHECK-LABEL: @two(
; CHECK-COUNT-1: ret i32
; CHECK-NOT: ret i32
; CHECK-LABEL: @endless(
; CHECK: endless:
; CHECK-NEXT: br i1 true, label %loop, label %out
; CHECK-LABEL: @shared(
; CHECK: br i1 %b, label %out, label %second
; CHECK: br i1 %good, label %out, label %[[LATER:trap.copy[0-9]*]]
; CHECK: [[LATER]]:
; CHECK: br label %out
; CHECK-LABEL: @shared_loop(
; CHECK-COUNT-2: br i1 true, label %loop
; CHECK-LABEL: @shared_once(
; CHECK-COUNT-1: call void @llvm.trap()
; CHECK-NOT: call void @llvm.trap()
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion < %s | FileCheck %s --check-prefix=CODE
; CODE-LABEL: shared:
; CODE-COUNT-2: unimp
; CODE-LABEL: shared_loop:
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

declare void @llvm.trap()

define i32 @shared(ptr %p, i1 %a, i1 %b) {
  %before = load i32, ptr %p
  br i1 %a, label %first, label %trap
trap:
  %code = phi i32 [ 1, %0 ], [ %word, %second ]
  store i32 %code, ptr %p
  call void @llvm.trap()
  unreachable
first:
  br i1 %b, label %out, label %second
second:
  %word = load volatile i32, ptr %p
  %good = icmp eq i32 %word, 0
  br i1 %good, label %out, label %trap
out:
  ret i32 %before
}

define void @shared_loop(ptr %p, i1 %a, i1 %b) {
  br i1 %a, label %first, label %loop
loop:
  %count = phi i32 [ 0, %0 ], [ 1, %second ], [ %next, %loop ]
  %next = add i32 %count, 1
  store volatile i32 %next, ptr %p
  br label %loop
first:
  br i1 %b, label %out, label %second
second:
  %word = load volatile i32, ptr %p
  %good = icmp eq i32 %word, 0
  br i1 %good, label %out, label %loop
out:
  ret void
}

; Both branches meet in one place: nothing to copy.
define void @shared_once(ptr %p, i1 %a, i1 %b) {
  br i1 %a, label %left, label %right
left:
  br i1 %b, label %trap, label %out
right:
  store i32 1, ptr %p
  br i1 %b, label %out, label %trap
trap:
  call void @llvm.trap()
  unreachable
out:
  ret void
}
