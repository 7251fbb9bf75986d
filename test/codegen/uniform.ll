; Branches that all lanes take alike are left alone.
; REQUIRES: vorion-llc
; RUN: vorion-llc -mtriple=riscv32 -mcpu=vorion < %s | FileCheck %s

declare i32 @vorion.vx_warp_id() convergent
declare i32 @vorion.vx_vote_any(i32) convergent
declare i32 @vorion.vx_uniform(i32) convergent
declare void @sink(i32)

; A CSR that lanes share.
; CHECK-LABEL: shared_csr:
; CHECK-NOT: vx_split
; CHECK: ret
define void @shared_csr() {
  %w = call i32 @vorion.vx_warp_id()
  %c = icmp eq i32 %w, 0
  br i1 %c, label %a, label %end
a:
  call void @sink(i32 1)
  br label %end
end:
  ret void
}

; A vote makes a uniform value of a divergent one.
; CHECK-LABEL: vote:
; CHECK-NOT: vx_split
; CHECK: ret
define void @vote(i32 %x) {
  %w = call i32 @vorion.vx_vote_any(i32 %x)
  %c = icmp eq i32 %w, 0
  br i1 %c, label %a, label %end
a:
  call void @sink(i32 1)
  br label %end
end:
  ret void
}

; So does the programmer.
; CHECK-LABEL: asserted:
; CHECK-NOT: vx_split
; CHECK: ret
define void @asserted(i32 %x) {
  %w = call i32 @vorion.vx_uniform(i32 %x)
  %c = icmp eq i32 %w, 0
  br i1 %c, label %a, label %end
a:
  call void @sink(i32 1)
  br label %end
end:
  ret void
}

; Arguments of an ordinary function may differ between lanes.
; CHECK-LABEL: ordinary:
; CHECK: vx_split
define void @ordinary(ptr %p) {
  %x = load i32, ptr %p
  %c = icmp eq i32 %x, 0
  br i1 %c, label %a, label %end
a:
  call void @sink(i32 1)
  br label %end
end:
  ret void
}

; Those of a work-group function do not, nor does what they point to.
; CHECK-LABEL: kernel:
; CHECK-NOT: vx_split
; CHECK: ret
define void @kernel(ptr %p) "vorion-kernel" {
  %x = load i32, ptr %p
  %c = icmp eq i32 %x, 0
  br i1 %c, label %a, label %end
a:
  call void @sink(i32 1)
  br label %end
end:
  ret void
}

; CHECK-LABEL: _pocl_kernel_k_workgroup:
; CHECK-NOT: vx_split
; CHECK: ret
define void @_pocl_kernel_k_workgroup(ptr %p) {
  %x = load i32, ptr %p
  %c = icmp eq i32 %x, 0
  br i1 %c, label %a, label %end
a:
  call void @sink(i32 1)
  br label %end
end:
  ret void
}

; Every lane has its own stack.
; CHECK-LABEL: stack:
; CHECK: vx_split
define void @stack(ptr %p) "vorion-kernel" {
  %slot = alloca i32
  call void @sink_ptr(ptr %slot)
  %x = load i32, ptr %slot
  %c = icmp eq i32 %x, 0
  br i1 %c, label %a, label %end
a:
  call void @sink(i32 1)
  br label %end
end:
  ret void
}
declare void @sink_ptr(ptr)

; A frozen value of a loop, all of whose parts are defined, is as uniform as they are.
; CHECK-LABEL: frozen_in_loop:
; CHECK-NOT: vx_split
; CHECK: ret
define void @frozen_in_loop(i32 %n) "vorion-kernel" {
  br label %loop
loop:
  %i = phi i32 [ 0, %0 ], [ %next, %latch ]
  %frozen = freeze i32 %i
  %odd = trunc i32 %frozen to i1
  br i1 %odd, label %a, label %latch
a:
  call void @sink(i32 %i)
  br label %latch
latch:
  %double = shl i32 %i, 1
  %next = xor i32 %double, %n
  %more = icmp ult i32 %next, %n
  br i1 %more, label %loop, label %end
end:
  ret void
}

; A frozen value that is undefined for some lanes differs between lanes.
; CHECK-LABEL: frozen:
; CHECK: vx_split
; CHECK: vx_split
define void @frozen() "vorion-kernel" {
  %lane = call i32 @vorion.vx_thread_id()
  %odd = trunc i32 %lane to i1
  br i1 %odd, label %a, label %join
a:
  %warp = call i32 @vorion.vx_warp_id()
  br label %join
join:
  %part = phi i32 [ %warp, %a ], [ undef, %0 ]
  %frozen = freeze i32 %part
  %c = icmp eq i32 %frozen, 0
  br i1 %c, label %b, label %end
b:
  call void @sink(i32 1)
  br label %end
end:
  ret void
}
declare i32 @vorion.vx_thread_id() convergent
