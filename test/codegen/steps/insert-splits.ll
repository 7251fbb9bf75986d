; vx_split before a branch that lanes part at, vx_join where they meet; vx_pred where they leave a loop; nothing where they agree.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-insert-splits -S < %s | FileCheck %s
; CHECK-LABEL: @branch(
; CHECK: %[[T:.*]] = call i32 @vorion.vx_split(
; CHECK-NEXT: br i1 %odd
; CHECK: call void @vorion.vx_join(i32 %[[T]])
; CHECK-LABEL: @loop(
; CHECK: %[[M:.*]] = call i32 @vorion.vx_active_threads()
; CHECK: call void @vorion.vx_pred{{(_n)?}}(i32 %{{.*}}, i32 %[[M]])
; CHECK-LABEL: @agree(
; CHECK-NOT: call void @vorion.vx_
; CHECK: ret void
define void @branch(i32 %x, ptr %p) {
  %odd = trunc i32 %x to i1
  br i1 %odd, label %side, label %meet
side:
  store i32 1, ptr %p
  br label %meet
meet:
  ret void
}

define void @loop(i32 %n) {
entry:
  br label %body
body:
  %i = phi i32 [ 0, %entry ], [ %next, %body ]
  %next = add i32 %i, 1
  %more = icmp slt i32 %next, %n
  br i1 %more, label %body, label %out
out:
  ret void
}

declare i32 @vorion.vx_warp_id()
define void @agree(ptr %p) {
  %warp = call i32 @vorion.vx_warp_id()
  %odd = trunc i32 %warp to i1
  br i1 %odd, label %side, label %meet
side:
  store i32 1, ptr %p
  br label %meet
meet:
  ret void
}
