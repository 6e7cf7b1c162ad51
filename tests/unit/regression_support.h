// A small scenario in a folder of its own: a bob on a spring beside a rope, one second at 20 pictures a second.
#pragma once

#include <string>

#include "image_support.h"
#include "program_support.h"

namespace taut::test {

// Stiffness [N/m] of the bob's spring; the rest goes to the end of the file.
inline std::string springText(const std::string& stiffness = "100.0", const std::string& more = "") {
    return R"(schema = 1
[run]
fps = 20
seconds = 0.5
[net.spring]
points = [ { name = "nail", position = [0, 2, 0], hold = true }, { name = "bob", position = [0, 1, 0] } ]
springs = [ { a = "nail", b = "bob", stiffness_N_per_m = )" +
           stiffness + R"( } ]
[rope.line]
ends = [[1, 2, 0], [2, 2, 0]]
segments = 4
hold = ["start"]
[collider.ground]
shape = "plane"
)" + more;
}

inline const std::string goldenText = "[[golden]]\nframes = [3, 6]\nsize = [96, 54]\n";

// `taut test` of the folder, quiet, with its output in FOLDER/out.
inline Outcome testRun(const TemporaryFolder& folder, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"test", folder.path().string(), "-o", (folder / "out").string(), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
}

inline Outcome acceptRun(const TemporaryFolder& folder, const std::string& name, const std::string& why) {
    return run({"test", folder.path().string(), "--update", name, "--why", why});
}

}  // namespace taut::test
