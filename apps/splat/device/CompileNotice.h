/// Tells a user who waits that kernels are being compiled.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace vorion::splat {

/// If it lives for two seconds, and a program is being compiled then, the
/// status line (StatusLine.h) says so until something else is shown there.
class CompileNotice {
public:
  /// \p What is compiled if \p IsCompiling, which another thread calls.
  CompileNotice(std::string What, std::function<bool()> IsCompiling);
  CompileNotice(const CompileNotice &) = delete;
  CompileNotice &operator=(const CompileNotice &) = delete;
  ~CompileNotice();

private:
  void waitAndTell();

  std::string What;
  std::function<bool()> IsCompiling;
  std::mutex Lock;
  std::condition_variable Ended;
  bool IsOver = false;
  std::thread Waiting;
};

} // namespace vorion::splat
