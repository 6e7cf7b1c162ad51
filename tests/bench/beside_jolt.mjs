// The sheet of a scene of taut with Jolt's soft body, as WebAssembly in one thread. Prints the user processor time [s]
// of stepping, which has the compiling of WebAssembly in it as far as that happens then.
//
//   node beside_jolt.mjs WITH-NODE_MODULES SCENE.json MESHES ROUNDS RATE STIFFER
//
// ROUNDS: mNumIterations, which are substeps of XPBD. RATE: steps a second. STIFFER: by how much springs are stiffer
// than taut's. Jolt has the springs of taut as constraints of an edge, compliance [m/N] = 1 / stiffness, and drag as
// mLinearDamping [1/s]. Points meet the triangles of the ball; Jolt has no contact of a soft body with itself.
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [modules, file, meshes, rounds, rate, stiffer] = process.argv.slice(2);
const library = path.join(modules, "node_modules/jolt-physics/dist/jolt-physics.wasm.js");
const Jolt = await (await import(pathToFileURL(library))).default();
const told = JSON.parse(fs.readFileSync(file));
const sheet = told.cloth.sheet;
const material = told.material[sheet.material];
const ball = told.collider.ball;

// Two layers of objects, which meet each other: what stands (0) and what moves (1).
const settings = new Jolt.JoltSettings();
settings.mMaxWorkerThreads = 0;
const pairs = new Jolt.ObjectLayerPairFilterTable(2);
pairs.EnableCollision(0, 1);
const layers = new Jolt.BroadPhaseLayerInterfaceTable(2, 2);
for (const layer of [0, 1]) layers.MapObjectToBroadPhaseLayer(layer, new Jolt.BroadPhaseLayer(layer));
settings.mObjectLayerPairFilter = pairs;
settings.mBroadPhaseLayerInterface = layers;
settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
const jolt = new Jolt.JoltInterface(settings);
const bodies = jolt.GetPhysicsSystem().GetBodyInterface();
const unturned = new Jolt.Quat(0, 0, 0, 1);

// Jolt's friction of a pair is the root of the product, so both have it.
const corners = new Jolt.VertexList(), triangles = new Jolt.IndexedTriangleList();
for (const words of fs.readFileSync(ball.mesh, "utf8").split("\n").map((line) => line.split(/\s+/))) {
    if (words[0] === "v") corners.push_back(new Jolt.Float3(...words.slice(1, 4).map((x) => ball.scale * x)));
    if (words[0] === "f")
        triangles.push_back(new Jolt.IndexedTriangle(...words.slice(1, 4).map((word) => parseInt(word) - 1), 0));
}
const shape = new Jolt.MeshShapeSettings(corners, triangles, new Jolt.PhysicsMaterialList()).Create().Get();
const standing = new Jolt.BodyCreationSettings(
    shape, new Jolt.RVec3(...ball.position), unturned, Jolt.EMotionType_Static, 0);
standing.mFriction = ball.friction;
bodies.CreateAndAddBody(standing, Jolt.EActivation_DontActivate);

// Points [m] row by row from the origin of the sheet, whose rows lie along x and follow each other along z.
const cells = sheet.cells[0], across = cells + 1, count = across * across, side = sheet.size[0];
const shared = new Jolt.SoftBodySharedSettings();
shared.AddRef();
const pointMass = material.density_kg_per_m2 * side * side / count;  // [kg]
for (let p = 0; p < count; ++p) {
    const vertex = new Jolt.SoftBodySharedSettingsVertex();
    vertex.mPosition = new Jolt.Float3(side / cells * (p % across), 0, side / cells * Math.floor(p / across));
    vertex.mInvMass = 1 / pointMass;
    shared.mVertices.push_back(vertex);
}
// Springs along the threads, across cells and over two cells, as taut has them: at the rim half as stiff a thread.
const spring = (p, q, stiffness) => {
    const edge = new Jolt.SoftBodySharedSettingsEdge(p, q, 1 / (stiffer * stiffness));
    shared.mEdgeConstraints.push_back(edge);
};
const faces = [];
for (let p = 0; p < count; ++p) {
    const i = p % across, j = Math.floor(p / across);
    const share = (k) => (k === 0 || k === cells ? 0.5 : 1);
    if (i < cells) spring(p, p + 1, share(j) * material.stretch_N_per_m);
    if (j < cells) spring(p, p + across, share(i) * material.stretch_N_per_m);
    if (i + 2 <= cells) spring(p, p + 2, material.bend_N_per_m);
    if (j + 2 <= cells) spring(p, p + 2 * across, material.bend_N_per_m);
    if (i === cells || j === cells) continue;
    spring(p, p + across + 1, material.shear_N_per_m);
    spring(p + 1, p + across, material.shear_N_per_m);
    faces.push([p, p + across, p + across + 1], [p, p + across + 1, p + 1]);
}
for (const face of faces) shared.AddFace(new Jolt.SoftBodySharedSettingsFace(...face, 0));
shared.CalculateEdgeLengths();
shared.Optimize();
const moving = new Jolt.SoftBodyCreationSettings(shared, new Jolt.RVec3(...sheet.origin), unturned, 1);
moving.mNumIterations = Number(rounds);
moving.mLinearDamping = material.drag_per_s;
moving.mFriction = ball.friction;
moving.mVertexRadius = sheet.thickness;
moving.mAllowSleeping = false;
const body = bodies.CreateSoftBody(moving);
bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
const vertices = Jolt.castObject(body.GetMotionProperties(), Jolt.SoftBodyMotionProperties).GetVertices();

let spent = 0, steps = 0;  // [µs]
for (let frame = 1; frame <= told.run.fps * told.run.seconds; ++frame) {
    const before = process.cpuUsage();
    for (; steps < Math.round(frame / told.run.fps * rate); ++steps) jolt.Step(1 / rate, 1);
    spent += process.cpuUsage(before).user;
    const centre = body.GetCenterOfMassPosition();
    const lines = [];
    for (let p = 0; p < count; ++p) {
        const x = vertices.at(p).mPosition;
        lines.push(`v ${centre.GetX() + x.GetX()} ${centre.GetY() + x.GetY()} ${centre.GetZ() + x.GetZ()}`);
    }
    for (const face of faces) lines.push(`f ${face.map((p) => p + 1).join(" ")}`);
    fs.writeFileSync(path.join(meshes, `${String(frame).padStart(4, "0")}.obj`), lines.join("\n") + "\n");
}
console.log((spent / 1e6).toFixed(3));
