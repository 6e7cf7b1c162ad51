// Marks arrive as corners in clip coordinates.
layout(location = 0) in vec4 corner;
layout(location = 1) in vec3 tint;
layout(location = 2) in vec3 shape;  // xy: from the middle [px], z: half width [px]
out vec3 markColour;
noperspective out vec3 markShape;

void main() {
    markColour = tint;
    markShape = shape;
    gl_Position = corner;
}
