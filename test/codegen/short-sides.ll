; Short sides of divergent branches become selects; long ones, uniform ones and
; those with effects do not.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O2 < %s | FileCheck %s
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O2 -vorion-select-sides=0 < %s | FileCheck %s --check-prefix=OFF
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O0 < %s | FileCheck %s --check-prefix=OFF
declare i32 @vorion.vx_thread_id()
declare i32 @vorion.vx_warp_id()

; CHECK-LABEL: one_side:
; CHECK-NOT: vx_split
; CHECK: czero
; CHECK: ret
; OFF-LABEL: one_side:
; OFF: vx_split
; OFF: ret
define i32 @one_side(i32 %x, i32 %y) {
  %odd = trunc i32 %x to i1
  br i1 %odd, label %side, label %meet
side:
  %a = mul i32 %y, 3
  %b = xor i32 %a, %x
  %c = add i32 %b, 7
  br label %meet
meet:
  %r = phi i32 [ %c, %side ], [ %y, %0 ]
  ret i32 %r
}

; Two sides, one of them with a condition of its own inside.
; CHECK-LABEL: nested:
; CHECK-NOT: vx_split
; CHECK: ret
define i32 @nested(i32 %x, i32 %y) {
  %odd = trunc i32 %x to i1
  br i1 %odd, label %a, label %b
a:
  %small = icmp ult i32 %y, 9
  br i1 %small, label %inner, label %end
inner:
  %more = add i32 %y, %x
  br label %end
end:
  %of = phi i32 [ %more, %inner ], [ 0, %a ]
  br label %meet
b:
  %less = sub i32 %y, %x
  br label %meet
meet:
  %r = phi i32 [ %of, %end ], [ %less, %b ]
  ret i32 %r
}

; CHECK-LABEL: stores:
; CHECK: vx_split
define void @stores(i32 %x, ptr %p) {
  %odd = trunc i32 %x to i1
  br i1 %odd, label %side, label %meet
side:
  store i32 %x, ptr %p
  br label %meet
meet:
  ret void
}

; A load might fault in a lane that did not ask for it,
; CHECK-LABEL: loads:
; CHECK: vx_split
define i32 @loads(i32 %x, ptr %p) {
  %odd = trunc i32 %x to i1
  br i1 %odd, label %side, label %meet
side:
  %v = load i32, ptr %p
  br label %meet
meet:
  %r = phi i32 [ %v, %side ], [ 0, %0 ]
  ret i32 %r
}

; but not where there is memory for certain.
; CHECK-LABEL: safe_load:
; CHECK-NOT: vx_split
; CHECK: lw
@g = global i32 5
define i32 @safe_load(i32 %x) {
  %odd = trunc i32 %x to i1
  br i1 %odd, label %side, label %meet
side:
  %v = load i32, ptr @g
  br label %meet
meet:
  %r = phi i32 [ %v, %side ], [ 0, %0 ]
  ret i32 %r
}

; A division is slow, or a library call.
; CHECK-LABEL: divides:
; CHECK: vx_split
define i64 @divides(i32 %x, i64 %y) {
  %odd = trunc i32 %x to i1
  br i1 %odd, label %side, label %meet
side:
  %v = udiv i64 %y, 7
  br label %meet
meet:
  %r = phi i64 [ %v, %side ], [ 0, %0 ]
  ret i64 %r
}

; Lanes skip a uniform side together.
; CHECK-LABEL: uniform:
; CHECK-NOT: vx_split
; CHECK: {{beqz|bnez|beq|bne}}
; CHECK-NOT: vx_join
; CHECK: ret
define i32 @uniform(i32 %y) {
  %warp = call i32 @vorion.vx_warp_id()
  %odd = trunc i32 %warp to i1
  br i1 %odd, label %side, label %meet
side:
  %a = mul i32 %y, 3
  %b = xor i32 %a, %y
  br label %meet
meet:
  %r = phi i32 [ %b, %side ], [ %y, %0 ]
  ret i32 %r
}
