#include "taut/pipeline/run_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"

namespace taut::pipeline {
namespace {

constexpr std::uint64_t mostBytes = std::uint64_t{1} << 30U;  // of a record

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
    throw core::Error(core::ErrorKind::badContent, fmt::format("{}: no record of a run: {}", path.string(), why));
}

constexpr std::int64_t mostFrames = std::int64_t{1} << 40U;

using Json = nlohmann::ordered_json;  // layers in the order in which pictures are summed up

std::int64_t frameIn(const Json& json, const std::filesystem::path& path) {
    if (!json.is_number_integer()) refuse(path, "a number of a frame is none");
    const auto frame = json.get<std::int64_t>();
    if (frame < 0 || frame > mostFrames) refuse(path, "a number of a frame is none");
    return frame;
}

// As many hexadecimal digits as it has.
template <class Number>
void takeHash(Number& hash, const std::string& text, const std::filesystem::path& path) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
    if (error != std::errc() || end != text.data() + text.size() || text.size() != 2 * sizeof hash)
        refuse(path, fmt::format("\"{}\" is no hash", text.substr(0, 40)));
}

render::RendererInfo rendererIn(const Json& gl) {
    return {gl.at("backend").get<std::string>(), gl.at("vendor").get<std::string>(),
            gl.at("renderer").get<std::string>(), gl.at("version").get<std::string>()};
}

PartRecord recordIn(const Json& json, const std::filesystem::path& path) {
    PartRecord record;
    record.path = path;
    record.ended = json.at("ended").get<std::string>();
    record.scene = json.at("scene").get<std::string>();
    record.program = json.at("program").get<std::string>();
    record.bits = json.value("bits", 1);
    if (!json.at("gl").is_null()) record.renderer = rendererText(rendererIn(json.at("gl")));
    record.size = fmt::format("{} x {}", json.at("size").at(0).get<int>(), json.at("size").at(1).get<int>());
    record.fps = json.at("fps").get<double>();
    record.hasAlpha = !json.at("layers").at("alpha").is_null();
    for (const auto& [kind, facts] : json.at("layers").items())
        if (kind != "alpha" && !facts.is_null()) record.besides.push_back(kind);
    const std::filesystem::path output = json.at("output").get<std::string>();
    record.files = output.extension() == ".png" ? output.filename().string() : image::FramePattern("folder").name();
    const Json& frames = json.at("frames");
    record.first = frameIn(frames.at("first"), path);
    record.last = frameIn(frames.at("last"), path);
    record.count = frames.contains("of") ? frameIn(frames.at("of"), path) : record.last + 1;
    record.key = json.value("run", "");
    for (const Json& hash : json.at("state_hash"))
        takeHash(record.hashes.emplace_back(), hash.get<std::string>(), path);
    for (const Json& sum : json.value("picture_crc32", Json::array()))
        takeHash(record.pictures.emplace_back(), sum.get<std::string>(), path);
    if (record.last < record.first || record.count <= record.last || !(record.fps > 0.0))
        refuse(path, "its frames are none");
    return record;
}

// The frames that a file of that name records; none for other names. All of a run has no frames in its name.
bool isRecordName(const std::string& name) {
    if (name == "run.json") return true;
    if (!name.starts_with("run_") || !name.ends_with(".json")) return false;
    const std::string_view span = std::string_view(name).substr(4, name.size() - 9);
    const std::size_t dash = span.find('-');
    const auto isNumber = [](std::string_view text) {
        return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
    };
    return dash != std::string_view::npos && isNumber(span.substr(0, dash)) && isNumber(span.substr(dash + 1));
}

}  // namespace

std::int64_t PartRecord::lastDrawn() const {
    if (ended == "begun") return first - 1;
    return std::max(first - 1, std::min(last, static_cast<std::int64_t>(hashes.size()) - 1));
}

std::optional<std::uint32_t> PartRecord::pictureOf(std::int64_t frame) const {
    const auto i = static_cast<std::size_t>(frame - first);
    return frame >= first && i < pictures.size() ? std::optional(pictures[i]) : std::nullopt;
}

std::string hexadecimal(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

std::string rendererText(const std::optional<render::RendererInfo>& info) {
    if (!info) return "";
    return fmt::format("{}, {}, {}, {}", info->backend, info->vendor, info->renderer, info->version);
}

std::string partName(std::int64_t first, std::int64_t last, const std::string& stem, const std::string& extension) {
    return fmt::format("{}_{}-{}{}", stem, first, last, extension);
}

PartRecord readPartRecord(const std::filesystem::path& path) {
    const std::string text = core::fileContent(path, mostBytes);
    try {
        return recordIn(Json::parse(text), path);
    } catch (const nlohmann::json::exception& error) {
        refuse(path, error.what());
    }
}

namespace {

// The records of pictures, and unreadable ones.
std::vector<PartRecord> recordsIn(const std::filesystem::path& folder) {
    std::vector<PartRecord> records;
    std::error_code ignored;  // a missing folder has none
    for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, ignored)) {
        if (!isRecordName(entry.path().filename().string())) continue;
        const std::filesystem::path path = folder / entry.path().filename();
        try {
            PartRecord record = readPartRecord(path);
            if (!record.renderer.empty()) records.push_back(std::move(record));
        } catch (const core::Error& error) {
            if (!core::isThere(path)) continue;  // a part that begins anew has taken it away
            records.emplace_back();
            records.back().path = path;
            records.back().fault = error.what();
        }
    }
    return records;
}

}  // namespace

std::vector<std::string> recordedFiles(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const PartRecord& record : recordsIn(folder))
        if (record.fault.empty()) names.insert(record.files);
    return {names.begin(), names.end()};
}

std::vector<PartRecord> partRecords(const image::FramePattern& pattern) {
    std::vector<PartRecord> records = recordsIn(pattern.folder());
    std::erase_if(
        records,
        [name = pattern.name()](const PartRecord& record) { return record.fault.empty() && record.files != name; });
    std::ranges::sort(records, [](const PartRecord& a, const PartRecord& b) {
        return std::pair(a.first, a.path) < std::pair(b.first, b.path);
    });
    return records;
}

std::string differenceOf(const PartRecord& a, const PartRecord& b) {
    if (a.bits != b.bits) return fmt::format("results of bits {} and {}", a.bits, b.bits);
    if (a.size != b.size) return fmt::format("{} and {} pixels", a.size, b.size);
    if (a.fps != b.fps) return fmt::format("{} and {} pictures a second", a.fps, b.fps);
    if (a.count != b.count) return fmt::format("runs of {} and {} frames", a.count, b.count);
    if (a.key.empty() || a.key != b.key)
        return a.scene == b.scene ? "other settings of scene, timeline or look"
                                  : fmt::format("scenes {} and {}", a.scene, b.scene);
    if (a.program != b.program) return fmt::format("drawn by {} and by {}", a.program, b.program);
    if (a.renderer != b.renderer) return fmt::format("drawn by {} and by {}", a.renderer, b.renderer);
    const auto [x, y] = std::mismatch(
        a.hashes.begin(), a.hashes.begin() + static_cast<std::ptrdiff_t>(std::min(a.hashes.size(), b.hashes.size())),
        b.hashes.begin());
    if (y != b.hashes.end() && x != a.hashes.end())
        return fmt::format("other states from frame {} on", x - a.hashes.begin());
    return "";
}

std::vector<FrameSpan> framesWithoutRecord(const std::vector<PartRecord>& records, const FrameSpan& wanted) {
    std::vector<FrameSpan> drawn;
    for (const PartRecord& record : records)
        if (record.lastDrawn() >= record.first) drawn.push_back({record.first, record.lastDrawn()});
    std::ranges::sort(drawn, {}, &FrameSpan::first);
    std::vector<FrameSpan> missing;
    std::int64_t next = wanted.first;
    for (const FrameSpan& span : drawn) {
        if (span.first > wanted.last) break;
        if (span.first > next) missing.push_back({next, span.first - 1});
        next = std::max(next, span.last + 1);
    }
    if (next <= wanted.last) missing.push_back({next, wanted.last});
    return missing;
}

std::vector<FrameSpan> framesMissing(const std::vector<std::int64_t>& there, const FrameSpan& wanted) {
    std::vector<FrameSpan> missing;
    std::int64_t next = wanted.first;
    for (const std::int64_t frame : there) {
        if (frame < next) continue;
        if (frame > wanted.last) break;
        if (frame > next) missing.push_back({next, frame - 1});
        next = frame + 1;
    }
    if (next <= wanted.last) missing.push_back({next, wanted.last});
    return missing;
}

std::string inWords(const std::vector<FrameSpan>& spans) {
    TAUT_EXPECTS(!spans.empty());
    constexpr std::size_t most = 8;
    const bool isOne = spans.size() == 1 && spans.front().first == spans.front().last;
    std::string text = isOne ? "frame " : "frames ";
    for (std::size_t i = 0; i < std::min(spans.size(), most); ++i) {
        const FrameSpan& span = spans[i];
        text += fmt::format("{}{}{}", i > 0 ? ", " : "", span.first,
                            span.first == span.last ? "" : fmt::format("-{}", span.last));
    }
    return spans.size() > most ? fmt::format("{} and {} more spans", text, spans.size() - most) : text;
}

void writeJoinedJson(const std::function<void(std::string_view)>& write, const std::vector<PartRecord>& records,
                     const FrameSpan& frames) {
    TAUT_EXPECTS(!records.empty());
    const auto longest = std::ranges::max_element(
        records, [](const PartRecord& a, const PartRecord& b) { return a.hashes.size() < b.hashes.size(); });
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(core::fileContent(longest->path, mostBytes));
    json["frames"] = {{"first", frames.first}, {"last", frames.last}, {"of", longest->count}};
    json["joined"] = nlohmann::ordered_json::array();
    for (const PartRecord& record : records) json["joined"].push_back(record.path.filename().string());
    json.erase("picture_crc32");  // of that part alone
    write(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace taut::pipeline
