#include "timing/dram/AddressMap.h"

#include "vorion/support/Suggest.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorion::isasim::dram {

namespace {

constexpr unsigned AddressBits = 40;
constexpr unsigned LineBits = 6;

constexpr std::array<std::string_view, 3> Names = {"digit_sum",
                                                   "row_bank_column", "xor"};

unsigned bitsOf(uint32_t PowerOfTwo) {
  return static_cast<unsigned>(std::countr_zero(PowerOfTwo));
}

/// Of a decoded address, which is a word.
constexpr size_t DecodedBits = 64;

size_t placesOf(const AddressMap &Map) {
  size_t Bits = 0;
  for (const AddressField *Of : {&Map.Channel, &Map.Rank, &Map.BankGroup,
                                 &Map.Bank, &Map.Row, &Map.Column})
    for (const std::vector<uint64_t> &Masks : *Of)
      Bits += Masks.size();
  return Bits;
}

/// Address bits that are given away from the lowest on.
class Supply {
public:
  explicit Supply(std::vector<uint64_t> AllIn) : All(std::move(AllIn)) {}
  std::vector<uint64_t> take(size_t Count) {
    assert(At + Count <= All.size());
    At += Count;
    return {All.begin() + At - Count, All.begin() + At};
  }
  std::vector<uint64_t> rest() { return take(All.size() - At); }

private:
  std::vector<uint64_t> All;
  std::ptrdiff_t At = 0;
};

} // namespace

std::span<const std::string_view> addressMaps() { return Names; }

Expected<AddressMap> addressMap(std::string_view Name, const TimingTable &Table,
                                uint32_t Channels, uint32_t Interleave) {
  if (std::ranges::find(Names, Name) == Names.end())
    return Error{
        "",
        fmt::format("\"{}\" is not an address map, expected one of {}{}", Name,
                    fmt::join(Names, ", "), didYouMean(Name, Names)),
        ExitCode::Usage};
  if (!std::has_single_bit(Channels) || Channels > 64)
    return Error{
        "",
        fmt::format("{} channels, expected a power of two up to 64", Channels),
        ExitCode::Usage};
  if (!std::has_single_bit(Interleave) || Interleave < 64 || Interleave > 4096)
    return Error{
        "",
        fmt::format(
            "{} bytes per channel, expected a power of two from 64 to 4096",
            Interleave),
        ExitCode::Usage};
  const unsigned InRow = bitsOf(Table.RowBytes) - LineBits;
  const unsigned Fixed = InRow + bitsOf(Channels) + bitsOf(Table.Ranks) +
                         bitsOf(Table.BankGroups) + bitsOf(Table.BanksPerGroup);
  if (Fixed >= AddressBits - LineBits)
    return Error{"",
                 fmt::format("columns, banks and channels take {} of a line's "
                             "{} address bits, expected at least one row bit",
                             Fixed, AddressBits - LineBits),
                 ExitCode::Usage};
  AddressMap Map;
  std::vector<uint64_t> OfChannel, OfLine;
  const unsigned FirstOfChannel = bitsOf(Interleave);
  for (unsigned Bit = LineBits; Bit != AddressBits; ++Bit) {
    const bool IsOfChannel =
        Bit >= FirstOfChannel && Bit < FirstOfChannel + bitsOf(Channels);
    (IsOfChannel ? OfChannel : OfLine).push_back(uint64_t{1} << Bit);
  }
  Supply Left(OfLine);
  const bool IsXor = Name == "xor";
  if (IsXor)
    Map.BankGroup = {Left.take(bitsOf(Table.BankGroups))};
  Map.Column = {Left.take(InRow)};
  Map.Bank = {Left.take(bitsOf(Table.BanksPerGroup))};
  if (!IsXor)
    Map.BankGroup = {Left.take(bitsOf(Table.BankGroups))};
  Map.Rank = {Left.take(bitsOf(Table.Ranks))};
  const std::vector<uint64_t> Row = Left.rest();
  Map.Row = {Row};
  Map.Channel = {OfChannel};

  if (IsXor) {
    size_t Next = 0;
    for (std::vector<uint64_t> *Of :
         {&Map.Bank[0], &Map.BankGroup[0], &Map.Channel[0]})
      for (uint64_t &Mask : *Of)
        Mask |= Row[Next++ % Row.size()];
  }
  if (const size_t Digit = Map.Bank[0].size();
      Name == "digit_sum" && Digit != 0)
    for (size_t At = 0; At < Row.size(); At += Digit)
      Map.Bank.emplace_back(Row.begin() + static_cast<std::ptrdiff_t>(At),
                            Row.begin() + static_cast<std::ptrdiff_t>(std::min(
                                              At + Digit, Row.size())));
  if (const size_t Bits = placesOf(Map); Bits > DecodedBits)
    return Error{
        "",
        fmt::format("\"{}\" takes {} bits with this table, expected at most "
                    "{}: larger rows, more banks or another map",
                    Name, Bits, DecodedBits),
        ExitCode::Usage};
  return Map;
}

AddressDecoder::AddressDecoder(const AddressMap &Map, const TimingTable &Table)
    : BankGroups(Table.BankGroups), BanksPerGroup(Table.BanksPerGroup),
      BitsOfByte(Bytes) {
  uint32_t Position = 0;
  const auto Add = [&](Field &F, const AddressField &From) {
    for (const std::vector<uint64_t> &Masks : From) {
      const uint64_t Ones = (uint64_t{1} << Masks.size()) - 1;
      F.Terms.push_back({Position, static_cast<uint32_t>(Ones)});
      for (const uint64_t Mask : Masks) {
        assert(Position < DecodedBits && "addressMap() refuses such maps");
        for (unsigned Byte = 0; Byte != Bytes; ++Byte)
          for (unsigned Value = 0; Value != 256; ++Value) {
            const uint64_t Part = uint64_t{Value} << (8 * Byte);
            const uint64_t IsOdd = std::popcount(Part & Mask) % 2;
            BitsOfByte[Byte][Value] ^= IsOdd << Position;
          }
        ++Position;
      }
    }
    F.Mask = F.Terms.empty() ? 0 : F.Terms.front().Mask;
  };
  Add(Channel, Map.Channel);
  Add(Rank, Map.Rank);
  Add(BankGroup, Map.BankGroup);
  Add(Bank, Map.Bank);
  Add(Row, Map.Row);
  Add(Column, Map.Column);
}

uint32_t AddressDecoder::value(const Field &F, uint64_t Bits) const {
  uint32_t Sum = 0;
  for (const Term &T : F.Terms)
    Sum += static_cast<uint32_t>(Bits >> T.Shift) & T.Mask;
  return Sum & F.Mask;
}

Location AddressDecoder::operator()(uint64_t Address) const {
  uint64_t Bits = 0;
  for (unsigned Byte = 0; Byte != Bytes; ++Byte)
    Bits ^= BitsOfByte[Byte][Address >> (8 * Byte) & 0xFF];
  const uint32_t Group =
      value(Rank, Bits) * BankGroups + value(BankGroup, Bits);
  return {value(Channel, Bits),
          {Group * BanksPerGroup + value(Bank, Bits), value(Row, Bits)},
          value(Column, Bits)};
}

} // namespace vorion::isasim::dram
