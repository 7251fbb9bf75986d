	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"vecadd.c"
                                        # Start of file scope inline assembly
	.globl	end_signature
.set end_signature, begin_signature+(4*2048)

                                        # End of file scope inline assembly
	.globl	main                            # -- Begin function main
	.p2align	2
	.type	main,@function
main:                                   # @main
# %bb.0:
	csrr	a0, vx_thread_id
	csrr	a1, vx_warp_id
	slli	a1, a1, 4
	li	a2, 2047
	bltu	a2, a1, .LBB0_3
# %bb.1:
	addi	a2, a0, 2047
	addi	a2, a2, 1
	lui	a3, %hi(ones)
	addi	a3, a3, %lo(ones)
	lui	a4, %hi(begin_signature)
	addi	a4, a4, %lo(begin_signature)
.LBB0_2:                                # =>This Inner Loop Header: Depth=1
	add	a5, a1, a0
	slli	a5, a5, 2
	add	a6, a3, a5
	flw	fa5, 0(a6)
	add	a6, a2, a1
	slli	a6, a6, 2
	add	a6, a3, a6
	flw	fa4, 0(a6)
	fadd.s	fa5, fa5, fa4
	add	a5, a4, a5
	fsw	fa5, 0(a5)
	csrr	a5, vx_num_warps
	slli	a5, a5, 4
	add	a1, a5, a1
	srli	a5, a1, 11
	beqz	a5, .LBB0_2
.LBB0_3:
	li	a0, 0
	ret
.Lfunc_end0:
	.size	main, .Lfunc_end0-main
                                        # -- End function
	.type	begin_signature,@object         # @begin_signature
	.bss
	.globl	begin_signature
	.p2align	6, 0x0
begin_signature:
	.zero	8192
	.size	begin_signature, 8192

	.ident	"Debian clang version 19.1.7 (3~deb12u1)"
	.section	".note.GNU-stack","",@progbits
	.addrsig
