/// Branches and jumps of a warp, and instructions of the system, on every
/// vector level.

#include "testing/Instructions.h"
#include "testing/WarpRunner.h"

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

TEST(Control, BranchesCompareActiveLanes) {
  struct Case {
    Op O;
    uint32_t A, B;
    bool Taken;
  };
  for (const ExecTable *Table : allTables())
    for (const Case &C :
         {Case{Op::RV_BEQ, 5, 5, true}, Case{Op::RV_BEQ, 5, 6, false},
          Case{Op::RV_BNE, 5, 6, true}, Case{Op::RV_BNE, 5, 5, false},
          Case{Op::RV_BLT, ~0U, 0, true}, Case{Op::RV_BLT, 0, ~0U, false},
          Case{Op::RV_BGE, 0, ~0U, true}, Case{Op::RV_BGE, ~0U, 0, false},
          Case{Op::RV_BGE, 3, 3, true}, Case{Op::RV_BLTU, 0, ~0U, true},
          Case{Op::RV_BLTU, ~0U, 0, false}, Case{Op::RV_BGEU, ~0U, 0, true},
          Case{Op::RV_BGEU, 0, ~0U, false}})
      for (const uint32_t Mask : MaskPatterns) {
        WarpRunner R(*Table, {encode(C.O, {.Rs1 = 10, .Rs2 = 11, .Imm = 8}),
                              addi(12, 12, 1), addi(13, 13, 1)});
        // Inactive lanes would decide otherwise.
        Lanes16 A = all(C.B), B = all(C.A);
        for (unsigned L = 0; L != MaxLanes; ++L)
          if (Mask >> L & 1) {
            A[L] = C.A;
            B[L] = C.B;
          }
        R.setX(10, A);
        R.setX(11, B);
        R.setActive(Mask);
        R.run();
        ASSERT_TRUE(R.ranToEnd());
        EXPECT_EQ(R.getX(12), C.Taken ? all(0) : bitsOf(Mask));
        EXPECT_EQ(R.getX(13), bitsOf(Mask));
        EXPECT_EQ(R.warp().Count.WarpInstructions, C.Taken ? 2U : 3U);
      }
}

TEST(Control, DivergentBranchTrapsAtItsPc) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {addi(12, 0, 1),
                          encode(Op::RV_BNE, {.Rs1 = 10, .Rs2 = 0, .Imm = 8}),
                          addi(12, 0, 2)});
    R.setX(10, bitsOf(0x0010));
    R.setActive(0x00FF);
    R.run();
    EXPECT_EQ(R.cause(), TrapCause::DivergentBranch);
    EXPECT_EQ(R.warp().pcOf(R.warp().Next), VX_IMAGE_BASE + 4);
    EXPECT_EQ(R.warp().FaultLane, 4U);
    EXPECT_EQ(R.warp().Count.WarpInstructions, 1U);
  }
}

TEST(Control, JumpsLinkAndReturn) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_JAL, {.Rd = 1, .Imm = 12}), addi(12, 12, 1),
                  encode(Op::RV_JAL, {.Rd = 0, .Imm = 12}),
                  addi(13, 13, 1), // called
                  encode(Op::RV_JALR, {.Rd = 0, .Rs1 = 1}), addi(14, 14, 1)});
    R.run();
    ASSERT_TRUE(R.ranToEnd());
    EXPECT_EQ(R.getX(12), all(1));
    EXPECT_EQ(R.getX(13), all(1));
    EXPECT_EQ(R.getX(1), all(VX_IMAGE_BASE + 4));
    EXPECT_EQ(R.warp().Count.WarpInstructions, 6U);
  }
}

TEST(Control, JalrMayOverwriteItsOwnSource) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::RV_JALR, {.Rd = 5, .Rs1 = 5, .Imm = 1}),
                          addi(12, 12, 1), addi(13, 13, 1)});
    R.setX(5, all(VX_IMAGE_BASE + 8)); // the lowest bit is cleared
    R.run();
    ASSERT_TRUE(R.ranToEnd());
    EXPECT_EQ(R.getX(12), all(0));
    EXPECT_EQ(R.getX(5), all(VX_IMAGE_BASE + 4));
  }
}

TEST(Control, BadJumpTargetsTrap) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner Far(*Table, {encode(Op::RV_JAL, {.Rd = 1, .Imm = -4096})});
    Far.run();
    EXPECT_EQ(Far.cause(), TrapCause::FetchFault);
    EXPECT_EQ(Far.warp().FaultAddress, VX_IMAGE_BASE - 4096);
    EXPECT_EQ(Far.warp().pcOf(Far.warp().Next), VX_IMAGE_BASE);

    WarpRunner Odd(*Table, {encode(Op::RV_BEQ, {.Rs1 = 0, .Rs2 = 0, .Imm = 6}),
                            addi(1, 0, 1), addi(1, 0, 1)});
    Odd.run();
    EXPECT_EQ(Odd.cause(), TrapCause::MisalignedFetch);
    EXPECT_EQ(Odd.warp().FaultAddress, VX_IMAGE_BASE + 6);

    WarpRunner NotTaken(*Table,
                        {encode(Op::RV_BNE, {.Rs1 = 0, .Rs2 = 0, .Imm = 6})});
    NotTaken.run();
    EXPECT_TRUE(NotTaken.ranToEnd());

    WarpRunner Apart(*Table, {encode(Op::RV_JALR, {.Rd = 1, .Rs1 = 5})});
    Lanes16 Targets = all(VX_IMAGE_BASE);
    Targets[3] += 4;
    Apart.setX(5, Targets);
    Apart.run();
    EXPECT_EQ(Apart.cause(), TrapCause::DivergentJump);
    EXPECT_EQ(Apart.warp().FaultLane, 3U);

    WarpRunner Wild(*Table,
                    {encode(Op::RV_JALR, {.Rd = 1, .Rs1 = 0, .Imm = 64})});
    Wild.run();
    EXPECT_EQ(Wild.cause(), TrapCause::FetchFault);
    EXPECT_EQ(Wild.warp().FaultAddress, 64U);
  }
}

TEST(Control, SystemInstructionsTrap) {
  for (const auto &[Word, Cause] :
       {std::pair(0x00000073U, TrapCause::EnvironmentCall),
        std::pair(0x00100073U, TrapCause::Breakpoint),
        std::pair(0x30200073U, TrapCause::IllegalInstruction), // mret
        std::pair(0x00000000U, TrapCause::IllegalInstruction),
        std::pair(0x1005A52FU, TrapCause::IllegalInstruction)}) { // lr.w
    WarpRunner R(execTable(false), {Word});
    R.run();
    EXPECT_EQ(R.cause(), Cause);
  }
}
