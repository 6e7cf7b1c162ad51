#include "taut/scene/private/obj_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "taut/core/error.h"
#include "taut/scene/private/polygon.h"
#include "taut/scene/private/text_file.h"

namespace taut::scene {

namespace {

using world::dvec2;
using world::dvec3;

constexpr std::uint64_t maxObjSize = 256U << 20U;  // [bytes]
constexpr std::size_t maxCorners = 1000;           // of one face; the cost of cutting grows with the cube

struct Corner {
    int position = 0, uv = -1;  // from 0; -1: none
};

class ObjReader {
  public:
    ObjReader(std::string_view text, const std::string& fileName) : text_(text), fileName_(fileName) {}

    world::MeshData read() {
        if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
        if (text_.find('\0') != std::string_view::npos) fail("this is not a text file: it holds a zero byte");
        while (!text_.empty()) readLine(nextLine());
        if (faceCount_ == 0) fail("there are no faces");
        if (mesh_.triangles.empty()) fail("no face has an area");
        if (!hasUv_) mesh_.uv.clear();
        if (!hasUv_) mesh_.cornerUv.clear();
        nameLines();
        for (auto& [name, vertices] : mesh_.groups) {
            std::sort(vertices.begin(), vertices.end());
            vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        }
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw core::Error(core::ErrorKind::badContent, core::at({fileName_, line_}) + message);
    }

    // One line without its comment. A backslash at its end joins the next line.
    std::string nextLine() {
        std::string line;
        line_ = nextLine_;
        bool isJoined = true;
        while (isJoined && !text_.empty()) {
            ++nextLine_;
            const std::size_t end = text_.find('\n');
            std::string_view piece = text_.substr(0, end);
            text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
            piece = piece.substr(0, piece.find('#'));
            if (piece.ends_with('\r')) piece.remove_suffix(1);
            isJoined = piece.ends_with('\\');
            if (isJoined) piece.remove_suffix(1);
            line += piece;
        }
        return line;
    }

    void readLine(const std::string& line) {
        std::vector<std::string_view> words;
        std::string_view rest = line;
        while (true) {
            const std::size_t first = rest.find_first_not_of(" \t\r\f\v");
            if (first == std::string_view::npos) break;
            rest.remove_prefix(first);
            const std::size_t end = rest.find_first_of(" \t\r\f\v");
            words.push_back(rest.substr(0, end));
            rest.remove_prefix(words.back().size());
        }
        if (words.empty()) return;
        if (words[0] == "v") {
            if (words.size() < 4) fail("a vertex needs three numbers");
            positions_.emplace_back(number(words[1]), number(words[2]), number(words[3]));
        } else if (words[0] == "vt") {
            if (words.size() < 2) fail("a texture coordinate needs a number");
            uvs_.emplace_back(number(words[1]), words.size() > 2 ? number(words[2]) : 0.0);
        } else if (words[0] == "f") {
            readFace(words);
        } else if (words[0] == "l") {
            readLineElement(words);
        } else if (words[0] == "g") {
            groups_.assign(words.begin() + 1, words.end());
        } else if (words[0] == "o") {  // a name may contain blanks
            object_ = words.size() < 2 ? "" : std::string(words[1].data(), words.back().data() + words.back().size());
        }
    }

    // Independent of the locale and correctly rounded, so that every machine reads the same number.
    double number(std::string_view word) const {
        std::string_view digits = word;
        if (digits.starts_with('+')) digits.remove_prefix(1);
        double value = 0;
        const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        const bool isNumber = code == std::errc() && end == digits.data() + digits.size() && !digits.starts_with("+");
        if (!isNumber) fail(fmt::format("\"{}\" is not a number", shortened(word)));
        if (!std::isfinite(value) || std::abs(value) > 1e12) fail(fmt::format("{} is not a finite place", word));
        return value;
    }

    static std::string shortened(std::string_view word) {
        std::string text;
        for (const char c : word.substr(0, 40)) text += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
        return text;
    }

    // Indices count from 1, or backwards from the last element read.
    int index(std::string_view word, std::string_view kind, std::size_t count) const {
        long long value = 0;
        const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (code != std::errc() || end != word.data() + word.size())
            fail(fmt::format("\"{}\" is not the number of a {}", shortened(word), kind));
        const auto size = static_cast<long long>(count);
        const long long place = value < 0 ? size + value : value - 1;
        if (value == 0 || place < 0 || place >= size)
            fail(fmt::format("there is no {} {}: {} are defined so far", kind, value, size));
        return static_cast<int>(place);
    }

    Corner corner(std::string_view word) const {
        const std::size_t slash = word.find('/');
        Corner corner{index(word.substr(0, slash), "vertex", positions_.size()), -1};
        if (slash == std::string_view::npos) return corner;
        const std::string_view rest = word.substr(slash + 1);
        const std::string_view uv = rest.substr(0, rest.find('/'));
        if (!uv.empty()) corner.uv = index(uv, "texture coordinate", uvs_.size());
        return corner;
    }

    void readFace(const std::vector<std::string_view>& words) {
        if (words.size() < 4) fail("a face needs at least three corners");
        if (words.size() - 1 > maxCorners) fail(fmt::format("a face has at most {} corners", maxCorners));
        std::vector<Corner> corners;
        std::vector<dvec3> places;
        for (std::size_t i = 1; i < words.size(); ++i) {
            corners.push_back(corner(words[i]));
            places.push_back(positions_[corners.back().position]);
        }
        ++faceCount_;
        for (const std::array<int, 3>& triangle : polygonTriangles(places)) {
            const auto at = [&](int i) { return places[triangle[i]]; };
            if (at(0) == at(1) || at(1) == at(2) || at(2) == at(0)) continue;
            std::array<int, 3> vertices{};
            std::array<dvec2, 3> uv{};
            for (std::size_t i = 0; i < 3; ++i) {
                const Corner& corner = corners[triangle[i]];
                vertices[i] = vertex(corner);
                uv[i] = uvOf(corner);
            }
            mesh_.triangles.push_back(vertices);
            mesh_.cornerUv.push_back(uv);
            mesh_.lines.push_back(line_);
            for (const std::string& name : groups_) addTo(name, vertices);
            if (!object_.empty()) addTo(object_, vertices);
        }
    }

    void readLineElement(const std::vector<std::string_view>& words) {
        if (words.size() < 3) fail("a line needs at least two vertices");
        for (std::size_t i = 1; i < words.size(); ++i) {
            const int position = corner(words[i]).position;
            for (const std::string& name : groups_) lines_[name].push_back(position);
            if (!object_.empty()) lines_[object_].push_back(position);
        }
    }

    // The groups of lines alone; none where a line has a vertex of no face.
    void nameLines() {
        for (const auto& [name, positions] : lines_) {
            std::vector<int> vertices;
            for (const int position : positions)
                if (const auto found = vertices_.find(keyOf(position)); found != vertices_.end())
                    vertices.push_back(found->second);
            if (vertices.size() == positions.size()) mesh_.groups.emplace(name, std::move(vertices));
        }
    }

    void addTo(const std::string& name, const std::array<int, 3>& vertices) {
        std::vector<int>& group = mesh_.groups[name];
        group.insert(group.end(), vertices.begin(), vertices.end());
    }

    using Key = std::tuple<double, double, double>;
    Key keyOf(int position) const {
        const dvec3 p = positions_[position] + dvec3(0.0);  // -0 becomes +0
        return {p.x, p.y, p.z};
    }

    // The vertex at the corner's position; new at its first use.
    int vertex(const Corner& corner) {
        const Key key = keyOf(corner.position);
        const auto [found, isNew] = vertices_.try_emplace(key, static_cast<int>(mesh_.positions.size()));
        if (isNew) {
            mesh_.positions.emplace_back(std::get<0>(key), std::get<1>(key), std::get<2>(key));
            mesh_.numbers.push_back(corner.position + 1);
            mesh_.uv.push_back(uvOf(corner));
        }
        hasUv_ = hasUv_ && corner.uv >= 0;
        return found->second;
    }
    dvec2 uvOf(const Corner& corner) const { return corner.uv < 0 ? dvec2(0.0) : uvs_[corner.uv]; }

    std::string_view text_;
    const std::string& fileName_;
    int line_ = 1, nextLine_ = 1;
    int faceCount_ = 0;
    bool hasUv_ = true;
    std::vector<dvec3> positions_;
    std::vector<dvec2> uvs_;
    std::vector<std::string> groups_;  // of the following faces
    std::string object_;
    std::map<std::string, std::vector<int>> lines_;  // positions by group
    std::map<Key, int> vertices_;
    world::MeshData mesh_;
};

}  // namespace

world::MeshData objMesh(const std::filesystem::path& path) {
    return objMeshText(textFile(path, maxObjSize), path.string());
}

world::MeshData objMeshText(std::string_view text, const std::string& fileName) {
    return ObjReader(text, fileName).read();
}

}  // namespace taut::scene
