; Lanes that part before a dead end meet where those that do not go there meet,
; before the barrier, and not only at the function's end.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion < %s 2>%t | FileCheck %s
; RUN: FileCheck --allow-empty --check-prefix=WARNED %s < %t
; WARNED-NOT: {{.}}

declare i32 @vorion.vx_thread_id()
declare void @vorion.vx_bar(i32, i32)
declare void @llvm.trap()
declare void @side()

; CHECK-LABEL: endless_loop:
; CHECK: vx_split [[OUTER:[a-z0-9]+]],
; CHECK: vx_join [[OUTER]]
; CHECK: vx_bar
define void @endless_loop(i32 %n) "vorion-kernel" {
entry:
  %l = call i32 @vorion.vx_thread_id()
  %part = icmp ult i32 %l, 7
  br i1 %part, label %some, label %others
some:
  call void @side()
  %never = icmp ugt i32 %l, %n
  br i1 %never, label %loop, label %meet
loop:
  call void @side()
  br label %loop
others:
  call void @side()
  call void @side()
  br label %meet
meet:
  call void @vorion.vx_bar(i32 0, i32 1)
  ret void
}

; CHECK-LABEL: unreachable:
; CHECK: vx_split [[OUTER:[a-z0-9]+]],
; CHECK: vx_join [[OUTER]]
; CHECK: vx_bar
define i32 @unreachable(i32 %n) "vorion-kernel" {
entry:
  %l = call i32 @vorion.vx_thread_id()
  %part = icmp ult i32 %l, 7
  br i1 %part, label %some, label %others
some:
  call void @side()
  %never = icmp ugt i32 %l, %n
  br i1 %never, label %dead, label %meet
dead:
  call void @llvm.trap()
  unreachable
others:
  call void @side()
  call void @side()
  br label %meet
meet:
  %v = phi i32 [ 3, %some ], [ %l, %others ]
  call void @vorion.vx_bar(i32 0, i32 1)
  ret i32 %v
}

; A function of which nothing returns.
; CHECK-LABEL: never_returns:
; CHECK: unimp
define void @never_returns(i32 %n) "vorion-kernel" {
entry:
  %l = call i32 @vorion.vx_thread_id()
  %part = icmp ult i32 %l, %n
  br i1 %part, label %loop, label %dead
loop:
  call void @side()
  br label %loop
dead:
  call void @llvm.trap()
  unreachable
}

; Code that the source calls unreachable traps; what a call does not return to needs no trap.
; CHECK-LABEL: traps:
; CHECK: unimp
; CHECK: ret
define i32 @traps(i32 %n) {
  %c = icmp eq i32 %n, 3
  br i1 %c, label %dead, label %end
dead:
  call void @side()
  unreachable
end:
  ret i32 %n
}

declare void @stop() noreturn
; CHECK-LABEL: does_not_return:
; CHECK-NOT: unimp
; CHECK: .Lfunc_end
define void @does_not_return() {
  call void @stop()
  unreachable
}
