; One return, and a way to it from an endless loop, which is never taken. The way from a dead end that several branches go to
; closes no loop: it leads behind the last of them.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-unify-exits -S < %s | FileCheck %s
; CHECK-LABEL: @two(
; CHECK-COUNT-1: ret i32
; CHECK-NOT: ret i32
; CHECK-LABEL: @endless(
; CHECK: endless:
; CHECK-NEXT: br i1 true, label %loop, label %out
; CHECK-LABEL: @shared(
; CHECK: trap:
; CHECK: br label %out
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion < %s | FileCheck %s --check-prefix=CODE
; CODE-LABEL: shared:
; CODE: unimp
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

define void @shared(ptr %p, i1 %a, i1 %b) {
  br i1 %a, label %first, label %trap
trap:
  call void @llvm.trap()
  unreachable
first:
  br i1 %b, label %out, label %second
second:
  %word = load i32, ptr %p
  %good = icmp eq i32 %word, 0
  br i1 %good, label %out, label %trap
out:
  ret void
}
