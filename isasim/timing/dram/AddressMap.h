/// Which bits of an address choose channel, bank, row and column of a line.
#pragma once

#include "timing/dram/Controller.h"

#include <span>
#include <string_view>
#include <vector>

namespace vorion::isasim::dram {

/// A number made of address bits: the sum, modulo its size, of terms. Each bit
/// of a term, the lowest first, is the parity of the address bits of a mask;
/// the first term has as many bits as the number.
using AddressField = std::vector<std::vector<uint64_t>>;

struct AddressMap {
  AddressField Channel, Rank, BankGroup, Bank, Row, Column;
};

/// The maps that have names.
std::span<const std::string_view> addressMaps();
/// One of them for \p Channels channels of \p Table, of which each has
/// \p Interleave bytes before the next has (64 to 4096); all powers of two.
///
/// digit_sum: the rows of a channel go round the banks, and the bank is the sum
///   of the row number's digits to the base of the banks, as version 1 of the
///   clock had it.
/// row_bank_column: what its name says, the row on top.
/// xor: neighbouring lines in different bank groups; channel, bank group and
///   bank are spread by the exclusive or with bits of the row.
Expected<AddressMap> addressMap(std::string_view Name, const TimingTable &Table,
                                uint32_t Channels, uint32_t Interleave);

/// Where an address lies.
struct Location {
  uint32_t Channel = 0;
  Place Where;
  uint32_t Column = 0; ///< line in its row
};

/// Decodes addresses of up to 40 bits. All fields at once, by a table look-up a
/// byte: a parity of bits is linear.
class AddressDecoder {
public:
  AddressDecoder(const AddressMap &Map, const TimingTable &Table);
  Location operator()(uint64_t Address) const;

private:
  static constexpr unsigned Bytes = 5;
  struct Term {
    uint32_t Shift, Mask;
  };
  struct Field {
    std::vector<Term> Terms;
    uint32_t Mask = 0;
  };
  uint32_t value(const Field &F, uint64_t Bits) const;

  uint32_t BankGroups, BanksPerGroup;
  Field Channel, Rank, BankGroup, Bank, Row, Column;
  std::vector<std::array<uint64_t, 256>> BitsOfByte;
};

} // namespace vorion::isasim::dram
