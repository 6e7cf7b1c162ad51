// No text, however mangled, does anything but load or lead to a message.
#include <random>

#include "unit/scene_full_text.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

// One small accident: bytes lost, doubled, changed or put in; a line lost; the end cut off.
std::string mangled(std::string text, std::mt19937& random) {
    const std::vector<std::string> pieces = {"nan",
                                             "-inf",
                                             "1e999",
                                             "[",
                                             "]",
                                             "{",
                                             "}",
                                             "=",
                                             "\"",
                                             "'''",
                                             "\n",
                                             "#",
                                             ".",
                                             ",",
                                             "[[",
                                             "]]",
                                             "9999999999999999999",
                                             "1979-05-27",
                                             "true",
                                             "@",
                                             "*",
                                             "é",
                                             "\xFF",
                                             "\xEF\xBB\xBF",
                                             "\\",
                                             std::string(1, '\0')};
    const std::size_t at = random() % (text.size() + 1);
    switch (random() % 6) {
        case 0: return text.erase(at, random() % 12);
        case 1: return text.insert(at, pieces[random() % pieces.size()]);
        case 2: return text.insert(at, text.substr(random() % text.size(), random() % 40));
        case 3: return text.substr(0, at);
        case 4: {
            const std::size_t start = std::min(text.find('\n', at), text.size());
            return text.erase(start, std::min(text.find('\n', start + 1), text.size()) - start);
        }
        default:
            if (at < text.size()) text[at] = static_cast<char>(random() % 256);
            return text;
    }
}

TEST(SceneRobustness, MangledScenesLoadOrLeadToAMessage) {
    const AssetFolder folder;
    std::mt19937 random(7);
    int loaded = 0, refused = 0;
    for (int i = 0; i < 500; ++i) {
        std::string text = fullScene;
        for (std::size_t accidents = 1 + random() % 3; accidents > 0 && !text.empty(); --accidents)
            text = mangled(text, random);
        try {
            folder.load(text);
            ++loaded;
        } catch (const core::Error& error) {
            ++refused;
            EXPECT_EQ(error.kind(), core::ErrorKind::badContent) << text;
            const std::string message = folder.withoutFolder(error.what());
            EXPECT_TRUE(message.starts_with("s.toml:")) << message;
            EXPECT_NE(message.find(": error: "), std::string::npos) << message;
        }
    }
    // Both must happen, or the accidents are too rough or too gentle to tell anything.
    EXPECT_GT(loaded, 20);
    EXPECT_GT(refused, 200);
}

TEST(SceneRobustness, TruncationAnywhereIsAMessageOrAScene) {
    const AssetFolder folder;
    const std::string text = fullScene;
    int refused = 0;
    for (std::size_t length = 0; length < text.size(); length += 37)
        refused += folder.messageOf(text.substr(0, length)).empty() ? 0 : 1;
    EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace taut::scene
