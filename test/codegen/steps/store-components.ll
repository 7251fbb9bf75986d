; Of a vector in memory only the components that are assigned are stored: other
; lanes may write the others at the same time.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-store-components -S < %s | FileCheck %s
; It is the first step of compilation, also where nothing is optimised.
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes='default<O0>' -S < %s | FileCheck %s
; RUN: vorion-opt -mtriple=riscv32 -passes=vorion-store-components -S < %s | FileCheck %s --check-prefix=OTHER

; CHECK-LABEL: define void @one(
; CHECK-NEXT: %[[AT:.*]] = getelementptr inbounds i32, ptr %p, i32 2
; CHECK-NEXT: store i32 %x, ptr %[[AT]], align 8
; CHECK-NEXT: ret void
; OTHER-LABEL: define void @one(
; OTHER: store <4 x i32>
define void @one(ptr %p, i32 %x) {
  %v = load <4 x i32>, ptr %p, align 16
  %w = insertelement <4 x i32> %v, i32 %x, i32 2
  store <4 x i32> %w, ptr %p, align 16
  ret void
}

; o.zx = x
; CHECK-LABEL: define void @two(
; CHECK: extractelement <2 x float> %x, i64 1
; CHECK: store float %{{.*}}, ptr %{{.*}}, align 16
; CHECK: extractelement <2 x float> %x, i64 0
; CHECK: store float %{{.*}}, ptr %{{.*}}, align 8
; CHECK-NEXT: ret void
define void @two(ptr %p, <2 x float> %x) {
  %v = load <4 x float>, ptr %p, align 16
  %y = shufflevector <2 x float> %x, <2 x float> poison, <4 x i32> <i32 0, i32 1, i32 poison, i32 poison>
  %w = shufflevector <4 x float> %v, <4 x float> %y, <4 x i32> <i32 5, i32 1, i32 4, i32 3>
  store <4 x float> %w, ptr %p, align 16
  ret void
}

; o[i] = x
; CHECK-LABEL: define void @any(
; CHECK-NEXT: %[[AT:.*]] = getelementptr inbounds i8, ptr %p, i32 %i
; CHECK-NEXT: store i8 %x, ptr %[[AT]], align 1
; CHECK-NEXT: ret void
define void @any(ptr %p, i8 %x, i32 %i) {
  %v = load <4 x i8>, ptr %p, align 4
  %w = insertelement <4 x i8> %v, i8 %x, i32 %i
  store <4 x i8> %w, ptr %p, align 4
  ret void
}

; CHECK-LABEL: define void @volatile(
; CHECK: load volatile <4 x i32>
; CHECK: store volatile i32 %x, ptr %{{.*}}, align 4
; CHECK-NEXT: ret void
define void @volatile(ptr %p, i32 %x) {
  %v = load volatile <4 x i32>, ptr %p, align 16
  %w = insertelement <4 x i32> %v, i32 %x, i32 1
  store volatile <4 x i32> %w, ptr %p, align 16
  ret void
}

; All are assigned: one store.
; CHECK-LABEL: define void @all(
; CHECK: store <2 x i32>
define void @all(ptr %p) {
  %v = load <2 x i32>, ptr %p, align 8
  %w = shufflevector <2 x i32> %v, <2 x i32> poison, <2 x i32> <i32 1, i32 0>
  store <2 x i32> %w, ptr %p, align 8
  ret void
}

; A variable of the lane itself.
; CHECK-LABEL: define i32 @private(
; CHECK: store <4 x i32> %w
define i32 @private(i32 %x) {
  %p = alloca <4 x i32>, align 16
  %v = load <4 x i32>, ptr %p, align 16
  %w = insertelement <4 x i32> %v, i32 %x, i32 2
  store <4 x i32> %w, ptr %p, align 16
  %r = load i32, ptr %p
  ret i32 %r
}

; What was written in between goes back to what it was.
; CHECK-LABEL: define void @between(
; CHECK: store <4 x i32> %w
define void @between(ptr %p, ptr %q, i32 %x) {
  %v = load <4 x i32>, ptr %p, align 16
  store i32 %x, ptr %q
  %w = insertelement <4 x i32> %v, i32 %x, i32 2
  store <4 x i32> %w, ptr %p, align 16
  ret void
}

; Another vector.
; CHECK-LABEL: define void @other(
; CHECK: store <4 x i32> %w
define void @other(ptr %p, ptr %q, i32 %x) {
  %v = load <4 x i32>, ptr %q, align 16
  %w = insertelement <4 x i32> %v, i32 %x, i32 2
  store <4 x i32> %w, ptr %p, align 16
  ret void
}
