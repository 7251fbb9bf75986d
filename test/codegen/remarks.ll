; What our passes tell of decisions that C seldom leads to.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O2 -pass-remarks=vorion -pass-remarks-analysis=vorion-repeat < %s -o /dev/null 2>&1 | FileCheck %s
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion -O2 < %s -o /dev/null 2>&1 | count 0

; CHECK: remark: {{.*}}: divergent branch made branchless: selects and sides weigh {{[0-9]+}}, the limit is 24, against a vx_split, branches and a vx_join
define i32 @short(i32 %x, i32 %y) {
  %odd = trunc i32 %x to i1
  br i1 %odd, label %side, label %meet
side:
  %a = mul i32 %y, 3
  %b = xor i32 %a, %x
  br label %meet
meet:
  %r = phi i32 [ %b, %side ], [ %y, %0 ]
  ret i32 %r
}

; CHECK: remark: {{.*}}: both sides of a divergent branch lead here before they meet: the warp comes once for each, and reads anew
@g = global i32 0
define i32 @both(i32 %x, i32 %y, ptr %p) {
  %a = trunc i32 %x to i1
  br i1 %a, label %and, label %or
and:
  %b = trunc i32 %y to i1
  br i1 %b, label %yes, label %or
or:
  %v = load i32, ptr @g, align 4
  store i32 %v, ptr %p
  br label %meet
yes:
  store i32 7, ptr %p
  br label %meet
meet:
  ret i32 0
}

; CHECK: remark: {{.*}}: 2 instructions moved in front of a loop, behind which they had been sunk; values alive across it: -1
define float @behind(ptr %p, i32 %count) {
entry:
  %x = load float, ptr %p
  %q = getelementptr float, ptr %p, i32 1
  %y = load float, ptr %q
  br label %loop
loop:
  %at = phi float [ 1.0, %entry ], [ %next, %loop ]
  %k = phi i32 [ 0, %entry ], [ %k1, %loop ]
  %next = fmul float %at, 0.5
  %k1 = add i32 %k, 1
  %more = icmp ult i32 %k1, %count
  br i1 %more, label %loop, label %out
out:
  %xx = fmul float %x, %x
  %sum = fadd float %xx, %y
  %root = fadd float %next, %sum
  ret float %root
}
