// Replaces context_osmesa.cpp if OSMesa is not installed.
#include <vector>

#include "taut/core/error.h"
#include "taut/render/private/context.h"

namespace taut::render {

std::vector<Backend> backends() {
    return {Backend::egl};
}

std::unique_ptr<Context> makeOsmesaContext() {
    throw core::Error(core::ErrorKind::noRenderer, "no renderer: this build has no OSMesa; use --gl egl");
}

}  // namespace taut::render
