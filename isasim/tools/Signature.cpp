#include "tools/Signature.h"

#include "core/IsaTables.h"
#include "vorion/isasim/MemoryMap.h"
#include "vorion/support/File.h"

#include <fmt/format.h>
#include <vector>

namespace vorion::isasim {

Expected<Success> writeSignature(const Machine &M, const std::string &File,
                                 unsigned Granularity) {
  const Image &Program = *M.image();
  const std::optional<uint32_t> Begin = Program.findSymbol("begin_signature");
  const std::optional<uint32_t> End = Program.findSymbol("end_signature");
  if (!Begin || !End || *End < *Begin)
    return Error{Program.name(), "no signature, expected the symbols "
                                 "begin_signature and end_signature"};
  const uint32_t Size = *End - *Begin;
  const bool Fits = Size <= VX_IMAGE_SIZE || Size <= globalBytes(M.config());
  std::vector<std::byte> Bytes(Fits ? Size : 0);
  if (!Fits || !M.read(*Begin, Bytes))
    return Error{Program.name(),
                 fmt::format("signature from 0x{:08x} to 0x{:08x}, expected "
                             "memory of the program",
                             *Begin, *End)};
  const size_t Lines = (Bytes.size() + Granularity - 1) / Granularity;
  Bytes.resize(Lines * Granularity);
  std::string Text;
  for (size_t Line = 0; Line != Lines; ++Line) {
    for (size_t N = Granularity; N != 0; --N)
      Text += fmt::format("{:02x}", std::to_integer<unsigned>(
                                        Bytes[Line * Granularity + N - 1]));
    Text += '\n';
  }
  return writeFileAtomically(File, Text);
}

} // namespace vorion::isasim
