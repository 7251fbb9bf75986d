; Operations that the RISC-V target otherwise expands into branches, too late for
; splits, are straight code.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion < %s | FileCheck %s
; RUN: vorion-llc -O0 -mtriple=riscv32 -mcpu=vorion < %s | FileCheck %s

; CHECK-LABEL: select_int:
; CHECK-NOT: {{^[ \t]b}}
; CHECK: czero.
; CHECK: ret
define i32 @select_int(i1 %c, i32 %a, i32 %b) {
  %r = select i1 %c, i32 %a, i32 %b
  ret i32 %r
}

; CHECK-LABEL: select_float:
; CHECK-NOT: {{^[ \t]b}}
; CHECK: czero.
; CHECK: ret
define float @select_float(float %x, float %a, float %b) {
  %c = fcmp ogt float %x, 1.0
  %r = select i1 %c, float %a, float %b
  ret float %r
}

; CHECK-LABEL: select_pointer_and_long:
; CHECK-NOT: {{^[ \t]b}}
; CHECK: ret
define i64 @select_pointer_and_long(i1 %c, ptr %p, ptr %q, i64 %a, i64 %b) {
  %r = select i1 %c, ptr %p, ptr %q
  store i32 1, ptr %r
  %s = select i1 %c, i64 %a, i64 %b
  ret i64 %s
}

; Rounding: through an integer where the magnitude is below 2^23, with the sign kept.
; CHECK-LABEL: rounding:
; CHECK-NOT: {{^[ \t]b}}
; CHECK: fcvt.w.s {{.*}}, rdn
; CHECK: fsgnj.s
; CHECK-NOT: {{^[ \t]b}}
; CHECK: fcvt.w.s {{.*}}, rup
; CHECK-NOT: {{^[ \t]b}}
; CHECK: fcvt.w.s {{.*}}, rtz
; CHECK-NOT: {{^[ \t]b}}
; CHECK: fcvt.w.s {{.*}}, rmm
; CHECK-NOT: {{^[ \t]b}}
; CHECK: fcvt.w.s {{a[0-9]+, fa[0-9]+$}}
; CHECK-NOT: {{^[ \t]b}}
; CHECK: ret
define void @rounding(ptr %p, float %x) {
  %a = call float @llvm.floor.f32(float %x)
  store volatile float %a, ptr %p
  %b = call float @llvm.ceil.f32(float %x)
  store volatile float %b, ptr %p
  %c = call float @llvm.trunc.f32(float %x)
  store volatile float %c, ptr %p
  %d = call float @llvm.round.f32(float %x)
  store volatile float %d, ptr %p
  %e = call float @llvm.rint.f32(float %x)
  store volatile float %e, ptr %p
  ret void
}

; CHECK-LABEL: extremes:
; CHECK-NOT: {{^[ \t]b}}
; CHECK: ret
define float @extremes(float %x, float %y, i32 %i, i32 %j) {
  %a = call float @llvm.minnum.f32(float %x, float %y)
  %b = call float @llvm.maximum.f32(float %a, float %y)
  %c = call i32 @llvm.smin.i32(i32 %i, i32 %j)
  %d = call i32 @llvm.uadd.sat.i32(i32 %c, i32 %j)
  %e = call i32 @llvm.fptosi.sat.i32.f32(float %b)
  %f = call i32 @llvm.abs.i32(i32 %e, i1 false)
  %g = add i32 %d, %f
  %h = call i32 @llvm.fshl.i32(i32 %g, i32 %i, i32 %j)
  %r = sitofp i32 %h to float
  %k = call float @llvm.copysign.f32(float %r, float %x)
  ret float %k
}

; Shifts of two words.
; CHECK-LABEL: long_shift:
; CHECK-NOT: {{^[ \t]b}}
; CHECK: ret
define i64 @long_shift(i64 %x, i64 %n) {
  %a = shl i64 %x, %n
  %b = ashr i64 %a, %n
  %c = lshr i64 %b, %n
  ret i64 %c
}

declare float @llvm.floor.f32(float)
declare float @llvm.ceil.f32(float)
declare float @llvm.trunc.f32(float)
declare float @llvm.round.f32(float)
declare float @llvm.rint.f32(float)
declare float @llvm.minnum.f32(float, float)
declare float @llvm.maximum.f32(float, float)
declare float @llvm.copysign.f32(float, float)
declare i32 @llvm.smin.i32(i32, i32)
declare i32 @llvm.uadd.sat.i32(i32, i32)
declare i32 @llvm.fptosi.sat.i32.f32(float)
declare i32 @llvm.abs.i32(i32, i1)
declare i32 @llvm.fshl.i32(i32, i32, i32)
