#include "taut/image/private/several_sinks.h"

#include <utility>

#include "taut/core/error.h"

namespace taut::image {

SeveralSinks::SeveralSinks(std::vector<std::unique_ptr<FrameSink>> sinks) : sinks_(std::move(sinks)) {
    TAUT_EXPECTS(!sinks_.empty());
}

void SeveralSinks::write(std::int64_t frame, const Image& image) {
    for (const auto& sink : sinks_) sink->write(frame, image);
}

void SeveralSinks::finish() {
    for (const auto& sink : sinks_) sink->finish();
}

std::filesystem::path SeveralSinks::companion(const std::string& name) const {
    return sinks_.front()->companion(name);
}

}  // namespace taut::image
