; What LLVM sank behind a loop is raised where fewer values are then alive across
; it: a sum in place of its terms. Not where its terms are needed anyway.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-raise-invariants -S < %s | FileCheck %s

; CHECK-LABEL: @sum(
; CHECK: entry:
; CHECK: %xx = fmul
; CHECK: %xy = fadd
; CHECK: %sum = fadd
; CHECK: br label %loop
; CHECK: behind:
; CHECK-NEXT: %root = fadd float %next, %sum
define float @sum(ptr %p, i32 %count) {
entry:
  %x = load float, ptr %p
  %q = getelementptr float, ptr %p, i32 1
  %y = load float, ptr %q
  br label %loop
loop:
  %at = phi float [ 1.0, %entry ], [ %next, %loop ]
  %k = phi i32 [ 0, %entry ], [ %k1, %loop ]
  %next = fmul float %at, 0.5
  %k1 = add i32 %k, 1
  %more = icmp ult i32 %k1, %count
  br i1 %more, label %loop, label %behind
behind:
  %xx = fmul float %x, %x
  %xy = fadd float %xx, %y
  %sum = fadd float %xy, 1.0
  %root = fadd float %next, %sum
  ret float %root
}

; Both terms are stored behind the loop.
; CHECK-LABEL: @terms_stay(
; CHECK: behind:
; CHECK-NEXT: %sum = fadd float %x, %y
define float @terms_stay(ptr %p, i32 %count) {
entry:
  %x = load float, ptr %p
  %q = getelementptr float, ptr %p, i32 1
  %y = load float, ptr %q
  br label %loop
loop:
  %at = phi float [ 1.0, %entry ], [ %next, %loop ]
  %k = phi i32 [ 0, %entry ], [ %k1, %loop ]
  %next = fmul float %at, 0.5
  %k1 = add i32 %k, 1
  %more = icmp ult i32 %k1, %count
  br i1 %more, label %loop, label %behind
behind:
  %sum = fadd float %x, %y
  %root = fadd float %next, %sum
  store float %x, ptr %q
  store float %y, ptr %p
  ret float %root
}

; What reads memory stays: the loop may write it. So does what may trap.
; CHECK-LABEL: @loads_stay(
; CHECK: behind:
; CHECK-NEXT: %x = load
; CHECK-NEXT: %d = udiv
define i32 @loads_stay(ptr %p, i32 %a, i32 %b, i32 %count) {
entry:
  %u = add i32 %a, %b
  %v = mul i32 %a, %b
  br label %loop
loop:
  %k = phi i32 [ 0, %entry ], [ %k1, %loop ]
  store i32 %k, ptr %p
  %k1 = add i32 %k, 1
  %more = icmp ult i32 %k1, %count
  br i1 %more, label %loop, label %behind
behind:
  %x = load i32, ptr %p
  %d = udiv i32 %u, %v
  %sum = add i32 %x, %d
  ret i32 %sum
}

; Around the loop is another, in which x and y are needed each time.
; CHECK-LABEL: @around(
; CHECK: behind:
; CHECK-NEXT: %sum = fadd float %x, %y
define float @around(ptr %p, i32 %count) {
entry:
  %x = load float, ptr %p
  %q = getelementptr float, ptr %p, i32 1
  %y = load float, ptr %q
  br label %outer
outer:
  %all = phi float [ 0.0, %entry ], [ %root, %behind ]
  %o = phi i32 [ 0, %entry ], [ %o1, %behind ]
  br label %loop
loop:
  %at = phi float [ 1.0, %outer ], [ %next, %loop ]
  %k = phi i32 [ 0, %outer ], [ %k1, %loop ]
  %next = fmul float %at, 0.5
  %k1 = add i32 %k, 1
  %more = icmp ult i32 %k1, %count
  br i1 %more, label %loop, label %behind
behind:
  %sum = fadd float %x, %y
  %part = fadd float %next, %sum
  %root = fadd float %all, %part
  %o1 = add i32 %o, 1
  %again = icmp ult i32 %o1, %count
  br i1 %again, label %outer, label %out
out:
  ret float %root
}
