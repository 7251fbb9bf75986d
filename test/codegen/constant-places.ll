; Constants take the registers that a loop leaves, the most used ones first; for
; the others the loop makes them where it uses them, and spills nothing.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O2 < %s | FileCheck %s
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O2 -pass-remarks-missed=vorion-constant < %s -o /dev/null 2>&1 | FileCheck %s --check-prefix=MISSED
; MISSED: remark: {{.*}}: a constant is made in every iteration: the loop needs all registers
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O2 -stop-after=postrapseudos -verify-machineinstrs < %s > %t

; CHECK-LABEL: few:
; CHECK: lui
; CHECK: # %loop
; CHECK-NOT: lui
; CHECK: bltu
define float @few(float %from, i32 %count) {
entry:
  br label %loop
loop:
  %x = phi float [ %from, %entry ], [ %x3, %loop ]
  %k = phi i32 [ 0, %entry ], [ %next, %loop ]
  %x1 = fmul float %x, 0x3FB99999A0000000
  %x2 = fadd float %x1, 0x3FE6666660000000
  %x3 = fmul float %x2, %x
  %next = add i32 %k, 1
  %more = icmp ult i32 %next, %count
  br i1 %more, label %loop, label %out
out:
  ret float %x3
}

; 24 values and 16 constants.
; CHECK-LABEL: many:
; CHECK: # %loop
; CHECK-NOT: (sp)
; CHECK: lui
; CHECK-NOT: (sp)
; CHECK: bltu
define float @many(ptr %p, i32 %count) {
entry:
  %a0 = getelementptr float, ptr %p, i32 0
  %v0 = load float, ptr %a0
  %a1 = getelementptr float, ptr %p, i32 1
  %v1 = load float, ptr %a1
  %a2 = getelementptr float, ptr %p, i32 2
  %v2 = load float, ptr %a2
  %a3 = getelementptr float, ptr %p, i32 3
  %v3 = load float, ptr %a3
  %a4 = getelementptr float, ptr %p, i32 4
  %v4 = load float, ptr %a4
  %a5 = getelementptr float, ptr %p, i32 5
  %v5 = load float, ptr %a5
  %a6 = getelementptr float, ptr %p, i32 6
  %v6 = load float, ptr %a6
  %a7 = getelementptr float, ptr %p, i32 7
  %v7 = load float, ptr %a7
  %a8 = getelementptr float, ptr %p, i32 8
  %v8 = load float, ptr %a8
  %a9 = getelementptr float, ptr %p, i32 9
  %v9 = load float, ptr %a9
  %a10 = getelementptr float, ptr %p, i32 10
  %v10 = load float, ptr %a10
  %a11 = getelementptr float, ptr %p, i32 11
  %v11 = load float, ptr %a11
  %a12 = getelementptr float, ptr %p, i32 12
  %v12 = load float, ptr %a12
  %a13 = getelementptr float, ptr %p, i32 13
  %v13 = load float, ptr %a13
  %a14 = getelementptr float, ptr %p, i32 14
  %v14 = load float, ptr %a14
  %a15 = getelementptr float, ptr %p, i32 15
  %v15 = load float, ptr %a15
  %a16 = getelementptr float, ptr %p, i32 16
  %v16 = load float, ptr %a16
  %a17 = getelementptr float, ptr %p, i32 17
  %v17 = load float, ptr %a17
  %a18 = getelementptr float, ptr %p, i32 18
  %v18 = load float, ptr %a18
  %a19 = getelementptr float, ptr %p, i32 19
  %v19 = load float, ptr %a19
  %a20 = getelementptr float, ptr %p, i32 20
  %v20 = load float, ptr %a20
  %a21 = getelementptr float, ptr %p, i32 21
  %v21 = load float, ptr %a21
  %a22 = getelementptr float, ptr %p, i32 22
  %v22 = load float, ptr %a22
  %a23 = getelementptr float, ptr %p, i32 23
  %v23 = load float, ptr %a23
  br label %loop
loop:
  %x0 = phi float [ %v0, %entry ], [ %y0, %loop ]
  %x1 = phi float [ %v1, %entry ], [ %y1, %loop ]
  %x2 = phi float [ %v2, %entry ], [ %y2, %loop ]
  %x3 = phi float [ %v3, %entry ], [ %y3, %loop ]
  %x4 = phi float [ %v4, %entry ], [ %y4, %loop ]
  %x5 = phi float [ %v5, %entry ], [ %y5, %loop ]
  %x6 = phi float [ %v6, %entry ], [ %y6, %loop ]
  %x7 = phi float [ %v7, %entry ], [ %y7, %loop ]
  %x8 = phi float [ %v8, %entry ], [ %y8, %loop ]
  %x9 = phi float [ %v9, %entry ], [ %y9, %loop ]
  %x10 = phi float [ %v10, %entry ], [ %y10, %loop ]
  %x11 = phi float [ %v11, %entry ], [ %y11, %loop ]
  %x12 = phi float [ %v12, %entry ], [ %y12, %loop ]
  %x13 = phi float [ %v13, %entry ], [ %y13, %loop ]
  %x14 = phi float [ %v14, %entry ], [ %y14, %loop ]
  %x15 = phi float [ %v15, %entry ], [ %y15, %loop ]
  %x16 = phi float [ %v16, %entry ], [ %y16, %loop ]
  %x17 = phi float [ %v17, %entry ], [ %y17, %loop ]
  %x18 = phi float [ %v18, %entry ], [ %y18, %loop ]
  %x19 = phi float [ %v19, %entry ], [ %y19, %loop ]
  %x20 = phi float [ %v20, %entry ], [ %y20, %loop ]
  %x21 = phi float [ %v21, %entry ], [ %y21, %loop ]
  %x22 = phi float [ %v22, %entry ], [ %y22, %loop ]
  %x23 = phi float [ %v23, %entry ], [ %y23, %loop ]
  %k = phi i32 [ 0, %entry ], [ %next, %loop ]
  %y0 = call float @llvm.fma.f32(float %x0, float %x0, float 0x3FB99999A0000000)
  %y1 = call float @llvm.fma.f32(float %x1, float %x1, float 0x3FDE147AE0000000)
  %y2 = call float @llvm.fma.f32(float %x2, float %x2, float 0x3FEAE147A0000000)
  %y3 = call float @llvm.fma.f32(float %x3, float %x3, float 0x3FF35C2900000000)
  %y4 = call float @llvm.fma.f32(float %x4, float %x4, float 0x3FF947AE20000000)
  %y5 = call float @llvm.fma.f32(float %x5, float %x5, float 0x3FFF333340000000)
  %y6 = call float @llvm.fma.f32(float %x6, float %x6, float 0x40028F5C20000000)
  %y7 = call float @llvm.fma.f32(float %x7, float %x7, float 0x4005851EC0000000)
  %y8 = call float @llvm.fma.f32(float %x8, float %x8, float 0x40087AE140000000)
  %y9 = call float @llvm.fma.f32(float %x9, float %x9, float 0x400B70A3E0000000)
  %y10 = call float @llvm.fma.f32(float %x10, float %x10, float 0x400E666660000000)
  %y11 = call float @llvm.fma.f32(float %x11, float %x11, float 0x4010AE1480000000)
  %y12 = call float @llvm.fma.f32(float %x12, float %x12, float 0x401228F5C0000000)
  %y13 = call float @llvm.fma.f32(float %x13, float %x13, float 0x4013A3D700000000)
  %y14 = call float @llvm.fma.f32(float %x14, float %x14, float 0x40151EB860000000)
  %y15 = call float @llvm.fma.f32(float %x15, float %x15, float 0x40169999A0000000)
  %y16 = call float @llvm.fma.f32(float %x16, float %x16, float 0x3FB99999A0000000)
  %y17 = call float @llvm.fma.f32(float %x17, float %x17, float 0x3FDE147AE0000000)
  %y18 = call float @llvm.fma.f32(float %x18, float %x18, float 0x3FEAE147A0000000)
  %y19 = call float @llvm.fma.f32(float %x19, float %x19, float 0x3FF35C2900000000)
  %y20 = call float @llvm.fma.f32(float %x20, float %x20, float 0x3FF947AE20000000)
  %y21 = call float @llvm.fma.f32(float %x21, float %x21, float 0x3FFF333340000000)
  %y22 = call float @llvm.fma.f32(float %x22, float %x22, float 0x40028F5C20000000)
  %y23 = call float @llvm.fma.f32(float %x23, float %x23, float 0x4005851EC0000000)
  %next = add i32 %k, 1
  %more = icmp ult i32 %next, %count
  br i1 %more, label %loop, label %out
out:
  %s0 = fadd float %y0, 0.0
  %s1 = fadd float %s0, %y1
  %s2 = fadd float %s1, %y2
  %s3 = fadd float %s2, %y3
  %s4 = fadd float %s3, %y4
  %s5 = fadd float %s4, %y5
  %s6 = fadd float %s5, %y6
  %s7 = fadd float %s6, %y7
  %s8 = fadd float %s7, %y8
  %s9 = fadd float %s8, %y9
  %s10 = fadd float %s9, %y10
  %s11 = fadd float %s10, %y11
  %s12 = fadd float %s11, %y12
  %s13 = fadd float %s12, %y13
  %s14 = fadd float %s13, %y14
  %s15 = fadd float %s14, %y15
  %s16 = fadd float %s15, %y16
  %s17 = fadd float %s16, %y17
  %s18 = fadd float %s17, %y18
  %s19 = fadd float %s18, %y19
  %s20 = fadd float %s19, %y20
  %s21 = fadd float %s20, %y21
  %s22 = fadd float %s21, %y22
  %s23 = fadd float %s22, %y23
  ret float %s23
}
declare float @llvm.fma.f32(float, float, float)
