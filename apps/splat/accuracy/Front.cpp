#include "accuracy/Front.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace vorion::splat {

namespace {

std::vector<Judged> judgedByPsnr(const std::vector<Candidate> &All,
                                 TimeAxis A) {
  std::vector<Judged> Of;
  Of.reserve(All.size());
  for (const Candidate &C : All)
    Of.push_back({C.db(), C.time(A), C.Chosen.size()});
  return Of;
}

bool isSameTime(double Time, double Base) {
  return std::abs(Time / Base - 1) < SameTime;
}

} // namespace

std::vector<Judged> judged(const std::vector<Candidate> &All, ErrorKind K,
                           TimeAxis A) {
  std::vector<Judged> Of;
  Of.reserve(All.size());
  for (const Candidate &C : All) {
    const Errors &Worst =
        A == TimeAxis::Cores && C.CoresWorst ? *C.CoresWorst : C.Worst;
    const double Value = Worst[static_cast<std::size_t>(K)];
    Of.push_back(
        {moreIsBetter(K) ? Value : -Value, C.time(A), C.Chosen.size()});
  }
  return Of;
}

std::vector<std::size_t> paretoFront(const std::vector<Judged> &All) {
  std::vector<std::size_t> Order;
  for (std::size_t I = 0; I < All.size(); ++I)
    if (All[I].Time)
      Order.push_back(I);
  // Of equally accurate ones the fastest first, then the one that was named
  // first.
  std::ranges::sort(Order, {}, [&](std::size_t I) {
    return std::tuple(-All[I].Merit, *All[I].Time, I);
  });
  std::vector<std::size_t> Front;
  for (auto It = Order.begin(); It != Order.end();) {
    const Judged &Fastest = All[*It];
    const double Below = Front.empty()
                             ? std::numeric_limits<double>::infinity()
                             : *All[Front.back()].Time * (1 - SameTime);
    std::optional<std::size_t> Best;
    for (; It != Order.end() && All[*It].Merit == Fastest.Merit; ++It) {
      const Judged &J = All[*It];
      if (*J.Time < Below && *J.Time <= *Fastest.Time * (1 + SameTime) &&
          (!Best || J.Changes < All[*Best].Changes))
        Best = *It;
    }
    if (Best)
      Front.push_back(*Best);
  }
  return Front;
}

std::vector<std::size_t> paretoFront(const std::vector<Candidate> &All,
                                     TimeAxis A) {
  return paretoFront(judgedByPsnr(All, A));
}

std::optional<std::size_t> recommend(const std::vector<Judged> &All,
                                     double Floor) {
  std::optional<std::size_t> Fastest;
  for (const std::size_t I : paretoFront(All))
    if (All[I].Merit >= Floor)
      Fastest = I;
  return Fastest;
}

std::optional<std::size_t> recommend(const std::vector<Candidate> &All,
                                     TimeAxis A, double FloorDb) {
  return recommend(judged(All, ErrorKind::Psnr, A), FloorDb);
}

std::vector<FloorStep> recommendations(const std::vector<Judged> &All) {
  std::vector<FloorStep> Steps;
  for (const std::size_t I : paretoFront(All))
    Steps.push_back({All[I].Merit, I});
  std::ranges::reverse(Steps);
  return Steps;
}

std::vector<std::size_t> sameTimeAs(const Candidate &Base,
                                    const std::vector<Candidate> &All,
                                    TimeAxis A) {
  std::vector<std::size_t> Same;
  for (std::size_t I = 0; I < All.size(); ++I)
    if (All[I].Chosen.size() == 1 && All[I].time(A) && Base.time(A) &&
        isSameTime(*All[I].time(A), *Base.time(A)))
      Same.push_back(I);
  return Same;
}

std::vector<Setting> productOfFronts(const std::vector<Knob> &Knobs,
                                     const std::vector<Candidate> &All,
                                     double FloorDb, std::size_t Most) {
  // Values by what they save, so that the first is the first to go.
  struct KeptValue {
    double Saving;
    std::string Name, Text; // of equal savings these decide
    KnobId Id;
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
    for (std::size_t N = 0; N < TimeAxes; ++N) {
      const auto A = static_cast<TimeAxis>(N);
      for (const std::size_t I : paretoFront(Own, A))
        if (Own[I].Chosen.size() == 1 && Own[I].db() >= FloorDb) {
          double &Saved = Savings[Own[I].Chosen.place(K.Id)];
          if (Own.front().Chosen.size() == 0 && Own.front().time(A))
            Saved = std::max(Saved, 1 - *Own[I].time(A) / *Own.front().time(A));
        }
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
        if (V.Id == K.Id)
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
