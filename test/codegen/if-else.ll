; A divergent if/else: one split, both sides, one join; the branch follows the split.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion < %s | FileCheck %s

declare i32 @vorion.vx_thread_id() convergent
declare void @sink(i32)
declare void @other(i32)

; CHECK-LABEL: if_else:
; CHECK: csrr [[T:a[0-9]]], vx_thread_id
; CHECK: vx_split [[TOKEN:s[0-9]+]], {{.*}}
; CHECK-NEXT: {{b(eq|ne)z}}
; CHECK: call sink
; CHECK: call other
; CHECK: vx_join [[TOKEN]]
; CHECK-NOT: vx_{{split|join}}
; CHECK: ret
define void @if_else() {
  %lane = call i32 @vorion.vx_thread_id()
  %low = and i32 %lane, 1
  %odd = icmp ne i32 %low, 0
  br i1 %odd, label %a, label %b
a:
  call void @sink(i32 1)
  br label %end
b:
  call void @other(i32 2)
  br label %end
end:
  ret void
}

; Splits nest; the inner join comes first.
; CHECK-LABEL: nested:
; CHECK: vx_split [[OUTER:s[0-9]+]]
; CHECK: vx_split [[INNER:s[0-9]+]]
; CHECK: vx_join [[INNER]]
; CHECK: vx_join [[OUTER]]
define void @nested() {
  %lane = call i32 @vorion.vx_thread_id()
  %c = icmp ult i32 %lane, 8
  br i1 %c, label %a, label %end
a:
  %d = icmp ult i32 %lane, 4
  br i1 %d, label %b, label %c1
b:
  call void @sink(i32 1)
  br label %c1
c1:
  call void @sink(i32 2)
  br label %end
end:
  ret void
}
