; A PHI node where the sides of a divergent branch meet differs between lanes, however many blocks a side has.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -stop-after=vorion-lower-divergence < %s | FileCheck %s

; CHECK-LABEL: define void @long_side
; CHECK: meet:
; CHECK: %r = phi
; CHECK: vx_split
; CHECK-NEXT: br i1 %r, label %yes, label %no
define void @long_side(i32 %n, ptr %p) "vorion-kernel" {
entry:
  %lane = call i32 @vorion.vx_thread_id()
  %bit = and i32 %lane, 1
  %odd = icmp eq i32 %bit, 0
  br i1 %odd, label %other, label %one
one:
  store volatile i32 1, ptr %p
  %c1 = icmp ult i32 %n, 4
  br i1 %c1, label %one.a, label %one.b
one.a:
  store volatile i32 2, ptr %p
  br label %one.b
one.b:
  store volatile i32 3, ptr %p
  %c2 = icmp ult i32 %n, 5
  br i1 %c2, label %one.c, label %one.d
one.c:
  store volatile i32 4, ptr %p
  br label %one.d
one.d:
  store volatile i32 5, ptr %p
  br label %meet
other:
  store volatile i32 6, ptr %p
  %c3 = icmp ult i32 %n, 6
  br i1 %c3, label %other.a, label %other.b
other.a:
  store volatile i32 7, ptr %p
  br label %other.b
other.b:
  store volatile i32 8, ptr %p
  br label %meet
meet:
  %r = phi i1 [ true, %one.d ], [ false, %other.b ]
  br i1 %r, label %yes, label %no
yes:
  store volatile i32 9, ptr %p
  br label %end
no:
  store volatile i32 10, ptr %p
  br label %end
end:
  ret void
}

declare i32 @vorion.vx_thread_id() convergent
