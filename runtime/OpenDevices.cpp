#include "OpenDevices.h"

#include "Device.h"

#include <cstdlib>

using namespace vorion::runtime;

OpenDevices &OpenDevices::all() {
  static OpenDevices *const All = [] {
    std::atexit([] { all().lastWords(); });
    return new OpenDevices();
  }();
  return *All;
}

void OpenDevices::add(Device *D) {
  const std::lock_guard Held(Mutex);
  Open.insert(D);
}

void OpenDevices::remove(Device *D) {
  const std::lock_guard Held(Mutex);
  Open.erase(D);
}

void OpenDevices::lastWords() {
  const std::lock_guard Held(Mutex);
  for (Device *D : Open)
    D->lastWord();
}
