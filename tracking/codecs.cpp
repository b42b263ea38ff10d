// SPDX-License-Identifier: MIT
#include "tracking/codecs.hpp"

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace slamscope::tracking {
namespace {

const Codecs& open() {
  // Found by the program's run path. Never closed: its objects live as long as the program.
  void* const library = dlopen("libslamscope_codecs.so", RTLD_NOW | RTLD_LOCAL);
  void* const symbol = library == nullptr ? nullptr : dlsym(library, "slamscope_codecs");
  if (symbol == nullptr)
    throw std::runtime_error(std::string("pictures and videos can't be read or written: ") +
                             dlerror() +
                             " (it belongs beside the program: build the target slamscope_codecs)");
  return *reinterpret_cast<const Codecs* (*)()>(symbol)();
}

}  // namespace

const Codecs& codecs() {
  static const Codecs& opened = open();
  return opened;
}

}  // namespace slamscope::tracking
