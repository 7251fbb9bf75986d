#include "machine/HangDetector.h"

#include <bit>
#include <cstring>
#include <type_traits>

namespace vorion::isasim {

namespace {

/// Rounds without a change before states are compared: comparing is cheap
/// beside that many rounds, and quiet stretches are common and short.
constexpr uint64_t Patience = 64;

template <typename T> void append(std::vector<std::byte> &To, const T &Value) {
  static_assert(std::is_trivially_copyable_v<T>);
  const size_t At = To.size();
  To.resize(At + sizeof(T));
  std::memcpy(To.data() + At, &Value, sizeof(T));
}

} // namespace

std::vector<std::byte>
HangDetector::snapshot(const std::vector<std::unique_ptr<Core>> &Cores) const {
  std::vector<std::byte> State;
  for (const auto &C : Cores)
    for (const WarpState &S : C->warps()) {
      append(State, S.Why);
      if (S.Why == Stop::Ended)
        continue;
      // The sink is written and never read.
      for (unsigned R = 0; R != SinkRegister; ++R)
        append(State, S.Registers[R]);
      append(State, S.Mask);
      append(State, S.pcOf(S.Next));
      append(State, S.Frm);
      append(State, S.Fflags);
      append(State, S.StackDepth);
      for (uint32_t D = 0; D != S.StackDepth; ++D) {
        append(State, S.Stack[D].Mask);
        append(State, S.Stack[D].Other);
        append(State, S.pcOf(S.Stack[D].Pc));
      }
    }
  return State;
}

bool HangDetector::check(const std::vector<std::unique_ptr<Core>> &Cores,
                         bool Progress) {
  uint64_t Changes = 0;
  for (const auto &C : Cores)
    for (const WarpState &S : C->warps())
      Changes += S.Count.Stores + S.Count.Changes;
  if (Progress || Changes != LastChanges) {
    LastChanges = Changes;
    QuietRounds = 0;
    Earlier.clear();
    return false;
  }
  if (++QuietRounds < Patience)
    return false;
  // Brent's cycle finding: compare with the state at the last power of two.
  std::vector<std::byte> Now = snapshot(Cores);
  if (Now == Earlier)
    return true;
  if (std::has_single_bit(QuietRounds))
    Earlier = std::move(Now);
  return false;
}

} // namespace vorion::isasim
