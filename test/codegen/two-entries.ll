; A loop with two entries gets one, whose branch says where to go on; lanes that
; part there meet only after a backedge, so its ends become one, too.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion < %s | FileCheck %s

declare void @a()
declare void @b()

; CHECK-LABEL: two_entries:
; CHECK: csrr [[MASK:s[0-9]+]], vx_active_threads
; CHECK: vx_pred {{.*}}, [[MASK]]
; CHECK: ret
define void @two_entries(i1 %c, i32 %n) "vorion-kernel" {
entry:
  %old = atomicrmw add ptr null, i32 1 monotonic
  %odd = trunc i32 %old to i1
  br i1 %odd, label %first, label %second
first:
  %j = phi i32 [ 5, %entry ], [ %next, %second ]
  call void @a()
  br label %second
second:
  %i = phi i32 [ 0, %entry ], [ %j, %first ]
  call void @b()
  %next = add i32 %i, 1
  %more = icmp ult i32 %next, %n
  br i1 %more, label %first, label %end
end:
  ret void
}
