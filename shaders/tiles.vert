// Parts of the target.
layout(location = 0) in vec2 place;  // -1 … 1

void main() {
    gl_Position = vec4(place, 0.0, 1.0);
}
