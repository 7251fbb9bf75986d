/// The policies that units of the clock ask (vorion/isasim/Policies.h): their
/// own, or those of a plugin.
#pragma once

#include "vorion/isasim/Policies.h"

#include <memory>
#include <string>
#include <utility>

namespace vorion::isasim {

/// What plugins have put in the place of the units' own policies, in all
/// machines that are opened from then on.
PolicyMakers &pluggedPolicies();

/// A unit's policy. Calls of its own one are not virtual, so that it costs what
/// it did before there were others.
template <typename Interface, typename Own> class Policy {
public:
  explicit Policy(Own Default = {}, std::unique_ptr<Interface> Plugged = {})
      : Default(std::move(Default)), Plugged(std::move(Plugged)) {}

  /// \p Do with the policy, as the type that it has.
  auto ask(auto Do) {
    if (Plugged) [[unlikely]]
      return Do(*Plugged);
    return Do(Default);
  }
  auto ask(auto Do) const {
    if (Plugged) [[unlikely]]
      return Do(std::as_const(*Plugged));
    return Do(Default);
  }
  bool isOwn() const { return !Plugged; }
  const Own &own() const { return Default; }

private:
  Own Default;
  std::unique_ptr<Interface> Plugged;
};

/// A policy of a plugin has done what it must not: \p What, in words. The unit
/// goes on as it likes, and the run ends with an error.
void notePolicyFault(std::string What);
/// The first one since the last call; empty for none.
std::string takePolicyFault();

} // namespace vorion::isasim
