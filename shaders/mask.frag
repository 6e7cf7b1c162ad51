// One flat colour.
uniform vec3 flatColour;
in float before;
out vec4 colour;

void main() {
    if (before < 0.0) discard;
    colour = vec4(flatColour, 1.0);
}
