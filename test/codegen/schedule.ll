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

; A spilled value is fetched long before it is used, although the register
; allocator puts the load right in front of its use.
; CHECK-LABEL: reloads:
; CHECK: #NO_APP
; CHECK-NOT: fcvt
; CHECK: flw [[R:fa[0-9]+]], {{.*}}(sp)
; CHECK: fcvt.s.w
; CHECK: fadd.s {{.*}}[[R]]
define float @reloads(float %a, i32 %b) {
  %c = call i32 asm sideeffect "", "=r,~{f0},~{f1},~{f2},~{f3},~{f4},~{f5},~{f6},~{f7},~{f8},~{f9},~{f10},~{f11},~{f12},~{f13},~{f14},~{f15},~{f16},~{f17},~{f18},~{f19},~{f20},~{f21},~{f22},~{f23},~{f24},~{f25},~{f26},~{f27},~{f28},~{f29},~{f30},~{f31}"()
  %m = mul i32 %b, %c
  %n = mul i32 %m, %b
  %f = sitofp i32 %n to float
  %s = fadd float %f, %a
  ret float %s
}
