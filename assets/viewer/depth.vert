// Three.js tells it of its cameras.
in vec3 position;
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;

void main() { gl_Position = projectionMatrix * viewMatrix * modelMatrix * vec4(position, 1.0); }
