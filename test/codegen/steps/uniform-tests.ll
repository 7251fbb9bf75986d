; A comparison whose sides differ between lanes by the same distance is marked: lanes agree in it.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-uniform-tests -S < %s | FileCheck %s
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-uniform-tests -pass-remarks=vorion -S < %s 2>&1 >/dev/null | FileCheck %s --check-prefix=SAID --implicit-check-not=remark:
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-uniform-tests -vorion-uniform-tests=false -S < %s | FileCheck %s --check-prefix=OFF
; OFF-NOT: vorion.uniform
; SAID: remark: {{.*}}: lanes differ in both sides of this comparison by the same distance, so all agree in it: no vx_split
; CHECK-LABEL: @walk(
; CHECK: icmp eq ptr %next, %end, !vorion.uniform
; CHECK-LABEL: @apart(
; CHECK: icmp eq ptr %next, %end{{$}}
define void @walk(ptr %p) {
entry:
  %end = getelementptr i8, ptr %p, i32 64
  br label %loop
loop:
  %at = phi ptr [ %p, %entry ], [ %next, %loop ]
  store i32 1, ptr %at
  %next = getelementptr i8, ptr %at, i32 4
  %done = icmp eq ptr %next, %end
  br i1 %done, label %out, label %loop
out:
  ret void
}

define void @apart(ptr %p, ptr %end) {
entry:
  br label %loop
loop:
  %at = phi ptr [ %p, %entry ], [ %next, %loop ]
  store i32 1, ptr %at
  %next = getelementptr i8, ptr %at, i32 4
  %done = icmp eq ptr %next, %end
  br i1 %done, label %out, label %loop
out:
  ret void
}
