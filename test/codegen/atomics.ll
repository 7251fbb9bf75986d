; Read-modify-writes are one instruction or a loop around amocas that lanes leave
; apart; never lr.w and sc.w, between which another lane would come.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion < %s | FileCheck %s --implicit-check-not=lr.w --implicit-check-not=sc.w
; RUN: vorion-llc -O0 -mtriple=riscv32 -mcpu=vorion < %s | FileCheck %s --check-prefix=O0 --implicit-check-not=lr.w --implicit-check-not=sc.w
; O0: amocas.w

; CHECK-LABEL: native:
; CHECK: amoadd.w
; CHECK: amomax.w
; CHECK: amominu.w
; CHECK: amoswap.w
; CHECK: amocas.w
; CHECK: ret
define i32 @native(ptr %p, i32 %x) {
  %a = atomicrmw add ptr %p, i32 %x monotonic
  %b = atomicrmw max ptr %p, i32 %a monotonic
  %c = atomicrmw umin ptr %p, i32 %b monotonic
  %d = atomicrmw xchg ptr %p, i32 %c monotonic
  %e = cmpxchg ptr %p, i32 %d, i32 %x monotonic monotonic
  %f = extractvalue { i32, i1 } %e, 0
  ret i32 %f
}

; CHECK-LABEL: nand:
; CHECK: amocas.w
; CHECK: vx_pred
; CHECK: ret
define i32 @nand(ptr %p, i32 %x) {
  %a = atomicrmw nand ptr %p, i32 %x monotonic
  ret i32 %a
}

; CHECK-LABEL: fadd:
; CHECK: fadd.s
; CHECK: amocas.w
; CHECK: vx_pred
; CHECK: ret
define float @fadd(ptr %p, float %x) {
  %a = atomicrmw fadd ptr %p, float %x monotonic
  ret float %a
}

; CHECK-LABEL: fmin:
; CHECK: fmin.s
; CHECK: amocas.w
; CHECK: vx_pred
; CHECK: ret
define float @fmin(ptr %p, float %x) {
  %a = atomicrmw fmin ptr %p, float %x monotonic
  ret float %a
}

; CHECK-LABEL: byte:
; CHECK: amocas.w
; CHECK: vx_pred
; CHECK: ret
define i8 @byte(ptr %p, i8 %x) {
  %a = atomicrmw add ptr %p, i8 %x monotonic
  ret i8 %a
}

; CHECK-LABEL: half_exchange:
; CHECK: amocas.w
; CHECK: ret
define i16 @half_exchange(ptr %p, i16 %x, i16 %y) {
  %a = cmpxchg ptr %p, i16 %x, i16 %y monotonic monotonic
  %b = extractvalue { i16, i1 } %a, 0
  ret i16 %b
}

; Of 64 bits all are amocas.d: a store is a loop around it, a load compares with
; 0 and writes 0.
; CHECK-LABEL: wide:
; CHECK: amocas.d.aqrl a{{[0-9]}}, a{{[0-9]}}, (a0)
; CHECK: ret
define i64 @wide(ptr %p, i64 %old, i64 %new) {
  %a = cmpxchg ptr %p, i64 %old, i64 %new seq_cst seq_cst
  %b = extractvalue { i64, i1 } %a, 0
  ret i64 %b
}

; CHECK-LABEL: wide_load:
; CHECK-NOT: lw
; CHECK: amocas.d {{[ast][0-9]+}}, zero, (a0)
; CHECK-NOT: vx_
; CHECK: ret
define i64 @wide_load(ptr %p) {
  %a = load atomic i64, ptr %p monotonic, align 8
  ret i64 %a
}

; CHECK-LABEL: wide_store:
; CHECK-NOT: sw
; CHECK: amocas.d
; CHECK: vx_pred
; CHECK: ret
define void @wide_store(ptr %p, i64 %x) {
  store atomic i64 %x, ptr %p monotonic, align 8
  ret void
}

; CHECK-LABEL: wide_change:
; CHECK: amocas.d
; CHECK: vx_pred
; CHECK: ret
define i64 @wide_change(ptr %p, i64 %x) {
  %a = atomicrmw max ptr %p, i64 %x acquire
  ret i64 %a
}

; CHECK-LABEL: wide_exchange:
; CHECK: amocas.d
; CHECK: vx_pred
; CHECK: ret
define double @wide_exchange(ptr %p, double %x) {
  %a = atomicrmw xchg ptr %p, double %x monotonic
  ret double %a
}

; Pairs that live across calls are spilled and come back.
; CHECK-LABEL: wide_spill:
; CHECK-COUNT-3: amocas.d
; CHECK: ret
declare void @other()
define i64 @wide_spill(ptr %p, i64 %x) {
  %a = cmpxchg ptr %p, i64 %x, i64 1 monotonic monotonic
  %b = extractvalue { i64, i1 } %a, 0
  call void asm sideeffect "", "~{x5},~{x6},~{x7},~{x8},~{x9},~{x18},~{x19},~{x20},~{x21},~{x22},~{x23},~{x24},~{x25},~{x26},~{x27},~{x28},~{x29},~{x30},~{x31},~{x12},~{x13},~{x14},~{x15},~{x16},~{x17}"()
  %c = cmpxchg ptr %p, i64 %b, i64 %x monotonic monotonic
  %d = extractvalue { i64, i1 } %c, 0
  call void @other()
  %e = cmpxchg ptr %p, i64 %d, i64 %b monotonic monotonic
  %f = extractvalue { i64, i1 } %e, 0
  ret i64 %f
}
