/// Address maps: nothing falls together, and each is what its name says.
#include "timing/dram/AddressMap.h"

#include <gtest/gtest.h>
#include <set>
#include <tuple>

using namespace vorion::isasim::dram;

namespace {

constexpr uint64_t Line = 64;

TEST(AddressMap, NoTwoLinesFallTogether) {
  for (const std::string_view Standard : standards())
    for (const std::string_view Name : addressMaps())
      for (const uint32_t Interleave : {64U, 512U, 4096U}) {
        const TimingTable T = *standardTable(Standard);
        const AddressDecoder D(*addressMap(Name, T, 4, Interleave), T);
        std::set<std::tuple<uint32_t, uint32_t, uint32_t, uint32_t>> Seen;
        // A stretch of neighbours, and lines a power of two apart.
        for (uint64_t N = 0; N != 8192; ++N)
          for (const uint64_t Address : {N * Line, N << 20 | N % 64 * Line}) {
            const Location L = D(Address);
            ASSERT_LT(L.Channel, 4U);
            ASSERT_LT(L.Where.Bank, T.banks());
            ASSERT_LT(L.Column, T.RowBytes / Line);
            Seen.insert({L.Channel, L.Where.Bank, L.Where.Row, L.Column});
          }
        std::set<uint64_t> Addresses;
        for (uint64_t N = 0; N != 8192; ++N)
          Addresses.insert({N * Line, N << 20 | N % 64 * Line});
        EXPECT_EQ(Seen.size(), Addresses.size()) << Standard << ' ' << Name;
      }
}

TEST(AddressMap, DigitSumPlacesAsDramDoes) {
  const TimingTable T = *standardTable("lpddr4-3200");
  const AddressDecoder D(*addressMap("digit_sum", T, 2, 64), T);
  for (uint64_t N = 0; N != 100000; ++N) {
    const uint64_t Number = N * 7919 % (uint64_t{1} << 26);
    const uint64_t Row = Number / 2 / 32;
    uint64_t Sum = 0;
    for (uint64_t Left = Row; Left; Left /= 8)
      Sum += Left;
    const Location L = D(Number * Line);
    ASSERT_EQ(L.Channel, Number % 2);
    ASSERT_EQ(L.Where.Bank, Sum % 8);
    ASSERT_EQ(L.Where.Row, Row / 8);
  }
}

TEST(AddressMap, RowBankColumnIsPlain) {
  const TimingTable T = *standardTable("ddr4-3200");
  const AddressDecoder D(*addressMap("row_bank_column", T, 2, 4096), T);
  const uint64_t Address = uint64_t{5} << 18 | uint64_t{13} << 14 |
                           uint64_t{1} << 12 | uint64_t{0x7C0};
  const Location L = D(Address);
  EXPECT_EQ(L.Channel, 1U);
  EXPECT_EQ(L.Column, 0x1FU);
  // Bits 13 on: the column's last, then bank and group.
  EXPECT_EQ(L.Where.Row, 5U);
}

TEST(AddressMap, XorSpreadsWhatIsFarApart) {
  const TimingTable T = *standardTable("lpddr5-6400");
  const AddressDecoder D(*addressMap("xor", T, 4, 64), T);
  std::set<std::pair<uint32_t, uint32_t>> Plain;
  const AddressDecoder RowBankColumn(*addressMap("row_bank_column", T, 4, 64),
                                     T);
  std::set<std::pair<uint32_t, uint32_t>> Spread;
  for (uint64_t N = 0; N != 64; ++N) {
    const uint64_t Address = N << 17;
    Spread.insert({D(Address).Channel, D(Address).Where.Bank});
    Plain.insert(
        {RowBankColumn(Address).Channel, RowBankColumn(Address).Where.Bank});
  }
  EXPECT_EQ(Spread.size(), 64U);
  EXPECT_EQ(Plain.size(), 1U);
}

TEST(AddressMap, WhatCannotBeIsRefused) {
  const TimingTable T = *standardTable("lpddr4-3200");
  EXPECT_EQ(addressMap("zigzag", T, 1, 64).error().What,
            "\"zigzag\" is not an address map, expected one of digit_sum, "
            "row_bank_column, xor");
  EXPECT_EQ(addressMap("xor", T, 3, 64).error().What,
            "3 channels, expected a power of two up to 64");
  EXPECT_EQ(addressMap("xor", T, 2, 32).error().What,
            "32 bytes per channel, expected a power of two from 64 to 4096");
}

TEST(AddressMap, OneThatTakesMoreThanAWordIsRefused) {
  TimingTable T = *standardTable("ddr3-1600");
  T.RowBytes = 64;
  EXPECT_TRUE(addressMap("row_bank_column", T, 1, 64));
  EXPECT_EQ(addressMap("digit_sum", T, 1, 64).error().What,
            "\"digit_sum\" takes 65 bits with this table, expected at most 64: "
            "larger rows, more banks or another map");
  T.RowBytes = 1U << 30;
  T.BanksPerGroup = 16;
  EXPECT_EQ(addressMap("row_bank_column", T, 64, 64).error().What,
            "columns, banks and channels take 34 of a line's 34 address bits, "
            "expected at least one row bit");
}

} // namespace
