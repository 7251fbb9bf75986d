	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"lines_digits.c"
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
	li	a2, 63
	bltu	a2, a1, .LBB0_8
# %bb.1:
	addi	sp, sp, -16
	sw	s0, 12(sp)                      # 4-byte Folded Spill
	lui	a2, %hi(bytes)
	addi	a2, a2, %lo(bytes)
	lui	a3, %hi(bits)
	addi	a3, a3, %lo(bits)
	lui	a4, %hi(begin_signature)
	addi	a4, a4, %lo(begin_signature)
	li	a5, 4
	li	a6, 64
.LBB0_2:                                # =>This Loop Header: Depth=1
                                        #     Child Loop BB0_3 Depth 2
                                        #       Child Loop BB0_4 Depth 3
	li	a7, 0
	add	t0, a1, a0
	slli	t0, t0, 4
.LBB0_3:                                #   Parent Loop BB0_2 Depth=1
                                        # =>  This Loop Header: Depth=2
                                        #       Child Loop BB0_4 Depth 3
	slli	t1, a7, 2
	add	t1, a2, t1
	lw	t3, 0(t1)
	add	t1, a7, t0
	slli	t1, t1, 2
	add	t2, a3, t1
	lw	t4, 0(t2)
	li	t2, 0
	addi	t3, t3, 2
	li	t5, 8
.LBB0_4:                                #   Parent Loop BB0_2 Depth=1
                                        #     Parent Loop BB0_3 Depth=2
                                        # =>    This Inner Loop Header: Depth=3
	divu	t6, t4, t3
	mul	s0, t6, t3
	add	t2, t4, t2
	addi	t5, t5, -1
	sub	t2, t2, s0
	mv	t4, t6
	bnez	t5, .LBB0_4
# %bb.5:                                #   in Loop: Header=BB0_3 Depth=2
	add	t1, a4, t1
	addi	a7, a7, 1
	sw	t2, 0(t1)
	bne	a7, a5, .LBB0_3
# %bb.6:                                #   in Loop: Header=BB0_2 Depth=1
	csrr	a7, vx_num_warps
	slli	a7, a7, 4
	add	a1, a7, a1
	bltu	a1, a6, .LBB0_2
# %bb.7:
	lw	s0, 12(sp)                      # 4-byte Folded Reload
	addi	sp, sp, 16
.LBB0_8:
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
