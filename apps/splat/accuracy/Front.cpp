#include "accuracy/Front.h"

#include "study/ParetoFront.h"

#include <algorithm>
#include <cmath>
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
  std::map<double, double> Fastest; // of equally accurate ones
  std::vector<std::size_t> Order;
  for (std::size_t I = 0; I < All.size(); ++I)
    if (const auto &Time = All[I].Time) {
      Order.push_back(I);
      const auto [At, IsNew] = Fastest.try_emplace(All[I].Merit, *Time);
      At->second = std::min(At->second, *Time);
    }
  // Of equally accurate ones those that are as fast as the fastest first, and
  // of these the one that changes least; then the one that was named first.
  std::ranges::sort(Order, {}, [&](std::size_t I) {
    const Judged &J = All[I];
    const bool IsSlower = *J.Time > Fastest[J.Merit] * (1 + SameTime);
    return std::tuple(-J.Merit, IsSlower, IsSlower ? 0 : J.Changes, *J.Time, I);
  });
  return paretoFront(Order, [&All](std::size_t A, std::size_t B) {
    return *All[B].Time >= *All[A].Time * (1 - SameTime);
  });
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
