/// What a server process and its client send each other over a socket: texts,
/// each after its length, made of numbers and texts. PoCL's driver does not
/// link a library of ours, so all is here.
#pragma once

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <type_traits>

namespace vorion {

/// The argument of a tool that is to serve calls over its standard input.
inline constexpr const char *ServeCalls = "--serve-calls";

/// Whether \p Bytes bytes have gone, of which \p Move moves some at a time: it
/// gets how many have gone, and gives what send() and recv() give.
template <typename Function>
bool allMoved(std::size_t Bytes, const Function &Move) {
  for (std::size_t Done = 0; Done < Bytes;) {
    const ssize_t Some = Move(Done);
    if (Some < 0 && errno == EINTR)
      continue;
    if (Some <= 0)
      return false;
    Done += static_cast<std::size_t>(Some);
  }
  return true;
}

/// Whether all of \p Text went through \p Socket. No signal says that nobody
/// reads there.
inline bool sendText(int Socket, std::string_view Text) {
  const auto Length = static_cast<uint64_t>(Text.size());
  std::string All(sizeof(Length), '\0');
  std::memcpy(All.data(), &Length, sizeof(Length));
  All += Text;
  return allMoved(All.size(), [&](std::size_t Done) {
    return ::send(Socket, All.data() + Done, All.size() - Done, MSG_NOSIGNAL);
  });
}

/// The next text of \p Socket; nothing if the other side is gone.
inline std::optional<std::string> receiveText(int Socket) {
  const auto Fill = [Socket](char *To, std::size_t Bytes) {
    return allMoved(Bytes, [&](std::size_t Done) {
      return ::recv(Socket, To + Done, Bytes - Done, 0);
    });
  };
  uint64_t Length = 0;
  if (!Fill(reinterpret_cast<char *>(&Length), sizeof(Length)))
    return std::nullopt;
  std::string Text(Length, '\0');
  if (!Fill(Text.data(), Text.size()))
    return std::nullopt;
  return Text;
}

/// The length of a text in C that is null.
inline constexpr uint64_t NoText = ~uint64_t{0};

/// Writes numbers, as 64 bits, and texts, each after its length. A structure
/// has one function template visit(Archive &, Structure &) that names its
/// fields, which serves for FieldWriter, FieldReader and FieldReleaser.
class FieldWriter {
public:
  std::string Bytes;

  template <typename Number> void number(Number &Value) {
    raw(static_cast<uint64_t>(Value));
  }
  void text(std::string &Text) {
    raw(Text.size());
    Bytes += Text;
  }
  /// May be null.
  void text(char *&Text) {
    raw(Text ? std::strlen(Text) : NoText);
    if (Text)
      Bytes += Text;
  }
  template <typename Element, typename Number>
  void array(Element *&Elements, Number &Count) {
    number(Count);
    for (Number I = 0; I != Count; ++I)
      visit(*this, Elements[I]);
  }
  template <typename List> void list(List &Elements) {
    raw(Elements.size());
    for (auto &Element : Elements)
      visit(*this, Element);
  }

private:
  void raw(uint64_t Value) {
    Bytes.append(reinterpret_cast<const char *>(&Value), sizeof(Value));
  }
};

/// Reads what FieldWriter wrote. Bytes that are missing count as zeros, and
/// isDone() tells. Texts and arrays of C get memory of malloc().
class FieldReader {
public:
  explicit FieldReader(std::string_view Bytes) : Rest(Bytes) {}

  /// Whether all bytes were read, and none was missing.
  bool isDone() const { return Rest.empty() && !IsShort; }

  template <typename Number> void number(Number &Value) {
    Value = static_cast<Number>(raw());
  }
  void text(std::string &Text) { Text = take(raw()); }
  void text(char *&Text) {
    const uint64_t Size = raw();
    Text = nullptr;
    if (Size == NoText)
      return;
    const std::string_view Taken = take(Size);
    Text = strndup(Taken.data(), Taken.size());
  }
  template <typename Element, typename Number>
  void array(Element *&Elements, Number &Count) {
    Count = static_cast<Number>(count());
    Elements = Count
                   ? static_cast<Element *>(std::calloc(Count, sizeof(Element)))
                   : nullptr;
    for (Number I = 0; I != Count; ++I)
      visit(*this, Elements[I]);
  }
  template <typename List> void list(List &Elements) {
    Elements.resize(count());
    for (auto &Element : Elements)
      visit(*this, Element);
  }

private:
  uint64_t raw() {
    uint64_t Value = 0;
    if (Rest.size() < sizeof(Value)) {
      IsShort = true;
      return 0;
    }
    std::memcpy(&Value, Rest.data(), sizeof(Value));
    Rest.remove_prefix(sizeof(Value));
    return Value;
  }
  std::string_view take(uint64_t Size) {
    IsShort |= Size > Rest.size();
    const std::string_view Taken = Rest.substr(0, Size);
    Rest.remove_prefix(Taken.size());
    return Taken;
  }
  /// A number of elements. Each takes at least a number.
  uint64_t count() {
    const uint64_t Count = raw();
    if (Count <= Rest.size() / sizeof(uint64_t))
      return Count;
    IsShort = true;
    return 0;
  }

  std::string_view Rest;
  bool IsShort = false;
};

/// Frees the texts and arrays of C that FieldReader allocated.
class FieldReleaser {
public:
  template <typename Number> void number(Number &) {}
  void text(std::string &) {}
  void text(char *&Text) {
    std::free(Text);
    Text = nullptr;
  }
  template <typename Element, typename Number>
  void array(Element *&Elements, Number &Count) {
    for (Number I = 0; I != Count; ++I)
      visit(*this, Elements[I]);
    std::free(Elements);
    Elements = nullptr;
    Count = 0;
  }
  template <typename List> void list(List &Elements) {
    for (auto &Element : Elements)
      visit(*this, Element);
  }
};

template <typename Archive> void visit(Archive &A, std::string &Text) {
  A.text(Text);
}
template <typename Archive> void visit(Archive &A, std::size_t &Number) {
  A.number(Number);
}

/// All of \p Value as one text.
template <typename Structure> std::string textOf(Structure &Value) {
  FieldWriter Out;
  visit(Out, Value);
  return std::move(Out.Bytes);
}

/// Fills \p Value with what textOf() gave. False if \p Text is something else.
template <typename Structure>
bool isReadInto(Structure &Value, std::string_view Text) {
  FieldReader In(Text);
  visit(In, Value);
  return In.isDone();
}

/// How a line begins that says why the compiler of OpenCL programs gave no
/// answer: in build logs, and in what vorion-clang reads of them.
inline constexpr const char *CompilerProblem = "the compiler ";

/// How a server process ended, which the process that waits for it tells the
/// client over a second socket.
struct ServerEnd {
  /// As waitpid() gives it: an exit code or a signal.
  int WaitStatus = 0;
  /// What it had printed since its last response.
  std::string Printed;
};
template <typename Archive> void visit(Archive &A, ServerEnd &End) {
  A.number(End.WaitStatus);
  A.text(End.Printed);
}

} // namespace vorion
