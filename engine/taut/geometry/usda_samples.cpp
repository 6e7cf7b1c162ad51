#include "taut/geometry/private/usda_samples.h"

#include <fmt/format.h>

#include "taut/core/error.h"

namespace taut::geometry {
namespace {

constexpr std::size_t shortText = 2048;  // [bytes] kept in memory
constexpr std::size_t blockText = std::size_t{1} << 18U;

}  // namespace

void UsdaText::add(std::string_view text) {
    text_ += text;
    if (text_.size() >= blockText) flush();
}

void UsdaText::add(ScratchFile::Piece piece) {
    flush();
    scratch_.copy(piece, file_);
}

void UsdaText::flush() {
    file_.write(text_);
    text_.clear();
}

void UsdaSamples::set(std::int64_t frame, std::string_view value, ScratchFile& scratch) {
    // A part that stayed and then moves does not begin to move before.
    if (!isHeld_ && !samples_.empty() && samples_.back().frame < now_ && now_ < frame) {
        samples_.push_back(samples_.back());
        samples_.back().frame = now_;
    }
    Sample sample{frame, {}};
    if (value.size() <= shortText)
        sample.text = value;
    else
        sample.piece = scratch.add(value);
    samples_.push_back(std::move(sample));
    now_ = frame;
}

void UsdaSamples::update(std::int64_t frame, std::string_view value, ScratchFile& scratch) {
    if (!samples_.empty() && samples_.back().text == value)
        keep(frame);
    else
        set(frame, value, scratch);
}

void UsdaSamples::put(UsdaText& to, const Sample& sample) const {
    if (sample.piece.size > 0)
        to.add(sample.piece);
    else
        to.add(sample.text);
}

void UsdaSamples::write(UsdaText& to, int depth, std::string_view declaration, std::string_view metadata) const {
    TAUT_EXPECTS(!samples_.empty());
    const std::string indent(static_cast<std::size_t>(depth) * 4, ' ');
    const std::string more = metadata.empty() ? "" : fmt::format(" (\n{0}    {1}\n{0})", indent, metadata);
    if (samples_.size() == 1) {
        to.add(fmt::format("{}{} = ", indent, declaration));
        put(to, samples_.front());
        to.add(more + "\n");
        return;
    }
    if (!more.empty()) to.add(fmt::format("{}{}{}\n", indent, declaration, more));
    to.add(fmt::format("{}{}.timeSamples = {{\n", indent, declaration));
    for (const Sample& sample : samples_) {
        to.add(fmt::format("{}    {}: ", indent, sample.frame));
        put(to, sample);
        to.add(",\n");
    }
    to.add(indent + "}\n");
}

}  // namespace taut::geometry
