; A loop that ends at an address needs no predicate where lanes agree in the
; distance; it does where their distances differ, and behind a loop that lanes
; leave one by one.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O2 -disable-lsr < %s | FileCheck %s
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O2 < %s | FileCheck %s --check-prefix=REDUCED
declare i32 @vorion.vx_thread_id()

; CHECK-LABEL: same_distance:
; CHECK-NOT: vx_
; CHECK: bne
; CHECK-NOT: vx_
; CHECK: ret
define float @same_distance(ptr %p) {
entry:
  %end = getelementptr i8, ptr %p, i32 64
  br label %loop
loop:
  %at = phi ptr [ %p, %entry ], [ %next, %loop ]
  %sum = phi float [ 0.0, %entry ], [ %more, %loop ]
  %v = load float, ptr %at
  %more = fadd float %sum, %v
  %next = getelementptr i8, ptr %at, i32 4
  %done = icmp eq ptr %next, %end
  br i1 %done, label %out, label %loop
out:
  ret float %more
}

; CHECK-LABEL: other_distance:
; CHECK: vx_pred
; CHECK: ret
define float @other_distance(ptr %p, ptr %end) {
entry:
  br label %loop
loop:
  %at = phi ptr [ %p, %entry ], [ %next, %loop ]
  %sum = phi float [ 0.0, %entry ], [ %more, %loop ]
  %v = load float, ptr %at
  %more = fadd float %sum, %v
  %next = getelementptr i8, ptr %at, i32 4
  %done = icmp eq ptr %next, %end
  br i1 %done, label %out, label %loop
out:
  ret float %more
}

; %k counts what a lane has done in a loop of its own.
; CHECK-LABEL: behind_a_loop:
; CHECK: vx_pred
; CHECK: vx_split
; CHECK: ret
define i32 @behind_a_loop(i32 %n, ptr %p) {
entry:
  br label %loop
loop:
  %k = phi i32 [ 0, %entry ], [ %k1, %loop ]
  %k1 = add i32 %k, 1
  %slot = getelementptr i32, ptr %p, i32 %k
  store i32 %n, ptr %slot
  %more = icmp ult i32 %k1, %n
  br i1 %more, label %loop, label %behind
behind:
  %seven = icmp eq i32 %k1, 7
  br i1 %seven, label %side, label %out
side:
  store i32 %n, ptr %p
  br label %out
out:
  ret i32 0
}

; Strength reduction needs no counter beside a lane's address.
; REDUCED-LABEL: counted:
; REDUCED: flw
; REDUCED-NEXT: addi
; REDUCED-NEXT: fadd.s
; REDUCED-NEXT: bne
; REDUCED-NOT: vx_
; REDUCED: ret
define float @counted(ptr %p) {
entry:
  %lane = call i32 @vorion.vx_thread_id()
  %own = getelementptr float, ptr %p, i32 %lane
  br label %loop
loop:
  %i = phi i32 [ 0, %entry ], [ %i.next, %loop ]
  %sum = phi float [ 0.0, %entry ], [ %more, %loop ]
  %row = shl i32 %i, 4
  %at = getelementptr float, ptr %own, i32 %row
  %v = load float, ptr %at
  %more = fadd float %sum, %v
  %i.next = add nuw nsw i32 %i, 1
  %done = icmp eq i32 %i.next, 16
  br i1 %done, label %out, label %loop
out:
  ret float %more
}
