; `if (a && b) X; else Y;`: Y is reached from both conditions, so lanes come there
; with one split open or with two. They meet behind both; on the paths without
; the second split its token is the depth, which makes its join do nothing. This is
; so where Y is too short for lanes to wait in front of it (reconvergence.ll).
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -vorion-reconverge=false < %s | FileCheck %s

declare i32 @vorion.vx_thread_id() convergent
declare void @sink(i32)

; CHECK-LABEL: and_then:
; CHECK: vx_split [[FIRST:s[0-9]+]], {{[^z]}}
; CHECK: vx_split [[SECOND:s[0-9]+]], zero
; CHECK: call sink
; CHECK: vx_split [[SECOND]], {{[^z]}}
; CHECK: vx_join [[SECOND]]
; CHECK-NEXT: vx_join [[FIRST]]
define void @and_then() {
  %lane = call i32 @vorion.vx_thread_id()
  %a = icmp ult i32 %lane, 8
  br i1 %a, label %second, label %no
second:
  call void @sink(i32 0)
  %low = and i32 %lane, 1
  %b = icmp eq i32 %low, 0
  br i1 %b, label %yes, label %no
yes:
  call void @sink(i32 1)
  br label %end
no:
  call void @sink(i32 2)
  br label %end
end:
  ret void
}

; Lanes pass `shared` in two passes, between which the word may have changed: what
; they load there is not uniform behind it although its address is.
; CHECK-LABEL: loaded_in_passes:
; CHECK-COUNT-4: vx_split
define void @loaded_in_passes(ptr %word) "vorion-kernel" {
  %lane = call i32 @vorion.vx_thread_id()
  %a = icmp ult i32 %lane, 8
  br i1 %a, label %second, label %shared
second:
  call void @sink(i32 0)
  %low = and i32 %lane, 1
  %b = icmp eq i32 %low, 0
  br i1 %b, label %yes, label %shared
yes:
  call void @sink(i32 1)
  br label %end
shared:
  %v = load i32, ptr %word
  call void @sink(i32 2)
  %c = icmp eq i32 %v, 0
  br i1 %c, label %third, label %end
third:
  call void @sink(i32 3)
  br label %end
end:
  ret void
}
