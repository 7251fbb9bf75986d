; Loops that lanes leave at different times keep the leavers waiting with vx_pred.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion < %s | FileCheck %s

declare i32 @vorion.vx_thread_id() convergent
declare void @sink(i32)

; The mask is read before the loop.
; CHECK-LABEL: one_exit:
; CHECK: csrr [[MASK:s[0-9]+]], vx_active_threads
; CHECK: [[LOOP:\.LBB[0-9_]+]]:
; CHECK: call sink
; CHECK: vx_pred{{(_n)?}} {{.*}}, [[MASK]]
; CHECK-NEXT: b{{.*}}, [[LOOP]]
; CHECK-NOT: vx_
; CHECK: ret
define void @one_exit() {
entry:
  %lane = call i32 @vorion.vx_thread_id()
  br label %loop
loop:
  %i = phi i32 [ 0, %entry ], [ %next, %loop ]
  call void @sink(i32 %i)
  %next = add i32 %i, 1
  %more = icmp ult i32 %i, %lane
  br i1 %more, label %loop, label %end
end:
  ret void
}

; break: the loop gets a latch that all lanes pass, with one join before it.
; CHECK-LABEL: break:
; CHECK: csrr [[MASK:s[0-9]+]], vx_active_threads
; CHECK: vx_join [[TOKEN:s[0-9]+]]
; CHECK-NEXT: vx_pred{{(_n)?}} {{.*}}, [[MASK]]
; CHECK: vx_split [[TOKEN]]
; CHECK-NOT: vx_
; CHECK: ret
define void @break(i32 %n) "vorion-kernel" {
entry:
  %lane = call i32 @vorion.vx_thread_id()
  br label %loop
loop:
  %i = phi i32 [ 0, %entry ], [ %next, %latch ]
  %leave = icmp eq i32 %i, %lane
  br i1 %leave, label %end, label %latch
latch:
  call void @sink(i32 %i)
  %next = add i32 %i, 1
  %more = icmp ult i32 %i, %n
  br i1 %more, label %loop, label %end
end:
  ret void
}

; A loop that all lanes leave together has nothing added.
; CHECK-LABEL: together:
; CHECK-NOT: vx_
; CHECK: ret
define void @together(i32 %n) "vorion-kernel" {
entry:
  br label %loop
loop:
  %i = phi i32 [ 0, %entry ], [ %next, %loop ]
  call void @sink(i32 %i)
  %next = add i32 %i, 1
  %more = icmp ult i32 %i, %n
  br i1 %more, label %loop, label %end
end:
  ret void
}

; What a lane has at its own last iteration differs behind the loop.
; CHECK-LABEL: behind:
; CHECK: vx_pred
; CHECK: vx_split
define void @behind() "vorion-kernel" {
entry:
  %lane = call i32 @vorion.vx_thread_id()
  br label %loop
loop:
  %i = phi i32 [ 0, %entry ], [ %next, %loop ]
  call void @sink(i32 %i)
  %next = add i32 %i, 1
  %more = icmp ult i32 %i, %lane
  br i1 %more, label %loop, label %after
after:
  %c = icmp eq i32 %i, 3
  br i1 %c, label %a, label %end
a:
  call void @sink(i32 1)
  br label %end
end:
  ret void
}
