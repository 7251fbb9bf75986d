; A static variable that is written is kept as it is for all lanes.
; REQUIRES: vorion-opt
; RUN: vorion-opt -mtriple=riscv32 -mcpu=vorion -passes=vorion-share-variables -S < %s | FileCheck %s
; CHECK: @llvm.compiler.used = appending global [1 x ptr] [ptr @shared]
@shared = internal global i32 0
@constant = internal constant i32 5
define i32 @use(i32 %x) {
  store i32 %x, ptr @shared
  %v = load i32, ptr @shared
  ret i32 %v
}
