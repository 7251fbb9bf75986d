	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"sgemm.c"
                                        # Start of file scope inline assembly
	.globl	end_signature
.set end_signature, begin_signature+(4*1024)

                                        # End of file scope inline assembly
	.globl	main                            # -- Begin function main
	.p2align	2
	.type	main,@function
main:                                   # @main
# %bb.0:
	csrr	a0, vx_thread_id
	csrr	a1, vx_warp_id
	slli	a1, a1, 4
	li	a2, 1023
	bltu	a2, a1, .LBB0_5
# %bb.1:
	slli	a3, a0, 2
	lui	a2, %hi(ones)
	addi	a2, a2, %lo(ones)
	add	a3, a2, a3
	lui	a4, 1
	add	a3, a3, a4
	fmv.w.x	fa5, zero
	lui	a4, %hi(begin_signature)
	addi	a4, a4, %lo(begin_signature)
	li	a5, 1024
.LBB0_2:                                # =>This Loop Header: Depth=1
                                        #     Child Loop BB0_3 Depth 2
	andi	a6, a1, 992
	slli	a6, a6, 2
	add	a6, a2, a6
	andi	a7, a1, 16
	slli	a7, a7, 2
	add	a7, a3, a7
	addi	t0, a6, 128
	fmv.s	fa4, fa5
.LBB0_3:                                #   Parent Loop BB0_2 Depth=1
                                        # =>  This Inner Loop Header: Depth=2
	flw	fa3, 0(a6)
	flw	fa2, 0(a7)
	fmadd.s	fa4, fa3, fa2, fa4
	addi	a6, a6, 4
	addi	a7, a7, 128
	bne	a6, t0, .LBB0_3
# %bb.4:                                #   in Loop: Header=BB0_2 Depth=1
	add	a6, a1, a0
	slli	a6, a6, 2
	add	a6, a4, a6
	fsw	fa4, 0(a6)
	csrr	a6, vx_num_warps
	slli	a6, a6, 4
	add	a1, a6, a1
	bltu	a1, a5, .LBB0_2
.LBB0_5:
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
	.zero	4096
	.size	begin_signature, 4096

	.ident	"Debian clang version 19.1.7 (3~deb12u1)"
	.section	".note.GNU-stack","",@progbits
	.addrsig
