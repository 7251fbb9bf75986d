; A float constant is made of integers, never loaded. Where registers are short it
; is made again, not spilled.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O2 < %s | FileCheck %s
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O0 < %s | FileCheck %s --check-prefix=PLAIN
; RUN: vorion-llc -mtriple=riscv32 -mattr=+f -target-abi=ilp32f -O2 < %s | FileCheck %s --check-prefix=OTHERS

; OTHERS-LABEL: tenth:
; OTHERS: flw

; CHECK-LABEL: tenth:
; CHECK: lui [[R:[a-z0-9]+]], 253133
; CHECK-NEXT: addi [[R2:[a-z0-9]+]], [[R]], -819
; CHECK-NEXT: fmv.w.x fa0, [[R2]]
; CHECK-NEXT: ret
; PLAIN-LABEL: tenth:
; PLAIN: lui
; PLAIN: addi
; PLAIN: fmv.w.x
define float @tenth() {
  ret float 0x3FB99999A0000000
}

; One, and minus zero.
; CHECK-LABEL: high:
; CHECK: lui [[R:[a-z0-9]+]], 260096
; CHECK-NEXT: fmv.w.x fa0, [[R]]
; CHECK-NEXT: ret
define float @high() {
  ret float 1.0
}
; CHECK-LABEL: minus_zero:
; CHECK: lui [[R:[a-z0-9]+]], 524288
; CHECK-NEXT: fmv.w.x fa0, [[R]]
define float @minus_zero() {
  ret float -0.0
}
; The least number above zero; its bits are 1.
; CHECK-LABEL: low:
; CHECK: li [[R:[a-z0-9]+]], 1
; CHECK-NEXT: fmv.w.x fa0, [[R]]
define float @low() {
  ret float 0x36A0000000000000
}
; CHECK-LABEL: zero:
; CHECK: fmv.w.x fa0, zero
; CHECK-NEXT: ret
define float @zero() {
  ret float 0.0
}

; Forty constants in a loop, and 32 registers.
; CHECK-LABEL: pressure:
; CHECK: # %loop
; CHECK-NOT: (sp)
; CHECK: bltu
define float @pressure(float %from, i32 %count) {
entry:
  br label %loop
loop:
  %x = phi float [ %from, %entry ], [ %x40, %loop ]
  %k = phi i32 [ 0, %entry ], [ %next, %loop ]
  %x0 = fmul float %x, %x
  %x1 = call float @llvm.fma.f32(float %x0, float %x, float 0x3FB99999A0000000)
  %x2 = call float @llvm.fma.f32(float %x1, float %x, float 0x3FDE147AE0000000)
  %x3 = call float @llvm.fma.f32(float %x2, float %x, float 0x3FEAE147A0000000)
  %x4 = call float @llvm.fma.f32(float %x3, float %x, float 0x3FF35C2900000000)
  %x5 = call float @llvm.fma.f32(float %x4, float %x, float 0x3FF947AE20000000)
  %x6 = call float @llvm.fma.f32(float %x5, float %x, float 0x3FFF333340000000)
  %x7 = call float @llvm.fma.f32(float %x6, float %x, float 0x40028F5C20000000)
  %x8 = call float @llvm.fma.f32(float %x7, float %x, float 0x4005851EC0000000)
  %x9 = call float @llvm.fma.f32(float %x8, float %x, float 0x40087AE140000000)
  %x10 = call float @llvm.fma.f32(float %x9, float %x, float 0x400B70A3E0000000)
  %x11 = call float @llvm.fma.f32(float %x10, float %x, float 0x400E666660000000)
  %x12 = call float @llvm.fma.f32(float %x11, float %x, float 0x4010AE1480000000)
  %x13 = call float @llvm.fma.f32(float %x12, float %x, float 0x401228F5C0000000)
  %x14 = call float @llvm.fma.f32(float %x13, float %x, float 0x4013A3D700000000)
  %x15 = call float @llvm.fma.f32(float %x14, float %x, float 0x40151EB860000000)
  %x16 = call float @llvm.fma.f32(float %x15, float %x, float 0x40169999A0000000)
  %x17 = call float @llvm.fma.f32(float %x16, float %x, float 0x4018147AE0000000)
  %x18 = call float @llvm.fma.f32(float %x17, float %x, float 0x40198F5C20000000)
  %x19 = call float @llvm.fma.f32(float %x18, float %x, float 0x401B0A3D80000000)
  %x20 = call float @llvm.fma.f32(float %x19, float %x, float 0x401C851EC0000000)
  %x21 = call float @llvm.fma.f32(float %x20, float %x, float 0x401E000000000000)
  %x22 = call float @llvm.fma.f32(float %x21, float %x, float 0x401F7AE140000000)
  %x23 = call float @llvm.fma.f32(float %x22, float %x, float 0x40207AE140000000)
  %x24 = call float @llvm.fma.f32(float %x23, float %x, float 0x40213851E0000000)
  %x25 = call float @llvm.fma.f32(float %x24, float %x, float 0x4021F5C280000000)
  %x26 = call float @llvm.fma.f32(float %x25, float %x, float 0x4022B33340000000)
  %x27 = call float @llvm.fma.f32(float %x26, float %x, float 0x402370A3E0000000)
  %x28 = call float @llvm.fma.f32(float %x27, float %x, float 0x40242E1480000000)
  %x29 = call float @llvm.fma.f32(float %x28, float %x, float 0x4024EB8520000000)
  %x30 = call float @llvm.fma.f32(float %x29, float %x, float 0x4025A8F5C0000000)
  %x31 = call float @llvm.fma.f32(float %x30, float %x, float 0x4026666660000000)
  %x32 = call float @llvm.fma.f32(float %x31, float %x, float 0x402723D700000000)
  %x33 = call float @llvm.fma.f32(float %x32, float %x, float 0x4027E147A0000000)
  %x34 = call float @llvm.fma.f32(float %x33, float %x, float 0x40289EB860000000)
  %x35 = call float @llvm.fma.f32(float %x34, float %x, float 0x40295C2900000000)
  %x36 = call float @llvm.fma.f32(float %x35, float %x, float 0x402A1999A0000000)
  %x37 = call float @llvm.fma.f32(float %x36, float %x, float 0x402AD70A40000000)
  %x38 = call float @llvm.fma.f32(float %x37, float %x, float 0x402B947AE0000000)
  %x39 = call float @llvm.fma.f32(float %x38, float %x, float 0x402C51EB80000000)
  %x40 = call float @llvm.fma.f32(float %x39, float %x, float 0x402D0F5C20000000)
  %next = add i32 %k, 1
  %more = icmp ult i32 %next, %count
  br i1 %more, label %loop, label %out
out:
  ret float %x40
}
declare float @llvm.fma.f32(float, float, float)

; All integer registers are in use around the constant: one is saved for it. No
; float register holds it from before.
; CHECK-LABEL: no_register_free:
; CHECK: #APP
; CHECK: #NO_APP
; CHECK: sw [[R:[a-z0-9]+]], [[AT:[0-9]+]](sp)
; CHECK: lui [[R]], 253133
; CHECK: addi [[R]], [[R]], -819
; CHECK: fmv.w.x [[F:f[a-z0-9]+]], [[R]]
; CHECK: lw [[R]], [[AT]](sp)
; CHECK: #APP
; CHECK: #NO_APP
define float @no_register_free(float %x) {
  %all = call { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } asm sideeffect "", "={x1},={t0},={t1},={t2},={s0},={s1},={a0},={a1},={a2},={a3},={a4},={a5},={a6},={a7},={s2},={s3},={s4},={s5},={s6},={s7},={s8},={s9},={s10},={s11},={t3},={t4},={t5},={t6},~{ft0},~{ft1},~{ft2},~{ft3},~{ft4},~{ft5},~{ft6},~{ft7},~{ft8},~{ft9},~{ft10},~{ft11},~{fs0},~{fs1},~{fs2},~{fs3},~{fs4},~{fs5},~{fs6},~{fs7},~{fs8},~{fs9},~{fs10},~{fs11},~{fa0},~{fa1},~{fa2},~{fa3},~{fa4},~{fa5},~{fa6},~{fa7}"()
  %r0 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 0
  %r1 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 1
  %r2 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 2
  %r3 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 3
  %r4 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 4
  %r5 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 5
  %r6 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 6
  %r7 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 7
  %r8 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 8
  %r9 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 9
  %r10 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 10
  %r11 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 11
  %r12 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 12
  %r13 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 13
  %r14 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 14
  %r15 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 15
  %r16 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 16
  %r17 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 17
  %r18 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 18
  %r19 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 19
  %r20 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 20
  %r21 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 21
  %r22 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 22
  %r23 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 23
  %r24 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 24
  %r25 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 25
  %r26 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 26
  %r27 = extractvalue { i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32, i32 } %all, 27
  %y = call float asm sideeffect "", "=f,f"(float 0x3FB99999A0000000)
  call void asm sideeffect "", "{x1},{t0},{t1},{t2},{s0},{s1},{a0},{a1},{a2},{a3},{a4},{a5},{a6},{a7},{s2},{s3},{s4},{s5},{s6},{s7},{s8},{s9},{s10},{s11},{t3},{t4},{t5},{t6}"(i32 %r0, i32 %r1, i32 %r2, i32 %r3, i32 %r4, i32 %r5, i32 %r6, i32 %r7, i32 %r8, i32 %r9, i32 %r10, i32 %r11, i32 %r12, i32 %r13, i32 %r14, i32 %r15, i32 %r16, i32 %r17, i32 %r18, i32 %r19, i32 %r20, i32 %r21, i32 %r22, i32 %r23, i32 %r24, i32 %r25, i32 %r26, i32 %r27)
  ret float %y
}
