; A PHI node where two ways from a divergent branch meet is marked, however long a way is.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-divergent-joins -S < %s | FileCheck %s
; CHECK: %r = phi i1 {{.*}}, !vorion.divergent
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

declare i32 @vorion.vx_thread_id()
