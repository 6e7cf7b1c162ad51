// Shader programs made from the files of one folder. Independent of their purpose.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "taut/render/private/gl.h"

namespace taut::render {

// Fixed places of inputs that several shaders read; a program finds them by name when it is linked.
inline constexpr GLuint frameBlockBinding = 0;  // uniform block Frame
enum TextureUnit : int {
    shadowMapUnit = 0,
    shadowBoundsUnit = 1,
    occlusionUnit = 2,
    pictureUnit = 3,
    shadowDepthUnit = 4,
    tintsUnit = 5,
    shapesUnit = 6,
    materialsUnit = 7,
    environmentUnit = 8,
    hiddenUnit = 9,  // and before it is drawn, the depth that it is made from
    lampsUnit = 10,  // three of each lamp that throws shadows
};

// Where the shadow map of a light is bound: to be compared, as depth, its bounds.
struct ShadowUnits {
    int map, depth, bounds;
};
inline constexpr ShadowUnits sunUnits{shadowMapUnit, shadowDepthUnit, shadowBoundsUnit};
inline constexpr ShadowUnits lampUnits(std::size_t lamp) {
    const int first = lampsUnit + 3 * static_cast<int>(lamp);
    return {first, first + 1, first + 2};
}

class Program {
  public:
    Program(const Gl& gl, GlObject object);

    void use() const { gl_->UseProgram(object_.id()); }

    // Of the program in use. A name that the shaders do not read is ignored.
    void set(const std::string& name, float value);
    void set(const std::string& name, int value);
    void set(const std::string& name, glm::vec2 value);
    void set(const std::string& name, glm::vec3 value);
    void set(const std::string& name, glm::vec4 value);
    void set(const std::string& name, const glm::mat3& value);
    void set(const std::string& name, const glm::mat4& value);

  private:
    GLint location(const std::string& name);

    const Gl* gl_;
    GlObject object_;
    std::map<std::string, GLint> locations_;
};

class ShaderFolder {
  public:
    ShaderFolder(const Gl& gl, std::filesystem::path folder) : gl_(&gl), folder_(std::move(folder)) {}

    // Compiles two files, with a line "#define X" for each of the definitions. A line `#include "file"` takes in
    // another file of the folder. Throws Error(inputOutput) for a file that cannot be read and Error(badContent)
    // with the file and GL's log for one that does not compile.
    Program program(const std::string& vertexFile, const std::string& fragmentFile,
                    const std::vector<std::string>& definitions = {}) const;

  private:
    GlObject compiled(const std::string& file, GLenum type, const std::vector<std::string>& definitions) const;

    const Gl* gl_;
    std::filesystem::path folder_;
};

}  // namespace taut::render
