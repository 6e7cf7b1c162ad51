// Common code of the tests of the scene loader: a folder with a few assets, and the message that a text leads to.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "taut/core/error.h"
#include "taut/scene/load.h"

namespace taut::scene {

// A folder of its own with a good and a broken model, an empty picture and a curve; goes with everything in it.
class AssetFolder {
  public:
    AssetFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "taut-scene-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
        path_ = name;
        write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
        write("corner.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
        write("square.png", "");
        write("kept.state", "state");
        write("curve.csv", "time,value,sigma\n0,1,0.5\n1.5,2,0.25\n");
        std::filesystem::copy(TAUT_SOURCE_DIR "/tests/support/arm.gltf", path_ / "arm.gltf");
        std::filesystem::create_directory(path_ / "models");
    }
    ~AssetFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    AssetFolder(const AssetFolder&) = delete;
    AssetFolder& operator=(const AssetFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path_ / name, std::ios::binary) << text;
    }

    Loaded load(const std::string& text, LoadOptions options = {}) const {
        if (!options.stateIn) options.stateIn = [](const auto&) { return world::StartState{}; };
        return loadSceneText(text, (path_ / "s.toml").string(), options);
    }

    // The message that loading ends with, without the folder's name; empty if there is none.
    std::string messageOf(const std::string& text, LoadOptions options = {}) const {
        // The limit is set so that no message depends on the machine's memory.
        if (options.memoryLimit == 0) options.memoryLimit = 16e9;
        try {
            load(text, options);
        } catch (const core::Error& error) {
            EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
            return withoutFolder(error.what());
        }
        return "";
    }

    std::string withoutFolder(std::string message) const {
        const std::string prefix = path_.string() + "/";
        for (std::size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
            message.erase(at, prefix.size());
        return message;
    }

  private:
    std::filesystem::path path_;
};

// A text that follows "schema = 1", and the whole message that it must lead to.
struct ErrorCase {
    const char* fault;
    const char* text;
    const char* message;
};

inline void expectMessages(const std::vector<ErrorCase>& cases) {
    const AssetFolder folder;
    for (const ErrorCase& row : cases) {
        SCOPED_TRACE(row.fault);
        EXPECT_EQ(folder.messageOf("schema = 1\n" + std::string(row.text)), row.message);
    }
}

}  // namespace taut::scene
