; Selects and rounding are straight code without Zicond, and bit operations without Zbb.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mattr=+m,+f,+xvortex < %s | FileCheck %s
; RUN: vorion-llc -O0 -mtriple=riscv32 -mattr=+m,+f,+xvortex < %s | FileCheck %s

; CHECK-NOT: czero
; CHECK-NOT: {{^[ \t]b}}
; CHECK-LABEL: select_int:
; CHECK: ret
define i32 @select_int(i1 %c, i32 %a, i32 %b) {
  %r = select i1 %c, i32 %a, i32 %b
  ret i32 %r
}

; The sides' difference, masked by the condition, turns the one into the other.
; CHECK-LABEL: select_float:
; CHECK: flt.s
; CHECK: neg
; CHECK: xor
; CHECK: and
; CHECK: xor
; CHECK-NOT: {{^[ \t]b}}
; CHECK: ret
define float @select_float(float %x, float %a, float %b) {
  %c = fcmp ogt float %x, 1.0
  %r = select i1 %c, float %a, float %b
  ret float %r
}

; CHECK-LABEL: rounding:
; CHECK-NOT: {{^[ \t]b}}
; CHECK: ret
define float @rounding(float %x) {
  %r = call float @llvm.floor.f32(float %x)
  ret float %r
}

; CHECK-LABEL: smallest_and_count:
; CHECK-NOT: czero
; CHECK-NOT: {{^[ \t]b}}
; CHECK: ret
define i64 @smallest_and_count(i64 %a, i64 %b) {
  %m = call i64 @llvm.umin.i64(i64 %a, i64 %b)
  %n = call i64 @llvm.ctlz.i64(i64 %m, i1 false)
  ret i64 %n
}
