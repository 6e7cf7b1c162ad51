#include "taut/regression/manifest.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "taut/core/error.h"
#include "taut/core/private/file_batch.h"
#include "taut/core/whole_file.h"

namespace taut::regression {
namespace {

using Json = nlohmann::ordered_json;

constexpr int schema = 1;

// Reads an object member by member and says where something is wrong: "scenarios.flag.state.ticks".
class Reader {
  public:
    Reader(const Json& json, std::string file, std::string place)
        : json_(json), file_(std::move(file)), place_(std::move(place)) {
        if (!json_.is_object()) fail("is no object");
    }

    std::string text(const char* key) const {
        const Json& value = member(key);
        if (!value.is_string()) below(key, "is no text");
        return value.get<std::string>();
    }
    std::string reason(const char* key) const {
        std::string why = text(key);
        if (why.find_first_not_of(" \t\r\n") == std::string::npos) below(key, "is empty: a golden has a reason");
        return why;
    }
    std::string hash(const char* key) const {
        std::string value = text(key);
        if (value.size() != 16 || value.find_first_not_of("0123456789abcdef") != std::string::npos)
            below(key, "is no hash of 16 hexadecimal digits");
        return value;
    }
    std::int64_t whole(const char* key, std::int64_t least) const {
        const Json& value = member(key);
        if (!value.is_number_integer() || value.get<std::int64_t>() < least)
            below(key, fmt::format("is no whole number of at least {}", least));
        return value.get<std::int64_t>();
    }
    int bits(const char* key) const {
        const Json& value = member(key);
        if (!value.is_number_integer() || !world::areBits(value.get<std::int64_t>()))
            below(key, fmt::format("is no whole number from 1 to {}", world::mostBits));
        return value.get<int>();
    }
    double number(const char* key) const {
        const Json& value = member(key);
        if (!value.is_number() || value.get<double>() < 0.0) below(key, "is no number of at least 0");
        return value.get<double>();
    }
    bool has(const char* key) const { return json_.contains(key); }
    Reader object(const std::string& key) const { return {member(key), file_, join(key)}; }
    template <class Call>
    void each(const Call& call) const {
        for (const auto& [key, value] : json_.items()) call(key, Reader(value, file_, join(key)));
    }
    [[noreturn]] void below(const std::string& key, const std::string& what) const {
        throw core::Error(core::ErrorKind::badContent, fmt::format("{}: {} {}", file_, join(key), what));
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw core::Error(core::ErrorKind::badContent,
                          fmt::format("{}: {} {}", file_, place_.empty() ? "the content" : place_, what));
    }
    std::string join(const std::string& key) const { return place_.empty() ? key : place_ + "." + key; }
    const Json& member(const std::string& key) const {
        if (!json_.contains(key)) below(key, "is missing");
        return json_.at(key);
    }

    const Json& json_;
    std::string file_, place_;
};

GoldenState stateIn(const Reader& reader) {
    return {reader.reason("why"),   reader.hash("last_hash"), reader.whole("ticks", 0),
            reader.text("program"), reader.text("compiler"),  reader.text("simd")};
}

// Names become file names.
bool isPlainName(const std::string& name) {
    return !name.empty() && name[0] != '.' && name.find_first_of("/\\") == std::string::npos;
}

GoldenScenario scenarioIn(const Reader& reader) {
    GoldenScenario scenario;
    scenario.bits = reader.has("bits") ? reader.bits("bits") : 1;
    if (reader.has("state")) scenario.state = stateIn(reader.object("state"));
    if (!reader.has("pictures")) return scenario;
    reader.object("pictures").each([&](const std::string& key, const Reader& picture) {
        if (!isPlainName(key)) reader.below("pictures", fmt::format("has the name '{}'", key));
        scenario.pictures[key] = {picture.reason("why"), picture.hash("state_hash"), picture.text("renderer")};
    });
    return scenario;
}

// Older files have no bound of the mean.
image::Tolerance toleranceIn(const Reader& reader, const image::Tolerance& ours) {
    const auto channel = [&](const char* key) {
        return static_cast<int>(std::min<std::int64_t>(255, reader.whole(key, 0)));
    };
    return {channel("channel"), reader.number("share"), channel("tile_channel"), reader.number("tile_share"),
            reader.has("offset") ? reader.number("offset") : ours.offset};
}

Json jsonOf(const image::Tolerance& tolerance) {
    return {{"channel", tolerance.channel},
            {"share", tolerance.share},
            {"tile_channel", tolerance.tileChannel},
            {"tile_share", tolerance.tileShare},
            {"offset", tolerance.offset}};
}

Json jsonOf(const GoldenScenario& scenario) {
    Json json = Json::object();
    json["bits"] = scenario.bits;
    if (const auto& state = scenario.state)
        json["state"] = {{"why", state->why},         {"ticks", state->ticks},       {"last_hash", state->lastHash},
                         {"program", state->program}, {"compiler", state->compiler}, {"simd", state->simd}};
    for (const auto& [key, picture] : scenario.pictures)
        json["pictures"][key] = {
            {"why", picture.why}, {"state_hash", picture.stateHash}, {"renderer", picture.renderer}};
    return json;
}

}  // namespace

std::filesystem::path GoldenFolder::picture(const std::string& scenario, const std::string& key) const {
    return path / scenario / (key + ".png");
}
std::filesystem::path GoldenFolder::stored(const std::string& scenario, const std::string& key) const {
    return path / scenario / (key + ".state");
}
std::filesystem::path GoldenFolder::tape(const std::string& scenario) const {
    return path / scenario / "state.tape";
}
std::filesystem::path GoldenFolder::text(const std::string& scenario) const {
    return path / scenario / "scenario.toml";
}

std::string nameOfRenderer(const std::string& renderer) {
    return renderer.substr(0, std::min(renderer.find(" ("), renderer.find(", ")));
}

bool isSameRenderer(const std::string& a, const std::string& b) {
    return nameOfRenderer(a) == nameOfRenderer(b);
}

const image::Tolerance& toleranceFor(const Manifest& manifest, const GoldenPicture& golden,
                                     const std::string& renderer) {
    return isSameRenderer(golden.renderer, renderer) ? manifest.tolerance : manifest.otherRenderer;
}

Manifest readManifest(const GoldenFolder& folder) {
    if (core::FileBatch::isPending(folder.path))
        throw core::Error(core::ErrorKind::inputOutput,
                          fmt::format("{}: an update of goldens was broken off here; taut test … --update NAME --why "
                                      "\"…\" finishes it, and so does the one that is under way",
                                      folder.path.string()));
    std::error_code ignored;
    if (!std::filesystem::exists(folder.manifest(), ignored) && !ignored) return {};
    return readManifestText(core::fileContent(folder.manifest(), std::uint64_t{64} << 20U), folder.manifest().string());
}

Manifest readManifestText(const std::string& content, const std::string& file) {
    Manifest manifest;
    Json json;
    try {
        json = Json::parse(content);
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t at = std::min<std::size_t>(error.byte, content.size());
        const auto line = 1 + std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        throw core::Error(core::ErrorKind::badContent, core::at({file, static_cast<int>(line)}) + "this is no JSON");
    } catch (const nlohmann::json::out_of_range&) {
        throw core::Error(core::ErrorKind::badContent, core::at({file}) + "it has a number beyond all bounds");
    }
    const Reader reader(json, file, "");
    if (const std::int64_t version = reader.whole("schema", 1); version != schema)
        reader.below("schema", fmt::format("is {}, and this taut reads {}", version, schema));
    if (reader.has("tolerance")) manifest.tolerance = toleranceIn(reader.object("tolerance"), manifest.tolerance);
    if (reader.has("tolerance_of_another_renderer"))
        manifest.otherRenderer = toleranceIn(reader.object("tolerance_of_another_renderer"), manifest.otherRenderer);
    if (reader.has("scenarios"))
        reader.object("scenarios").each([&](const std::string& name, const Reader& scenario) {
            if (!isPlainName(name)) reader.below("scenarios", fmt::format("has the name '{}'", name));
            manifest.scenarios[name] = scenarioIn(scenario);
        });
    return manifest;
}

void writeManifest(const std::filesystem::path& file, const Manifest& manifest) {
    Json json;
    json["schema"] = schema;
    json["tolerance"] = jsonOf(manifest.tolerance);
    json["tolerance_of_another_renderer"] = jsonOf(manifest.otherRenderer);
    json["scenarios"] = Json::object();
    for (const auto& [name, scenario] : manifest.scenarios) json["scenarios"][name] = jsonOf(scenario);
    core::prepareFolderOf(file);
    core::writeWholeFile(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace taut::regression
