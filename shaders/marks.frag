in vec3 markColour;
noperspective in vec3 markShape;
uniform float strength;
out vec4 colour;

void main() {
    float cover = clamp(markShape.z + 0.5 - length(markShape.xy), 0.0, 1.0);
    colour = vec4(markColour, cover * strength);
}
