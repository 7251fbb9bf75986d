	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"gcd.c"
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
	lui	a2, %hi(bits)
	addi	a2, a2, %lo(bits)
	lui	a3, %hi(bytes)
	addi	a3, a3, %lo(bytes)
	lui	a4, %hi(begin_signature)
	addi	a4, a4, %lo(begin_signature)
	li	a5, 256
	j	.LBB0_3
.LBB0_2:                                #   in Loop: Header=BB0_3 Depth=1
	vx_join	t0
	add	a6, a4, a6
	sw	a7, 0(a6)
	csrr	a6, vx_num_warps
	slli	a6, a6, 4
	add	a1, a6, a1
	bgeu	a1, a5, .LBB0_6
.LBB0_3:                                # =>This Loop Header: Depth=1
                                        #     Child Loop BB0_5 Depth 2
	add	a6, a1, a0
	slli	a6, a6, 2
	add	a7, a3, a6
	lw	t1, 0(a7)
	add	a7, a2, a6
	lw	a7, 0(a7)
	seqz	t0, t1
	vx_split	t0, t0
	beqz	t1, .LBB0_2
# %bb.4:                                #   in Loop: Header=BB0_3 Depth=1
	csrr	t2, vx_active_threads
.LBB0_5:                                #   Parent Loop BB0_3 Depth=1
                                        # =>  This Inner Loop Header: Depth=2
	mv	t3, a7
	mv	a7, t1
	remu	t1, t3, t1
	seqz	t3, t1
	vx_pred_n	t3, t2
	bnez	t1, .LBB0_5
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
