// The one way from JavaScript into the engine: a call by name with JSON, to which JSON is the answer.
#include <exception>
#include <filesystem>
#include <memory>
#include <vector>

#include "game/web/fabrics.h"
#include "game/web/object.h"
#include "game/web/session_object.h"
#include "game/web/tapes.h"
#include "game/web/world_object.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"

namespace taut::web {
namespace {

std::vector<std::unique_ptr<Object>> objects;  // by their numbers; null: gone

Json made(std::unique_ptr<Object> object) {
    objects.push_back(std::move(object));
    return objects.size() - 1;
}

// The fabrics that scenes may name, where read() looks for them.
void layOutFabrics() {
    std::filesystem::create_directories("/taut/fabrics");
    for (const Fabric& fabric : fabrics) core::writeWholeFile(std::string("/taut/fabrics/") + fabric.file, fabric.text);
}

Json answerTo(const std::string& what, const Json& with) {
    if (what == "start") return layOutFabrics(), Json();
    if (what == "World") return made(std::make_unique<WorldObject>(with));
    if (what == "Session") return made(std::make_unique<SessionObject>(with));
    if (what == "recordTape") return recordedTape(with);
    if (what == "replayTape") return replayedTape(with);
    std::unique_ptr<Object>& object = objects.at(with.at("object"));
    if (what == "free") return object.reset(), Json();
    if (!object) throw core::Error(core::ErrorKind::usage, "this was freed and is not to be used any more");
    return object->call(what, with);
}

const char* nameOf(core::ErrorKind kind) {
    switch (kind) {
        case core::ErrorKind::usage: return "usage";
        case core::ErrorKind::badContent: return "badContent";
        case core::ErrorKind::diverged: return "diverged";
        case core::ErrorKind::inputOutput: return "inputOutput";
        case core::ErrorKind::noRenderer: return "noRenderer";
        case core::ErrorKind::interrupted: return "interrupted";
    }
    return "?";
}

Json failure(const char* kind, const char* message) {
    return {{"kind", kind}, {"message", message}};
}

}  // namespace
}  // namespace taut::web

// The answer is valid until the next call.
extern "C" const char* tautCall(const char* what, const char* with) {
    using namespace taut;
    static std::string answer;
    web::Json all;
    try {
        all["value"] = web::answerTo(what, web::Json::parse(with));
    } catch (const core::Error& error) {
        all["error"] = web::failure(web::nameOf(error.kind()), error.what());
    } catch (const std::bad_alloc&) {
        all["error"] = web::failure("badContent", "the scene needs more memory than the engine has here");
    } catch (const std::exception& error) {
        all["error"] = web::failure("usage", error.what());
    }
    answer = all.dump(-1, ' ', false, web::Json::error_handler_t::replace);
    return answer.c_str();
}
