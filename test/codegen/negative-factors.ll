; A multiplication by a negative power of two, of a constant that is kept for several
; uses, was a shift by 32: upstream took the factor for one without sign.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O2 < %s | FileCheck %s

; The low half of the factor is -2^20.
; CHECK-LABEL: twice:
; CHECK: lui [[K:a[0-9]+]], 1048320
; CHECK: mul {{a[0-9]+}}, a0, [[K]]
define i64 @twice(i64 %x, i1 %both, ptr %p) {
  %y = mul i64 %x, 4503599626321920
  br i1 %both, label %more, label %end
more:
  %z = xor i64 %x, 4503599626321920
  store i64 %z, ptr %p
  br label %end
end:
  ret i64 %y
}

; CHECK-LABEL: opaque:
; CHECK: sh3add [[X:a[0-9]+]], a0, a0
; CHECK-NEXT: sub a0, a0, [[X]]
define i32 @opaque(i32 %x) {
  %k = bitcast i32 -8 to i32
  %y = mul i32 %x, %k
  ret i32 %y
}
