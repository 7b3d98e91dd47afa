// Methods whose libraries bring so much along that they stay out of the program: each is a library of its
// own.
#pragma once

#include <memory>

#include "adapters/adapter.hpp"

namespace hullbench {

/// The method in the shared library `file`, which add_adapter(... MODULE) made, or in the one of its name in
/// PREFIX/lib/hullbench beside an installed program PREFIX/bin/NAME. It is loaded into this process here, for
/// good. Throws NotInstalled with the remedy `install` when it cannot be loaded.
std::unique_ptr<Adapter> load_adapter_module(const char* file, const char* install);

}  // namespace hullbench
