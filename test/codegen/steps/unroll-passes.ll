; A round has several passes over a group if a pass is short.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-unroll-passes -S < %s | FileCheck %s --check-prefix=MARK
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes='vorion-unroll-passes,loop-unroll<O2>' -S < %s | FileCheck %s
; MARK-LABEL: @short(
; MARK: br i1 {{.*}}!llvm.loop [[SHORT:![0-9]+]]
; MARK-LABEL: @long(
; MARK: br i1 {{.*}}!llvm.loop [[LONG:![0-9]+]]
; MARK-LABEL: @unknown(
; MARK: br i1 {{.*}}!llvm.loop [[LONG]]
; MARK-DAG: [[SHORT]] = distinct !{[[SHORT]], [[OURS:![0-9]+]], [[COUNT:![0-9]+]]}
; MARK-DAG: [[OURS]] = !{!"vorion.passes"}
; MARK-DAG: [[COUNT]] = !{!"llvm.loop.unroll.count", i32 8}
; MARK-DAG: [[LONG]] = distinct !{[[LONG]], [[NO:![0-9]+]], [[OURS]]}
; MARK-DAG: [[NO]] = !{!"llvm.loop.unroll.disable"}

; CHECK-LABEL: @short(
; CHECK-COUNT-8: store float
; CHECK-NOT: store float
; CHECK-LABEL: @long(
; CHECK-COUNT-1: call float @llvm.fma.f32
; CHECK-LABEL: @unknown(
; CHECK-COUNT-1: store float
; CHECK-NOT: store float

define void @short(ptr %p) {
entry:
  br label %pass
pass:
  %base = phi i32 [ 0, %entry ], [ %next, %pass ]
  %q = getelementptr float, ptr %p, i32 %base
  %x = load float, ptr %q, align 4
  %y = fadd float %x, %x
  store float %y, ptr %q, align 4
  %next = add nuw nsw i32 %base, 16
  %more = icmp ult i32 %next, 256
  br i1 %more, label %pass, label %end, !llvm.loop !0
end:
  ret void
}

define void @long(ptr %p) {
entry:
  br label %pass
pass:
  %base = phi i32 [ 0, %entry ], [ %next, %pass ]
  %q = getelementptr float, ptr %p, i32 %base
  %x = load float, ptr %q, align 4
  %v0 = fmul float %x, %x
  %v1 = fmul float %v0, %x
  %v2 = fmul float %v1, %x
  %v3 = fmul float %v2, %x
  %v4 = fmul float %v3, %x
  %v5 = fmul float %v4, %x
  %v6 = fmul float %v5, %x
  %v7 = fmul float %v6, %x
  %v8 = fmul float %v7, %x
  %v9 = fmul float %v8, %x
  %v10 = fmul float %v9, %x
  %v11 = fmul float %v10, %x
  %v12 = fmul float %v11, %x
  %v13 = fmul float %v12, %x
  %v14 = fmul float %v13, %x
  %v15 = fmul float %v14, %x
  %v16 = fmul float %v15, %x
  %v17 = fmul float %v16, %x
  %v18 = fmul float %v17, %x
  %v19 = fmul float %v18, %x
  %v20 = fmul float %v19, %x
  %v21 = fmul float %v20, %x
  %v22 = fmul float %v21, %x
  %v23 = fmul float %v22, %x
  %v24 = fmul float %v23, %x
  %v25 = fmul float %v24, %x
  %v26 = fmul float %v25, %x
  %v27 = fmul float %v26, %x
  %v28 = fmul float %v27, %x
  %v29 = fmul float %v28, %x
  %v30 = fmul float %v29, %x
  %v31 = fmul float %v30, %x
  %y = call float @llvm.fma.f32(float %v31, float %x, float %x)
  store float %y, ptr %q, align 4
  %next = add nuw nsw i32 %base, 16
  %more = icmp ult i32 %next, 256
  br i1 %more, label %pass, label %end, !llvm.loop !0
end:
  ret void
}

define void @unknown(ptr %p, i32 %n) {
entry:
  br label %pass
pass:
  %base = phi i32 [ 0, %entry ], [ %next, %pass ]
  %q = getelementptr float, ptr %p, i32 %base
  %x = load float, ptr %q, align 4
  %y = fadd float %x, %x
  store float %y, ptr %q, align 4
  %next = add nuw nsw i32 %base, 16
  %more = icmp ult i32 %next, %n
  br i1 %more, label %pass, label %end, !llvm.loop !0
end:
  ret void
}

declare float @llvm.fma.f32(float, float, float)

!0 = distinct !{!0, !1, !2}
!1 = !{!"llvm.loop.unroll.disable"}
!2 = !{!"vorion.passes"}
