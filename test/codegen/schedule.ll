; What is known of the core orders code: a load goes ahead of what does not need
; it, and slow divisions start before short chains.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -mattr=+relax -target-abi=ilp32f -O2 < %s | FileCheck %s

; CHECK-LABEL: loads:
; CHECK: flw [[V:fa[0-9]+]], 0(a0)
; CHECK-NOT: [[V]]
; CHECK: fmul.s
; CHECK: fadd.s {{.*}}[[V]]
define float @loads(ptr %p, float %a, float %b) {
  %m = fmul float %a, %b
  %n = fmul float %m, %a
  %v = load float, ptr %p
  %s = fadd float %v, %n
  ret float %s
}

; CHECK-LABEL: divides:
; CHECK: fdiv.s
; CHECK: fmul.s
; CHECK: fmul.s
; CHECK: fadd.s
define float @divides(float %a, float %b) {
  %m = fmul float %a, %b
  %n = fmul float %m, %a
  %q = fdiv float %b, %a
  %s = fadd float %n, %q
  ret float %s
}
