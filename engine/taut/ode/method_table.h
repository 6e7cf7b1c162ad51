// All methods by name. The table is a value: a program may add methods of its own. A new method of the engine is one
// file, with its class and its row, and one line in method_table.cpp.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "taut/core/table.h"
#include "taut/ode/first_order_method.h"
#include "taut/ode/method.h"

namespace taut::ode {

class Methods : public core::Table<MethodInfo> {
  public:
    // Adds a row at the end. Expects a name that no other row has, a title and limits.
    void add(const MethodInfo& method);

    // For second-order systems. Expects a name from the table.
    template <class Real>
    std::unique_ptr<Method<Real>> make(std::string_view name, const MethodOptions& options = {}) const;

    // For any y' = f(t, y). Throws core::Error(usage) if no method has that name, or if it needs x'' = a.
    template <class Real>
    std::unique_ptr<FirstOrderMethod<Real>> makeFirstOrder(std::string_view name) const;
};

// The engine's own.
const Methods& builtInMethods();

// The same of the engine's own methods.
std::span<const MethodInfo> methods();
const MethodInfo* findMethod(std::string_view name);
template <class Real>
std::unique_ptr<Method<Real>> makeMethod(std::string_view name, const MethodOptions& options = {});
template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeFirstOrderMethod(std::string_view name);

}  // namespace taut::ode
