; Read-modify-writes are one instruction or a loop around amocas.w that lanes
; leave apart; never lr.w and sc.w, between which another lane would come.
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
