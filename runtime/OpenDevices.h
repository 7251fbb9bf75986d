/// The devices that a program has open.
#pragma once

#include <mutex>
#include <set>

namespace vorion::runtime {

class Device;

/// A program may end without closing its devices, as one of OpenCL does. What
/// watches them has its last word then.
class OpenDevices {
public:
  /// Those of this process. Never destroyed: a program's static objects may
  /// close devices late.
  static OpenDevices &all();

  void add(Device *D);
  void remove(Device *D);

private:
  void lastWords();

  std::mutex Mutex;
  std::set<Device *> Open;
};

} // namespace vorion::runtime
