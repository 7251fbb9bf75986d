	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"blend.c"
                                        # Start of file scope inline assembly
	.globl	end_signature
.set end_signature, begin_signature+(4*512)

                                        # End of file scope inline assembly
	.section	.srodata.cst4,"aM",@progbits,4
	.p2align	2, 0x0                          # -- Begin function main
.LCPI0_0:
	.word	0xbf8ccccd                      # float -1.10000002
.LCPI0_1:
	.word	0xbd75c28f                      # float -0.0599999987
.LCPI0_2:
	.word	0xbcf5c28f                      # float -0.0299999993
.LCPI0_3:
	.word	0xbf666666                      # float -0.899999976
.LCPI0_4:
	.word	0x3f666666                      # float 0.899999976
.LCPI0_5:
	.word	0x4b38aa3b                      # float 12102203
.LCPI0_6:
	.word	0x4e7de9a3                      # float 1.06498682E+9
.LCPI0_7:
	.word	0x3b808081                      # float 0.00392156886
.LCPI0_8:
	.word	0x3c23d70a                      # float 0.00999999977
	.text
	.globl	main
	.p2align	2
	.type	main,@function
main:                                   # @main
# %bb.0:
	csrr	a0, vx_thread_id
	csrr	a1, vx_warp_id
	slli	a1, a1, 4
	li	a2, 127
	bltu	a2, a1, .LBB0_15
# %bb.1:
	addi	sp, sp, -16
	fsw	fs0, 12(sp)                     # 4-byte Folded Spill
	fsw	fs1, 8(sp)                      # 4-byte Folded Spill
	fsw	fs2, 4(sp)                      # 4-byte Folded Spill
	fsw	fs3, 0(sp)                      # 4-byte Folded Spill
	fcvt.s.wu	fa5, a0
	lui	a2, %hi(.LCPI0_0)
	flw	fa4, %lo(.LCPI0_0)(a2)
	lui	a2, %hi(.LCPI0_1)
	flw	fa3, %lo(.LCPI0_1)(a2)
	lui	a2, %hi(.LCPI0_2)
	flw	fa2, %lo(.LCPI0_2)(a2)
	lui	a2, %hi(.LCPI0_3)
	flw	fa1, %lo(.LCPI0_3)(a2)
	lui	a2, %hi(.LCPI0_4)
	flw	fa0, %lo(.LCPI0_4)(a2)
	lui	a2, %hi(.LCPI0_5)
	flw	ft0, %lo(.LCPI0_5)(a2)
	lui	a2, %hi(.LCPI0_6)
	flw	ft1, %lo(.LCPI0_6)(a2)
	lui	a2, %hi(.LCPI0_7)
	flw	ft2, %lo(.LCPI0_7)(a2)
	lui	a2, %hi(.LCPI0_8)
	flw	ft3, %lo(.LCPI0_8)(a2)
	lui	a2, %hi(ones+28)
	addi	a2, a2, %lo(ones+28)
	fmv.w.x	ft4, zero
	lui	a3, 260096
	fmv.w.x	ft5, a3
	lui	a3, 793088
	fmv.w.x	ft6, a3
	lui	a3, 791040
	fmv.w.x	ft7, a3
	lui	a3, %hi(begin_signature)
	addi	a3, a3, %lo(begin_signature)
	li	a4, 128
	j	.LBB0_3
.LBB0_2:                                #   in Loop: Header=BB0_3 Depth=1
	add	a5, a1, a0
	slli	a5, a5, 4
	add	a5, a3, a5
	fsw	ft8, 0(a5)
	fsw	fa7, 4(a5)
	fsw	fa6, 8(a5)
	fsw	ft10, 12(a5)
	csrr	a5, vx_num_warps
	slli	a5, a5, 4
	add	a1, a5, a1
	bgeu	a1, a4, .LBB0_14
.LBB0_3:                                # =>This Loop Header: Depth=1
                                        #     Child Loop BB0_7 Depth 2
	srli	a5, a1, 4
	fcvt.s.wu	ft9, a5
	li	a7, 24
	csrr	a5, vx_active_threads
	mv	a6, a2
	fmv.s	ft8, ft4
	fmv.s	fa7, ft4
	fmv.s	fa6, ft4
	fmv.s	ft10, ft5
	j	.LBB0_7
.LBB0_4:                                #   in Loop: Header=BB0_7 Depth=2
	li	t1, 0
.LBB0_5:                                #   in Loop: Header=BB0_7 Depth=2
                                        # implicit-def: $x16
                                        # implicit-def: $x17
.LBB0_6:                                #   in Loop: Header=BB0_7 Depth=2
	vx_join	t0
	vx_pred	t1, a5
	beqz	t1, .LBB0_2
.LBB0_7:                                #   Parent Loop BB0_3 Depth=1
                                        # =>  This Inner Loop Header: Depth=2
	flw	ft11, -28(a6)
	flw	fs0, -24(a6)
	fadd.s	ft11, ft11, fa4
	fadd.s	fs0, fs0, fa4
	flw	fs1, -20(a6)
	flw	fs2, -16(a6)
	fmul.s	ft11, ft11, ft6
	fmul.s	fs0, fs0, ft7
	fadd.s	ft11, fa5, ft11
	fadd.s	fs0, ft9, fs0
	fmul.s	fs1, fs1, ft11
	fmul.s	fs2, fs2, fs0
	fmul.s	fs1, ft11, fs1
	fmul.s	fs2, fs0, fs2
	fadd.s	fs1, fs1, fs2
	fmul.s	ft11, ft11, fa2
	fmul.s	fs1, fs1, fa3
	fmul.s	ft11, ft11, fs0
	fadd.s	ft11, fs1, ft11
	flw	fs0, -12(a6)
	fmul.s	ft11, ft11, ft0
	fadd.s	ft11, ft11, ft1
	fadd.s	fs0, fs0, fa1
	fmax.s	ft11, ft11, ft4
	fcvt.w.s	t0, ft11, rtz
	fmul.s	ft11, fs0, fa0
	fmv.w.x	fs0, t0
	fmul.s	fs0, ft11, fs0
	flt.s	t1, fs0, ft2
	vx_split	t0, t1
	li	t2, 7
	bnez	t1, .LBB0_11
# %bb.8:                                #   in Loop: Header=BB0_7 Depth=2
	fsub.s	ft11, ft5, fs0
	fmul.s	ft11, ft10, ft11
	flt.s	t3, ft11, ft3
	vx_split	t1, t3
	li	t2, 5
	bnez	t3, .LBB0_10
# %bb.9:                                #   in Loop: Header=BB0_7 Depth=2
	flw	fs1, -8(a6)
	flw	fs2, -4(a6)
	flw	fs3, 0(a6)
	fmul.s	fs1, fs0, fs1
	fmul.s	fs2, fs0, fs2
	fmul.s	fs0, fs0, fs3
	fmul.s	fs1, ft10, fs1
	fmul.s	fs2, ft10, fs2
	fmul.s	ft10, ft10, fs0
	fadd.s	ft8, ft8, fs1
	fadd.s	fa7, fa7, fs2
	fadd.s	fa6, fa6, ft10
	li	t2, 0
	fmv.s	ft10, ft11
.LBB0_10:                               #   in Loop: Header=BB0_7 Depth=2
	vx_join	t1
.LBB0_11:                               #   in Loop: Header=BB0_7 Depth=2
	vx_join	t0
	slti	t0, t2, 7
	xori	t0, t0, 1
	seqz	t1, t2
	or	t1, t0, t1
	vx_split	t0, t1
	beqz	t1, .LBB0_5
# %bb.12:                               #   in Loop: Header=BB0_7 Depth=2
	addi	a7, a7, -1
	beqz	a7, .LBB0_4
# %bb.13:                               #   in Loop: Header=BB0_7 Depth=2
	addi	a6, a6, 32
	li	t1, 1
	j	.LBB0_6
.LBB0_14:
	flw	fs0, 12(sp)                     # 4-byte Folded Reload
	flw	fs1, 8(sp)                      # 4-byte Folded Reload
	flw	fs2, 4(sp)                      # 4-byte Folded Reload
	flw	fs3, 0(sp)                      # 4-byte Folded Reload
	addi	sp, sp, 16
.LBB0_15:
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
	.zero	2048
	.size	begin_signature, 2048

	.ident	"Debian clang version 19.1.7 (3~deb12u1)"
	.section	".note.GNU-stack","",@progbits
	.addrsig
	.addrsig_sym vorion.vx_split
	.addrsig_sym vorion.vx_join
	.addrsig_sym vorion.vx_active_threads
	.addrsig_sym vorion.vx_pred
