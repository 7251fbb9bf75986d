/// Cycles cut at the ends of runs.
#include "timing/common/CycleLedger.h"

#include <gtest/gtest.h>

using namespace vorion::isasim;

namespace {

enum class Why : uint8_t { Work, Wait, Rest, Count };
using Ledger = CycleLedger<Why>;

TEST(CycleLedger, CutsWhatLiesAcrossTheEnd) {
  Ledger L;
  L.begin(100);
  L.spend(Why::Work, 130);
  L.spend(Why::Wait, 170);
  L.spend(Why::Work, 200);
  EXPECT_EQ(L.end(150, Why::Rest), (Ledger::Sums{30, 20, 0}));
  L.begin(150);
  EXPECT_EQ(L.end(250, Why::Rest), (Ledger::Sums{30, 20, 50}));
}

TEST(CycleLedger, SettlingChangesNoSum) {
  for (const uint64_t Settled : {0, 10, 25, 40}) {
    Ledger L;
    L.begin(0);
    L.spend(Why::Wait, 10);
    L.spend(Why::Work, 30);
    L.settle(Settled);
    L.spend(Why::Work, 35);
    EXPECT_EQ(L.end(40, Why::Rest), (Ledger::Sums{25, 10, 5})) << Settled;
  }
}

TEST(CycleLedger, WhatEndedBeforeTheRunIsNotCounted) {
  Ledger L;
  L.begin(0);
  EXPECT_EQ(L.end(100, Why::Rest), (Ledger::Sums{0, 0, 100}));
  L.begin(100);
  // A unit that was waiting says so only when it goes on.
  L.spend(Why::Wait, 120);
  EXPECT_EQ(L.end(120, Why::Rest), (Ledger::Sums{0, 20, 0}));
}

} // namespace
