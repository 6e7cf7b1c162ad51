// A mesh that animations move, as glTF has it: a tree of nodes, skins, morph targets. Where its vertices are is a
// function of the time alone, with the same bits on every machine. It knows neither files nor physics.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace taut::figure {

using glm::dmat4;
using glm::dquat;
using glm::dvec3;

struct Node {
    std::string name;
    int parent = -1;  // a lower number
    dvec3 translation{0.0};
    dquat rotation{1.0, 0.0, 0.0, 0.0};  // unit
    dvec3 scale{1.0};
    std::optional<dmat4> matrix;  // in place of the three
    std::vector<double> weights;  // of the morph targets of its parts
};

enum class Interpolation { step, linear, cubic };
enum class Path { translation, rotation, scale, weights };

// How one property of a node changes. Before its first and after its last key it stays.
struct Channel {
    int node = 0;
    Path path = Path::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<double> times;   // (keys) [s] ascending
    std::vector<double> values;  // (keys · width); cubic: (keys · 3 · width), in-tangent, value, out-tangent
};
struct Animation {
    std::string name;
    double seconds = 0;  // of its last key
    std::vector<Channel> channels;
};

struct Skin {
    std::vector<int> joints;         // nodes
    std::vector<dmat4> inverseBind;  // (joints) from the mesh to the joint
};

// Vertices of one node, before anything moves. A part with a skin follows its joints, any other its node.
struct Part {
    struct Influence {
        int joint;  // of the skin
        double weight;
    };
    int node = 0;
    int skin = -1;
    std::vector<dvec3> positions;             // (vertices)
    std::vector<Influence> influences;        // those of vertex i: firstInfluence[i] to before firstInfluence[i + 1]
    std::vector<std::size_t> firstInfluence;  // (vertices + 1) with a skin
    std::vector<std::vector<dvec3>> targets;  // (morph targets) (vertices) displacements
};

// Triangles drawn with one material. Several drawn vertices may stand at one vertex: at seams and sharp edges.
struct Piece {
    std::vector<int> vertices;             // (drawn vertices) of the figure
    std::vector<int> smooth;               // (drawn vertices) those with the same number share a normal
    std::vector<glm::vec2> uv;             // (drawn vertices) 0 … 1 along the picture, from its lower left
    std::vector<std::uint32_t> triangles;  // (3 · triangles) drawn vertices, counter-clockwise seen from outside
    dvec3 colour{1.0};                     // linear
    double roughness = 1.0;
    std::string texture;  // path; empty: none
};

struct Figure {
    std::vector<Node> nodes;
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<Part> parts;                    // their vertices follow each other
    std::vector<std::array<int, 3>> triangles;  // vertices
    std::vector<Piece> pieces;
    int smoothCount = 0;  // numbers that `smooth` of the pieces has

    int vertexCount() const;
    const Animation* find(std::string_view animation) const;  // null: none of that name
    int nodeNamed(std::string_view name) const;               // the first; -1: none
};

// All nodes at a moment.
struct Posture {
    std::vector<dmat4> world;                  // (nodes) from the node to the figure
    std::vector<std::vector<double>> weights;  // (nodes)
};

// At `seconds` of an animation; without one as the file has them.
Posture postureAt(const Figure& figure, const Animation* animation, double seconds);
// places (vertices) in the file's unit.
void placeVertices(const Figure& figure, const Posture& posture, std::span<dvec3> places);

// (width) values of a channel at a moment; rotations are unit quaternions x, y, z, w.
void sample(const Channel& channel, std::size_t width, double seconds, std::span<double> values);

}  // namespace taut::figure
