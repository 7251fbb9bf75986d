#include "Front.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace vorion::splat {

std::vector<std::size_t> paretoFront(const std::vector<Candidate> &All,
                                     TimeAxis A) {
  std::vector<std::size_t> Order;
  for (std::size_t I = 0; I < All.size(); ++I)
    if (All[I].time(A))
      Order.push_back(I);
  // Of equally accurate ones the fastest first, then the one that was named
  // first.
  std::sort(Order.begin(), Order.end(), [&](std::size_t X, std::size_t Y) {
    return std::tuple(-All[X].Db, *All[X].time(A), X) <
           std::tuple(-All[Y].Db, *All[Y].time(A), Y);
  });
  std::vector<std::size_t> Front;
  for (const std::size_t I : Order)
    if (Front.empty() ||
        *All[I].time(A) < *All[Front.back()].time(A) * (1 - SameTime))
      Front.push_back(I);
  return Front;
}

std::optional<std::size_t> recommend(const std::vector<Candidate> &All,
                                     TimeAxis A, double FloorDb) {
  std::optional<double> Least;
  for (const Candidate &C : All)
    if (C.time(A) && C.Db >= FloorDb)
      Least = std::min(Least.value_or(*C.time(A)), *C.time(A));
  std::optional<std::size_t> Best;
  const auto Key = [&](std::size_t I) {
    return std::tuple(-All[I].Db, All[I].Chosen.size(), *All[I].time(A));
  };
  for (std::size_t I = 0; I < All.size(); ++I)
    if (All[I].time(A) && All[I].Db >= FloorDb &&
        *All[I].time(A) <= *Least * (1 + SameTime) &&
        (!Best || Key(I) < Key(*Best)))
      Best = I;
  return Best;
}

std::vector<Setting> productOfFronts(const std::vector<Knob> &Knobs,
                                     const std::vector<Candidate> &All,
                                     double FloorDb, std::size_t Most) {
  // Values by what they save, so that the first is the first to go.
  struct KeptValue {
    double Saving;
    std::string Name, Text; // of equal savings these decide
    KnobId Of;
    std::size_t Value;
  };
  std::vector<KeptValue> Kept;
  for (const Knob &K : Knobs) {
    std::vector<Candidate> Own;
    for (const Candidate &C : All)
      if (C.Chosen.size() == 0 ||
          (C.Chosen.size() == 1 && C.Chosen.place(K.Id) != 0))
        Own.push_back(C);
    std::map<std::size_t, double> Savings;
    for (const TimeAxis A :
         {TimeAxis::Cycles, TimeAxis::EqualArea, TimeAxis::Cores})
      for (const std::size_t I : paretoFront(Own, A))
        if (Own[I].Chosen.size() == 1 && Own[I].Db >= FloorDb) {
          double &Saved = Savings[Own[I].Chosen.place(K.Id)];
          if (Own.front().Chosen.size() == 0 && Own.front().time(A))
            Saved = std::max(Saved, 1 - *Own[I].time(A) / *Own.front().time(A));
        }
    for (const auto &[Value, Saving] : Savings)
      Kept.push_back({Saving, K.Name, K.Values[Value], K.Id, Value});
  }
  std::ranges::sort(Kept, {}, [](const KeptValue &V) {
    return std::tie(V.Saving, V.Name, V.Text);
  });

  const auto Product = [&] {
    std::vector<Setting> Settings{Setting()};
    for (const Knob &K : Knobs) {
      const std::vector<Setting> Before = Settings;
      for (const KeptValue &V : Kept)
        if (V.Of == K.Id)
          for (const Setting &S : Before)
            Settings.push_back(S.with(K, V.Value));
    }
    std::erase_if(Settings, [](const Setting &S) { return S.size() < 2; });
    return Settings;
  };
  std::vector<Setting> Settings = Product();
  while (Settings.size() > Most) {
    Kept.erase(Kept.begin());
    Settings = Product();
  }
  return Settings;
}

} // namespace vorion::splat
