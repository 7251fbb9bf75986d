	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"lines_blend.c"
                                        # Start of file scope inline assembly
	.globl	end_signature
.set end_signature, begin_signature+(4*2048)

                                        # End of file scope inline assembly
	.section	.srodata.cst4,"aM",@progbits,4
	.p2align	2, 0x0                          # -- Begin function main
.LCPI0_0:
	.word	0xbf8ccccd                      # float -1.10000002
.LCPI0_1:
	.word	0x3e4ccccd                      # float 0.200000003
.LCPI0_2:
	.word	0xbf666666                      # float -0.899999976
.LCPI0_3:
	.word	0x3f666666                      # float 0.899999976
.LCPI0_4:
	.word	0x3dcccccd                      # float 0.100000001
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
	bltu	a2, a1, .LBB0_7
# %bb.1:
	fcvt.s.wu	fa5, a0
	lui	a3, %hi(ones)
	addi	a3, a3, %lo(ones)
	addi	a2, a3, 28
	lui	a4, %hi(.LCPI0_0)
	flw	fa4, %lo(.LCPI0_0)(a4)
	lui	a4, %hi(.LCPI0_1)
	flw	fa3, %lo(.LCPI0_1)(a4)
	lui	a4, %hi(.LCPI0_2)
	flw	fa2, %lo(.LCPI0_2)(a4)
	lui	a4, %hi(.LCPI0_3)
	flw	fa1, %lo(.LCPI0_3)(a4)
	lui	a4, %hi(.LCPI0_4)
	flw	fa0, %lo(.LCPI0_4)(a4)
	fmv.w.x	ft0, zero
	lui	a4, 260096
	fmv.w.x	ft1, a4
	lui	a4, 793088
	fmv.w.x	ft2, a4
	lui	a4, 791040
	fmv.w.x	ft3, a4
	addi	a3, a3, 796
	lui	a4, %hi(begin_signature)
	addi	a4, a4, %lo(begin_signature)
	li	a5, 128
	j	.LBB0_3
.LBB0_2:                                #   in Loop: Header=BB0_3 Depth=1
	add	a6, a1, a0
	slli	a6, a6, 6
	add	a6, a4, a6
	fsw	ft5, 0(a6)
	fsw	ft6, 4(a6)
	fsw	ft7, 8(a6)
	fsw	ft4, 12(a6)
	csrr	a6, vx_num_warps
	slli	a6, a6, 4
	add	a1, a6, a1
	bgeu	a1, a5, .LBB0_7
.LBB0_3:                                # =>This Loop Header: Depth=1
                                        #     Child Loop BB0_5 Depth 2
	srli	a6, a1, 4
	fcvt.s.wu	fa6, a6
	mv	a6, a2
	fmv.s	ft5, ft0
	fmv.s	ft6, ft0
	fmv.s	ft4, ft1
	fmv.s	ft7, ft0
	j	.LBB0_5
.LBB0_4:                                #   in Loop: Header=BB0_5 Depth=2
	addi	a6, a6, 32
	vx_join	a7
	beq	a6, a3, .LBB0_2
.LBB0_5:                                #   Parent Loop BB0_3 Depth=1
                                        # =>  This Inner Loop Header: Depth=2
	flw	fa7, -28(a6)
	flw	ft8, -24(a6)
	fadd.s	fa7, fa7, fa4
	fadd.s	ft8, ft8, fa4
	flw	ft9, -20(a6)
	flw	ft10, -16(a6)
	fmul.s	fa7, fa7, ft2
	fmul.s	ft8, ft8, ft3
	fadd.s	fa7, fa5, fa7
	fadd.s	ft8, fa6, ft8
	fmul.s	ft9, ft9, fa7
	fmul.s	ft10, ft10, ft8
	flw	ft11, -12(a6)
	fmul.s	fa7, fa7, ft9
	fmul.s	ft8, ft8, ft10
	fadd.s	fa7, fa7, ft8
	fadd.s	ft8, ft11, fa2
	fmul.s	fa7, fa7, fa3
	fmul.s	ft8, ft8, fa1
	fadd.s	fa7, fa7, ft1
	fdiv.s	fa7, ft8, fa7
	fle.s	t0, fa0, fa7
	xori	a7, t0, 1
	vx_split	a7, a7
	beqz	t0, .LBB0_4
# %bb.6:                                #   in Loop: Header=BB0_5 Depth=2
	flw	ft8, -8(a6)
	flw	ft9, -4(a6)
	flw	ft10, 0(a6)
	fmul.s	ft8, fa7, ft8
	fmul.s	ft9, fa7, ft9
	fmul.s	ft10, fa7, ft10
	fmul.s	ft8, ft4, ft8
	fmul.s	ft9, ft4, ft9
	fmul.s	ft10, ft4, ft10
	fsub.s	fa7, ft1, fa7
	fadd.s	ft5, ft5, ft8
	fadd.s	ft6, ft6, ft9
	fadd.s	ft7, ft7, ft10
	fmul.s	ft4, ft4, fa7
	j	.LBB0_4
.LBB0_7:
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
	.addrsig_sym vorion.vx_split
	.addrsig_sym vorion.vx_join
