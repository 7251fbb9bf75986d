; Lanes that part wait at a hub in front of a block that both sides lead to, and a guard behind it branches there. A block of one instruction stays executed twice.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-reconverge -S < %s | FileCheck %s
declare void @work(i32)

; CHECK-LABEL: @either(
; CHECK: br i1 %a, label %hub, label %second
; CHECK: second:
; CHECK-NOT: br i1
; CHECK: hub:
; CHECK-NEXT: %taken = phi i1
; CHECK-NEXT: br i1 %taken, label %yes, label %end
define void @either(i32 %x, ptr %p) {
  %a = icmp eq i32 %x, 3
  br i1 %a, label %yes, label %second
second:
  %y = load volatile i32, ptr %p
  %b = icmp eq i32 %y, 5
  br i1 %b, label %yes, label %end
yes:
  call void @work(i32 1)
  br label %end
end:
  ret void
}

; A value that only some edges bring along is poison on the others.
; CHECK-LABEL: @values(
; CHECK: hub:
; CHECK-NEXT: %[[Y:.*]] = phi i32 [ poison, %0 ], [ %y, %second ]
; CHECK-NEXT: %taken = phi i1 [ false, %0 ], [ %b, %second ]
; CHECK: phi i32 [ %[[Y]], %yes ]
define i32 @values(i32 %x, ptr %p) {
  %a = icmp eq i32 %x, 3
  br i1 %a, label %second, label %no
second:
  %y = load volatile i32, ptr %p
  %b = icmp eq i32 %y, 5
  br i1 %b, label %yes, label %no
yes:
  call void @work(i32 %y)
  br label %end
no:
  call void @work(i32 1)
  br label %end
end:
  %r = phi i32 [ %y, %yes ], [ 7, %no ]
  ret i32 %r
}

; The cases are in front of the hub, since only the default has several edges.
; CHECK-LABEL: @default(
; CHECK-COUNT-1: hub:
; CHECK-NOT: hub{{[0-9]+}}:
; CHECK: ret void
define void @default(i32 %x, ptr %p) {
  %low = icmp slt i32 %x, 5
  br i1 %low, label %left, label %right
left:
  %is3 = icmp eq i32 %x, 3
  br i1 %is3, label %three, label %default
right:
  %is7 = icmp eq i32 %x, 7
  br i1 %is7, label %seven, label %default
three:
  store i32 3, ptr %p
  br label %end
seven:
  store i32 7, ptr %p
  br label %end
default:
  call void @work(i32 1)
  br label %end
end:
  ret void
}

; CHECK-LABEL: @short(
; CHECK-NOT: hub
; CHECK: ret void
define void @short(i32 %x, ptr %p) {
  %a = icmp eq i32 %x, 3
  br i1 %a, label %yes, label %second
second:
  %y = load volatile i32, ptr %p
  %b = icmp eq i32 %y, 5
  br i1 %b, label %yes, label %end
yes:
  store i32 1, ptr %p
  br label %end
end:
  ret void
}

; Lanes that agree have no need of one.
; CHECK-LABEL: @agree(
; CHECK-NOT: hub
; CHECK: ret void
define void @agree(i32 %x, ptr %p) "vorion-kernel" {
  %a = icmp eq i32 %x, 3
  br i1 %a, label %yes, label %second
second:
  %b = icmp eq i32 %x, 5
  br i1 %b, label %yes, label %end
yes:
  call void @work(i32 1)
  br label %end
end:
  ret void
}

; LLVM threads the second test into both sides of the first: behind the hub it is made once, for whatever form it has there.
; CHECK-LABEL: @threaded(
; CHECK: hub:
; CHECK-NEXT: %[[TEST:.*]] = icmp sge i32 %y, 0
; CHECK-NEXT: br i1 %[[TEST]], label %second, label %end
define void @threaded(i32 %x, i32 %y) {
  %a = icmp slt i32 %x, 0
  br i1 %a, label %skip, label %first
first:
  call void @work(i32 %x)
  %b = icmp slt i32 %y, 0
  br i1 %b, label %end, label %second
skip:
  %c = icmp sgt i32 %y, -1
  br i1 %c, label %second, label %end
second:
  call void @work(i32 %y)
  br label %end
end:
  ret void
}
