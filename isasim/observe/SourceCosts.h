/// What the instructions of programs cost, listed by source line.
#pragma once

#include "mem/SourceLines.h"
#include "observe/CodeText.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vorion::isasim {

/// The lines of a source file; none if it cannot be read.
std::vector<std::string> sourceText(const std::string &Path);

/// \p Cost adds up by += and says whether it isNone().
template <typename Cost> class SourceCosts {
public:
  /// What follows is about \p Code.
  void select(const std::shared_ptr<const Image> &Code);
  /// Of an instruction of that program, by its number from the first executable
  /// segment on.
  Cost &of(uint32_t Number) { return Current->ByWord[Number]; }
  /// The same by its address.
  Cost &at(uint32_t Pc) { return of((Pc - Current->Low) / 4); }

  Cost total() const;
  /// Calls Use(program, pc, cost) for each instruction that cost something.
  template <typename Function> void forEach(Function Use) const;

  /// Every source file, each line with what it cost, and code without line
  /// numbers by function. \p Row gives a cost's columns, and as many blanks for
  /// none; \p Heading stands above them.
  std::string
  listing(const std::string &Heading,
          const std::function<std::string(const Cost &)> &Row) const;

  struct Program {
    std::shared_ptr<const Image> Code;
    std::unique_ptr<SourceLines> Source;
    uint32_t Low = 0;
    std::vector<Cost> ByWord;
  };

private:
  std::vector<std::unique_ptr<Program>> Programs;
  Program *Current = nullptr;
};

template <typename Cost>
void SourceCosts<Cost>::select(const std::shared_ptr<const Image> &Code) {
  for (const auto &P : Programs)
    if (P->Code == Code) {
      Current = P.get();
      return;
    }
  Programs.push_back(std::make_unique<Program>(Program{
      Code, std::make_unique<SourceLines>(Code), firstCode(*Code), {}}));
  Current = Programs.back().get();
  uint32_t High = Current->Low;
  for (const Image::Segment &S : Code->segments())
    if (S.Executable)
      High = std::max(High, S.Address + S.MemBytes);
  Current->ByWord.resize((High - Current->Low) / 4);
}

template <typename Cost>
template <typename Function>
void SourceCosts<Cost>::forEach(Function Use) const {
  for (const auto &P : Programs)
    for (size_t N = 0; N != P->ByWord.size(); ++N)
      if (!P->ByWord[N].isNone())
        Use(*P, static_cast<uint32_t>(P->Low + 4 * N), P->ByWord[N]);
}

template <typename Cost> Cost SourceCosts<Cost>::total() const {
  Cost All;
  forEach([&](const Program &, uint32_t, const Cost &C) { All += C; });
  return All;
}

template <typename Cost>
std::string SourceCosts<Cost>::listing(
    const std::string &Heading,
    const std::function<std::string(const Cost &)> &Row) const {
  std::map<std::string, std::map<unsigned, Cost>> Files;
  std::map<std::string, Cost> Others; // by function
  forEach([&](const Program &P, uint32_t Pc, const Cost &C) {
    if (const std::optional<SourcePlace> Place = P.Source->find(Pc)) {
      Files[Place->File][Place->Line] += C;
      return;
    }
    std::string Name = P.Code->symbolize(Pc);
    Name.resize(std::min(Name.size(), Name.find('+')));
    Others[Name.empty() ? P.Code->name() : Name] += C;
  });

  std::string Text;
  for (const auto &[File, Lines] : Files) {
    Cost Sum;
    for (const auto &[Line, C] : Lines)
      Sum += C;
    Text += fmt::format("\n{}{}{}\n", Heading, Row(Sum), File);
    const std::vector<std::string> Source = sourceText(File);
    // A file that is not there: the lines that cost something, by number.
    if (Source.empty())
      for (const auto &[Line, C] : Lines)
        Text += fmt::format("{}{:>5}\n", Row(C), Line);
    for (unsigned Line = 1; Line <= Source.size(); ++Line) {
      const auto Found = Lines.find(Line);
      Text += fmt::format("{}{:>5}  {}\n",
                          Row(Found == Lines.end() ? Cost() : Found->second),
                          Line, Source[Line - 1]);
    }
  }
  if (!Others.empty())
    Text += fmt::format("\n{}code without line numbers\n", Heading);
  for (const auto &[Name, C] : Others)
    Text += fmt::format("{}{}\n", Row(C), Name);
  return Text;
}

} // namespace vorion::isasim
