	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"gather.c"
                                        # Start of file scope inline assembly
	.globl	end_signature
.set end_signature, begin_signature+(4*256)

                                        # End of file scope inline assembly
	.globl	main                            # -- Begin function main
	.p2align	2
	.type	main,@function
main:                                   # @main
# %bb.0:
	csrr	a0, vx_thread_id
	csrr	a1, vx_warp_id
	slli	a1, a1, 4
	li	a2, 255
	bltu	a2, a1, .LBB0_6
# %bb.1:
	lui	a2, %hi(bytes)
	addi	a2, a2, %lo(bytes)
	fmv.w.x	fa5, zero
	lui	a3, %hi(begin_signature)
	addi	a3, a3, %lo(begin_signature)
	li	a4, 256
	lui	a5, %hi(bits)
	addi	a5, a5, %lo(bits)
	lui	a6, %hi(ones)
	addi	a6, a6, %lo(ones)
	lui	a7, 1
	j	.LBB0_3
.LBB0_2:                                #   in Loop: Header=BB0_3 Depth=1
	vx_join	t1
	add	t0, a3, t0
	fsw	fa4, 0(t0)
	csrr	t0, vx_num_warps
	slli	t0, t0, 4
	add	a1, t0, a1
	bgeu	a1, a4, .LBB0_6
.LBB0_3:                                # =>This Loop Header: Depth=1
                                        #     Child Loop BB0_5 Depth 2
	add	t3, a1, a0
	slli	t0, t3, 2
	add	t1, a2, t0
	lw	t1, 0(t1)
	andi	t4, t1, 15
	seqz	t1, t4
	vx_split	t1, t1
	fmv.s	fa4, fa5
	beqz	t4, .LBB0_2
# %bb.4:                                #   in Loop: Header=BB0_3 Depth=1
	add	t2, a5, t0
	slli	t3, t3, 4
	add	t5, a6, a7
	add	t3, t5, t3
	slli	t4, t4, 2
	add	t5, a5, t0
	add	t4, t5, t4
	csrr	t5, vx_active_threads
	fmv.s	fa4, fa5
.LBB0_5:                                #   Parent Loop BB0_3 Depth=1
                                        # =>  This Inner Loop Header: Depth=2
	lw	t6, 0(t2)
	flw	fa3, 0(t3)
	andi	t6, t6, 1023
	slli	t6, t6, 2
	add	t6, a6, t6
	flw	fa2, 0(t6)
	fmadd.s	fa4, fa3, fa2, fa4
	addi	t2, t2, 4
	addi	t3, t3, 4
	xor	t6, t2, t4
	seqz	t6, t6
	vx_pred_n	t6, t5
	bne	t2, t4, .LBB0_5
	j	.LBB0_2
.LBB0_6:
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
	.zero	1024
	.size	begin_signature, 1024

	.ident	"Debian clang version 19.1.7 (3~deb12u1)"
	.section	".note.GNU-stack","",@progbits
	.addrsig
	.addrsig_sym vorion.vx_split
	.addrsig_sym vorion.vx_join
	.addrsig_sym vorion.vx_active_threads
	.addrsig_sym vorion.vx_pred_n
