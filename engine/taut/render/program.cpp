#include "taut/render/private/program.h"

#include <array>
#include <fstream>
#include <sstream>

#include "taut/core/error.h"
#include "taut/view/frame_view.h"

namespace taut::render {

namespace {

std::string fileText(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (!file || !(text << file.rdbuf())) {
        throw core::Error(core::ErrorKind::inputOutput,
                          "cannot read the shader " + path.string() + "; is the shader folder the right one?");
    }
    return text.str();
}

// Takes in `#include "file"` lines. GL's log names sources by number: `files` lists which is which.
std::string withIncludes(const std::filesystem::path& folder, const std::string& name,
                         std::vector<std::string>& files) {
    if (files.size() > 16) throw core::Error(core::ErrorKind::badContent, "shader " + name + " includes itself");
    const std::size_t number = files.size();
    files.push_back(name);
    std::istringstream lines(fileText(folder / name));
    std::string text = "#line 1 " + std::to_string(number) + "\n";
    int lineNumber = 0;
    for (std::string line; std::getline(lines, line);) {
        ++lineNumber;
        const std::string directive = "#include \"";
        if (!line.starts_with(directive)) {
            text += line + "\n";
            continue;
        }
        const std::string included = line.substr(directive.size(), line.rfind('"') - directive.size());
        text += withIncludes(folder, included, files);
        text += "#line " + std::to_string(lineNumber + 1) + " " + std::to_string(number) + "\n";
    }
    return text;
}

std::string listed(const std::vector<std::string>& files) {
    std::string text;
    for (std::size_t i = 0; i < files.size(); ++i) text += (i > 0 ? ", " : "") + std::to_string(i) + " is " + files[i];
    return text;
}

}  // namespace

Program::Program(const Gl& gl, GlObject object) : gl_(&gl), object_(std::move(object)) {
    use();
    set("shadowMap", static_cast<int>(shadowMapUnit));
    set("shadowBounds", static_cast<int>(shadowBoundsUnit));
    set("shadowDepth", static_cast<int>(shadowDepthUnit));
    set("occlusion", static_cast<int>(occlusionUnit));
    set("picture", static_cast<int>(pictureUnit));
    set("tints", static_cast<int>(tintsUnit));
    set("shapes", static_cast<int>(shapesUnit));
    set("materials", static_cast<int>(materialsUnit));
    set("environment", static_cast<int>(environmentUnit));
    set("hidden", static_cast<int>(hiddenUnit));
    set("depths", static_cast<int>(hiddenUnit));
    for (std::size_t lamp = 0; lamp < view::mostLamps; ++lamp) {
        const std::string number = "[" + std::to_string(lamp) + "]";
        set("lampMaps" + number, lampUnits(lamp).map);
        set("lampDepths" + number, lampUnits(lamp).depth);
        set("lampBounds" + number, lampUnits(lamp).bounds);
    }
    const GLuint block = gl_->GetUniformBlockIndex(object_.id(), "Frame");
    if (block != GL_INVALID_INDEX) gl_->UniformBlockBinding(object_.id(), block, frameBlockBinding);
}

GLint Program::location(const std::string& name) {
    const auto known = locations_.find(name);
    if (known != locations_.end()) return known->second;
    return locations_[name] = gl_->GetUniformLocation(object_.id(), name.c_str());
}

void Program::set(const std::string& name, float value) {
    gl_->Uniform1f(location(name), value);
}
void Program::set(const std::string& name, int value) {
    gl_->Uniform1i(location(name), value);
}
void Program::set(const std::string& name, glm::vec2 value) {
    gl_->Uniform2fv(location(name), 1, &value[0]);
}
void Program::set(const std::string& name, glm::vec3 value) {
    gl_->Uniform3fv(location(name), 1, &value[0]);
}
void Program::set(const std::string& name, glm::vec4 value) {
    gl_->Uniform4fv(location(name), 1, &value[0]);
}
void Program::set(const std::string& name, const glm::mat3& value) {
    gl_->UniformMatrix3fv(location(name), 1, GL_FALSE, &value[0][0]);
}
void Program::set(const std::string& name, const glm::mat4& value) {
    gl_->UniformMatrix4fv(location(name), 1, GL_FALSE, &value[0][0]);
}

GlObject ShaderFolder::compiled(const std::string& file, GLenum type,
                                const std::vector<std::string>& definitions) const {
    std::vector<std::string> files;
    std::string text = "#version 330 core\n";
    for (const std::string& definition : definitions) text += "#define " + definition + "\n";
    text += withIncludes(folder_, file, files);

    GlObject shader(*gl_, GlKind::shader, type);
    const char* source = text.c_str();
    gl_->ShaderSource(shader.id(), 1, &source, nullptr);
    gl_->CompileShader(shader.id());
    GLint good = GL_FALSE;
    gl_->GetShaderiv(shader.id(), GL_COMPILE_STATUS, &good);
    if (good == GL_TRUE) return shader;
    std::array<char, 4096> log{};
    gl_->GetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw core::Error(
        core::ErrorKind::badContent,
        "shader " + (folder_ / file).string() + " does not compile (source " + listed(files) + "):\n" + log.data());
}

Program ShaderFolder::program(const std::string& vertexFile, const std::string& fragmentFile,
                              const std::vector<std::string>& definitions) const {
    const GlObject vertex = compiled(vertexFile, GL_VERTEX_SHADER, definitions);
    const GlObject fragment = compiled(fragmentFile, GL_FRAGMENT_SHADER, definitions);
    GlObject program(*gl_, GlKind::program);
    gl_->AttachShader(program.id(), vertex.id());
    gl_->AttachShader(program.id(), fragment.id());
    gl_->LinkProgram(program.id());
    gl_->DetachShader(program.id(), vertex.id());
    gl_->DetachShader(program.id(), fragment.id());
    GLint good = GL_FALSE;
    gl_->GetProgramiv(program.id(), GL_LINK_STATUS, &good);
    if (good == GL_TRUE) return {*gl_, std::move(program)};
    std::array<char, 4096> log{};
    gl_->GetProgramInfoLog(program.id(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw core::Error(core::ErrorKind::badContent, "shaders " + (folder_ / vertexFile).string() + " and " +
                                                       fragmentFile + " do not fit together:\n" + log.data());
}

}  // namespace taut::render
