// Refusals of scene files: a text, and the exact message with file, line, column, caret and remedy.
#include <algorithm>
#include <sstream>
#include <string_view>

#include "unit/scene_support.h"

namespace taut::scene::refusals {
namespace {

// Scene files around the texts of the table, below the line of the schema. A text replaces the gap.
constexpr std::string_view gap = "…";
constexpr const char* file = "…\n";
constexpr const char* rope = R"([rope.r]
ends = [[0, 0, 0], [1, 0, 0]]
…
)";
constexpr const char* cloth = R"([material.m]
[cloth.c]
material = "m"
…
)";
constexpr const char* collider = R"([collider.s]
…
)";
constexpr const char* heldRope = R"([rope.r]
ends = [[0, 0, 0], [1, 0, 0]]
hold = ["…"]
)";
constexpr const char* heldCloth = R"([material.m]
[cloth.c]
material = "m"
hold = ["…"]
)";
constexpr const char* massAt = R"([rope.r]
ends = [[0, 0, 0], [1, 0, 0]]
[[mass]]
target = "…"
mass_kg = 1
)";
constexpr const char* joint = R"(…
[rope.r]
ends = [[0, 0, 0], [1, 0, 0]]
[[joint]]
name = "peg"
a = "rope.r@start"
b = "rope.r@end"
kind = "rod"
)";
constexpr const char* ropeAction = R"(at = [
  …,
]
[rope.r]
ends = [[0, 0, 0], [1, 0, 0]]
)";
constexpr const char* clothAction = R"(at = [
  …,
]
[material.m]
[cloth.c]
material = "m"
)";
constexpr const char* claim = R"([rope.r]
ends = [[0, 0, 0], [1, 0, 0]]
[[check]]
that = "…"
)";
constexpr const char* ropesClaim = R"([rope.r]
ends = [[0, 0, 0], [1, 0, 0]]
[rope.touching]
ends = [[0, 1, 0], [1, 1, 0]]
…
)";

struct Row {
    const char* fault;
    const char* around;
    const char* text;
    // A line for each message: LINE:COLUMN: fault ^ remedy.
    const char* messages;
    // The output after the messages.
    const char* more = "";
};

constexpr Row refused[] = {
    // Values of a wrong type.
    {"a text for a number", file, R"([run]
fps = "fast")",
     R"(3:7: fps must be a number [1/s], not "fast")"},
    {"a number for a text", file, "title = 7", "2:9: title must be a text, not 7"},
    {"a list for a number", file, "[run]\nfps = [60]", "3:7: fps must be a number [1/s], not a list of 1"},
    {"a number for a list", file, "[world]\ngravity = -9.81",
     "3:11: gravity must be a list of 3 numbers [m/s²], not -9.81"},
    {"a number for a flag", rope, "collide = 1", R"(4:11: collide must be true, false or "faces", not 1)"},
    {"a word that a flag has not", rope, R"(collide = "face")",
     R"(4:11: collide must be true, false or "faces", not "face" ^ did you mean "faces"?)"},
    {"another word for one", collider, R"(shape = "ball")",
     "3:9: shape must be one of plane, box, sphere, capsule, cylinder, cone, hull, mesh, figure, compound, not "
     "\"ball\" ^ did you mean \"sphere\"?"},
    {"a key that is no slip of another", file, "[defaults.joint]\nreach_m = 0.1",
     "2:11: [defaults] has no key \"joint\" ^ it has material, cloth, rope, block, net, solid, anchor, wind, filling, "
     "collider, camera, lamp, label"},
    {"a date for a number", file, "[run]\nseconds = 1979-05-27",
     "3:11: seconds must be a number [s], not a date or time"},
    {"a fraction for a whole number", rope, "segments = 2.5", "4:12: segments must be a whole number, not 2.5"},
    {"a fraction in a list of whole numbers", cloth, "cells = [3, 2.5]",
     "5:13: cells[1] must be a whole number, not 2.5"},
    {"a list that is too short", file, "[world]\ngravity = [0, -9.81]",
     "3:11: gravity must be a list of 3 numbers [m/s²], not a list of 2"},
    {"a list that is too long", cloth, "size = [1, 1, 1]",
     "5:8: size must be a list of 2 numbers [m], not a list of 3"},
    {"a text in a list of numbers", file, R"([world]
gravity = [0, "down", 0])",
     R"(3:15: gravity[1] must be a number [m/s²], not "down")"},
    {"ends that are one point", file, "[rope.r]\nends = [0, 0, 0]",
     "3:8: ends must be a list of two points, each a list of 3 numbers [m], not a list of 3"},
    {"ends with a short point", file, "[rope.r]\nends = [[0, 0, 0], [1, 0]]",
     "3:20: ends[1] must be a list of 3 numbers [m], not a list of 2"},
    {"a text for a list of texts", rope, R"(hold = "ends")",
     R"(4:8: hold must be a list of texts, not "ends" ^ write hold = ["ends"])"},
    {"a number in a list of texts", rope, R"(hold = ["start", 3])", "4:18: hold[1] must be a text, not 3"},
    {"a wrong step", file, R"([solver]
dt = "fast")",
     R"(3:6: dt must be "auto" or a number [s], not "fast")"},
    {"a step that is true", file, "[solver]\ndt = true", R"(3:6: dt must be "auto" or a number [s], not true)"},
    {"an unknown choice", file, R"([solver]
integrator = "leapforg")",
     "3:14: integrator must be one of euler, symplectic-euler, heun, midpoint, rk4, velocity-verlet, leapfrog, "
     "blanes-moan, implicit-euler, sdirk2, not \"leapforg\" ^ did you mean \"leapfrog\"?"},
    {"a choice that is a number", file, "[solver]\nprecision = 64",
     "3:13: precision must be one of single, double, not 64"},
    {"a colour that is no colour", rope, R"(finish = { colour = "red" })",
     R"(4:21: colour must be a list of 3 numbers from 0 to 1, or "#rrggbb", not "red")"},
    {"a colour with a wrong digit", rope, R"(finish = { colour = "#12345g" })",
     R"(4:21: colour must be a list of 3 numbers from 0 to 1, or "#rrggbb", not "#12345g")"},
    {"a colour that is too bright", rope, "finish = { colour = [255, 0, 0] }",
     R"(4:21: colour must be a list of 3 numbers from 0 to 1, or "#rrggbb", not [255, 0, 0] ^ write "#ff0000")"},
    {"a colour a little too bright", rope, "finish = { colour = [1.5, 0, 0] }",
     "4:22: colour[0] must be between 0 and 1, not 1.5"},
    {"a title of two lines", file, R"(title = "a\nb")",
     "2:9: title must be a text of one line, not one with control characters"},
    // Values out of their range.
    {"not a number", file, "[solver]\nsafety = nan", "3:10: safety must be a finite number, not nan"},
    {"infinity", file, "[run]\nseconds = inf", "3:11: seconds must be a finite number [s], not inf"},
    {"infinity in a list", file, "[world]\ngravity = [0, -inf, 0]",
     "3:15: gravity[1] must be a finite number [m/s²], not -inf"},
    {"a negative mass", rope, "mass_kg = -1", "4:11: mass_kg must be above 0 kg, not -1"},
    {"no mass", rope, "mass_kg = 0.0", "4:11: mass_kg must be above 0 kg, not 0"},
    {"a mass that is far too small", rope, "mass_kg = 1e-30",
     "4:11: mass_kg must be between 1e-09 and 1e+12 kg, not 1e-30"},
    {"a number that is far too large", rope, "stretch_N = 1e30",
     "4:13: stretch_N must be between 1e-09 and 1e+12 N, not 1e+30"},
    {"a share above 1", file, "[solver]\nsafety = 1.5", "3:10: safety must be between 0.01 and 1, not 1.5"},
    {"no cells", cloth, "cells = [0, 10]", "5:10: cells[0] must be between 1 and 1e+09, not 0"},
    {"negative cells", file, "[block.b]\ncells = [4, 4, -4]", "3:16: cells[2] must be between 1 and 1e+09, not -4"},
    {"a whole number beyond any count", rope, "segments = 9223372036854775807",
     "4:12: segments must be between 1 and 1e+09, not 9223372036854775807"},
    {"samples that no picture has", file, "[picture]\nsamples = 2", "3:11: samples must be 1 or 4 or 8 or 16, not 2"},
    {"a shadow map that cannot be drawn", file, "[picture]\nshadow_size = 64",
     "3:15: shadow_size must be between 128 and 16384 px, not 64"},
    {"a shadow map in no whole blocks", file, "[picture]\nshadow_size = 200",
     "3:15: shadow_size must be a multiple of 128 [px], not 200"},
    {"a speed that counts as diverged", rope, "velocity = [0, 5000, 0]",
     "4:16: velocity[1] must be between -3000 and 3000 m/s, not 5000"},
    {"a size of nothing", cloth, "size = [1, 0]", "5:12: size[1] must be between 1e-06 and 1e+06 m, not 0"},
    {"a step above a second", file, "[solver]\ndt = 2", "3:6: dt must be between 1e-09 and 1 s, not 2"},
    {"a negative step", file, "[solver]\ndt = -1e-3", "3:6: dt must be between 1e-09 and 1 s, not -0.001"},
    {"a direction of no length", file, "[light]\ndirection = [0, 0, 0]", "3:13: direction must not be [0, 0, 0]"},
    {"a light that fills the sky", file, "[light]\nsoftness_deg = 60",
     "3:16: softness_deg must be between 0 and 45 degrees, not 60"},
    {"a fourth light", file, R"([lamp.one]
[lamp.two]
[lamp.three])",
     "4:7: a scene has three lights at most: the sun and 2 lamps ^ leave out a lamp"},
    {"a restitution above 1", collider, R"(shape = "sphere"
restitution = 1.2)",
     "4:15: restitution must be between 0 and 1, not 1.2"},
    {"more copies than an array has", rope,
     "array = { count = [1000, 1000, 1], step_x = [1, 0, 0], step_y = [0, 1, 0] }",
     "4:19: an array has at most 100000 copies"},
    {"a scene too large for any machine", cloth, "cells = [100000, 100000]",
     "3:8: the scene is too large: 1e+10 points and 6e+10 springs need about 1.32e+04 GB; the limit is 5e+07 points "
     "and 16 GB ^ cloth.c is the largest: give it fewer cells, segments or copies"},
    {"a wide field of view", file, "[camera.c]\nfov_deg = 180",
     "3:11: fov_deg must be between 1 and 170 degrees, not 180"},
    // Names of missing things.
    {"a material that is not there", file, R"([material.m]
[cloth.c]
material = "n")",
     R"(4:12: there is no material "n" ^ add a table [material.n], or take a fabric: taut materials lists them)"},
    {"a material that is nearly there", file, R"([material.nylon]
[cloth.c]
material = "nylno")",
     R"(4:12: there is no material "nylno" ^ did you mean "nylon"?)"},
    {"a material without a name", file, R"([material.m]
[cloth.c]
material = "")",
     R"(4:12: there is no material "" ^ give a name)"},
    {"a camera that is not there", file, R"([picture]
camera = "mian"
[camera.main])",
     R"(3:10: there is no camera "mian" ^ did you mean "main"?)"},
    {"a target without a kind", massAt, "r@end", R"(5:10: "r@end" names no body ^ write KIND.NAME, e.g. cloth.flag)"},
    {"a target of an unknown kind", massAt, "roep.r@end", R"(5:10: "roep" is no kind of body ^ did you mean "rope"?)"},
    {"a target that is no body", massAt, "collider.s@all",
     R"(5:10: "collider" is no kind of body ^ bodies are cloth, rope, block, net, solid)"},
    {"a target that is not there", file, R"([rope.rail]
ends = [[0, 0, 0], [1, 0, 0]]
[[mass]]
target = "rope.rial@end"
mass_kg = 1)",
     R"(5:10: there is no rope.rial ^ did you mean "rope.rail"?)"},
    {"a wildcard that fits nothing", massAt, "cloth.*@all", "5:10: there is no cloth.*"},
    {"a target without a selector", massAt, "rope.r",
     R"(5:10: "rope.r" selects no points ^ write rope.r@all or another selector)"},
    {"an array without a number", rope, R"(array = { count = [3, 1, 1], step_x = [1, 0, 0] }
[[mass]]
target = "rope.r@end"
mass_kg = 1)",
     "6:10: rope.r is an array ^ write rope.r.0 … rope.r.2, or rope.r.*"},
    {"a copy that an array lacks", rope, R"(array = { count = [3, 1, 1], step_x = [1, 0, 0] }
[[mass]]
target = "rope.r.3@end"
mass_kg = 1)",
     "6:10: there is no rope.r.3 ^ the copies are rope.r.0 … rope.r.2"},
    {"an unknown group of a rope", heldRope, "left",
     R"(4:9: rope.r has no points "left" ^ it has start, end, ends, all)"},
    {"an unknown group of a cloth", heldCloth, "top-lefft",
     R"(5:9: cloth.c has no points "top-lefft" ^ did you mean "top-left"?)"},
    {"a group that only meshes have", heldCloth, "boundary",
     "5:9: cloth.c has no points \"boundary\" ^ it has left, right, top, bottom, top-left, top-right, bottom-left, "
     "bottom-right, corners, edges, all"},
    {"an unknown group of a block", file, R"([block.b]
hold = ["all", "edges"])",
     R"(3:16: block.b has no points "edges" ^ it has left, right, bottom, top, back, front, corners, all)"},
    {"a point beyond the last", rope, R"(segments = 4
hold = ["#5"])",
     "5:9: rope.r has no point #5 ^ its points are #0 … #4"},
    {"a point beyond any number", heldRope, "#99999999999999999999",
     "4:9: rope.r has no point #99999999999999999999 ^ its points are #0 … #40"},
    {"a point that is no number", heldRope, "#-1", R"(4:9: "#-1" is not the number of a point ^ write #0, #1, …)"},
    {"a place off the cloth", heldCloth, "(0.5,1.5)",
     "5:9: \"(0.5,1.5)\" is not a place on a cloth ^ write (u,v), each 0 … 1, or (u,v,r) with a radius r in metres"},
    {"a place without a comma", heldCloth, "(0.5)",
     R"-(5:9: "(0.5)" is not a place on a cloth ^ write (u,v), each 0 … 1, or (u,v,r) with a radius r in metres)-"},
    {"a radius below zero", heldCloth, "(0.5,0.5,-1)",
     "5:9: \"(0.5,0.5,-1)\" is not a place on a cloth ^ write (u,v), each 0 … 1, or (u,v,r) with a radius r in metres"},
    {"a corner of a round cloth", cloth, R"-(round = true
hold = ["(0,1)"])-",
     "6:9: cloth.c is round: there is nothing of it at (0,1) ^ (0.5,0.5) is its middle"},
    {"a place on a rope", heldRope, "(0.5,0.5)", "4:9: rope.r is no grid: it has no (u,v)"},
    {"a share of a cloth", heldCloth, "50%", "5:9: cloth.c is no rope: it has no 50%"},
    {"a share above the whole", heldRope, "150%", R"(4:9: "150%" is not a place along a rope ^ write 0% … 100%)"},
    {"an empty selector", heldRope, "", R"(4:9: rope.r has no points "" ^ it has start, end, ends, all)"},
    {"a joint with a fault at each end", rope, R"([[joint]]
a = "rope.q@end"
b = "rope.r@ennd")",
     R"(5:5: there is no rope.q ^ did you mean "rope.r"?
6:5: rope.r has no points "ennd" ^ did you mean "end"?)"},
    {"an anchor with a fault", rope, R"([anchor.a]
target = "rope.r@#41"
at = [0, 0, 0])",
     "5:10: rope.r has no point #41 ^ its points are #0 … #40"},
    {"a joint of bodies that disagree", rope, R"([rope.s]
ends = [[0, 0, 0], [1, 0, 0]]
solver = { safety = 0.5 }
[[joint]]
a = "rope.r@end"
b = "rope.s@end")",
     "7:1: this joint ties rope.r and rope.s, whose solver overrides differ in safety ^ give both the same"},
    {"a wind on points", cloth, R"([wind.w]
on = ["cloth.c@all"])",
     R"(6:7: "cloth.c@all" names points, not a body ^ write cloth.c)"},
    {"a filling of a rope", rope, R"([filling.w]
in = ["rope.r"])",
     "5:7: a rope has no surface ^ bodies with a surface are cloth, block"},
    {"a spring to no point", file, R"([net.n]
points = [{ name = "anna", position = [0, 0, 0] }, { name = "b", position = [1, 0, 0] }]
springs = [{ a = "b", b = "ana" }])",
     R"(4:27: there is no point "ana" ^ did you mean "anna"?)"},
    {"a spring from a point to itself", file, R"([net.n]
points = [{ name = "a", position = [0, 0, 0] }]
springs = [{ a = "a", b = "a" }])",
     "4:27: a spring needs two different points"},
    {"two points of one name", file, R"([net.n]
points = [{ name = "a", position = [0, 0, 0] }, { name = "a", position = [1, 0, 0] }])",
     R"(3:58: there is a point "a" already)"},
    {"a point with an impossible name", file, R"([net.n]
points = [{ name = "#1", position = [0, 0, 0] }])",
     R"(3:20: "#1" cannot be the name of a point ^ a name has letters, digits, - and _)"},
    {"a point called all", file, R"([net.n]
points = [{ name = "all", position = [0, 0, 0] }])",
     R"(3:20: "all" cannot be the name of a point: it means all of them)"},
    {"an unknown point of a net", file, R"([net.n]
points = [{ name = "a", position = [0, 0, 0] }]
[[mass]]
target = "net.n@b"
mass_kg = 1)",
     R"(5:10: net.n has no points "b" ^ it has a, all)"},
    {"a model that is not there", collider, R"(shape = "mesh"
mesh = "body.obj")",
     R"(4:8: there is no file "body.obj" ^ looked for body.obj)"},
    {"a picture that is not there", rope, R"(finish = { pattern = "image", texture = "art.png" })",
     R"(4:41: there is no file "art.png" ^ looked for art.png)"},
    {"a model that is a folder", collider, R"(shape = "mesh"
mesh = "models")",
     R"(4:8: there is no file "models" ^ looked for models)"},
    {"a model that is wrong", collider, R"(shape = "mesh"
mesh = "broken.obj")",
     "4:8: cannot use this mesh: broken.obj:4: error: there is no vertex 4: 3 are defined so far"},
    {"a picture that cannot be used", file, R"(environment = { image = "square.png" }
[rope.r]
ends = [[0, 0, 0], [1, 0, 0]]
finish = { pattern = "image", texture = "square.png" })",
     "2:25: cannot use this picture: square.png: too narrow"},
    // Fields that contradict each other.
    {"a mesh cloth with a size", cloth, R"(mesh = "square.obj"
size = [1, 1]
cells = [3, 3])",
     R"(6:1: size does not go with a cloth from a mesh ^ it belongs to a cloth grid
7:1: cells does not go with a cloth from a mesh ^ it belongs to a cloth grid)"},
    {"a grid with a position", cloth, "position = [0, 0, 0]",
     "5:1: position does not go with a cloth grid ^ it belongs to a cloth from a mesh"},
    {"holes in a grid", cloth, "cell_m = 0.1",
     "5:1: cell_m does not go with a cloth grid ^ it belongs to a cloth panel"},
    {"an outline that crosses itself", cloth, "outline = [[0, 0], [1, 1], [1, 0], [0, 1]]",
     "5:28: side 0 and side 2 cross or come nearer than a tenth of a cell: an outline goes round once and does not "
     "meet itself or a hole"},
    {"a hole outside, and edges that are none", cloth, R"(outline = [[0, 0], [1, 0], [0, 1]]
holes = [{ outline = [[2, 0], [3, 0], [2, 1]] }]
edges = [{ name = "side1", corners = [0, 1] },
         { name = "hem", corners = [0, 3] },
         { name = "hem", corners = [1, 1] }])",
     R"(6:23: this hole lies outside of the outline
7:19: "side1" cannot be the name of an edge ^ all, side0, side1, hole0 and so on are reserved
8:36: the outline has the corners 0 … 2
9:19: there is an edge "hem" already
9:36: an edge leads from one corner to another ^ from the last corner to the first the edge continues around: [3, 0])"},
    {"a sheet that no energy has", file, R"([material.m]
bending_rigidity_N_m = { warp = 9e-5, weft = 1e-5, bias = 9e-6 })",
     "3:59: the bias is too soft for this warp and weft ^ it must be above (√warp - √weft)²/4 = 1e-05 N m"},
    {"a hysteresis that slips nowhere", file, R"([material.m]
bending_rigidity_N_m = 1e-5
bending_hysteresis_N = 1e-3)",
     "4:24: a hysteresis needs the curvature at which threads slip ^ give bending_yield_per_m too, such as a tenth of "
     "2HB/(2B)"},
    {"a curvature at which nothing slips", file, R"([material.m]
bending_rigidity_N_m = 1e-5
bending_yield_per_m = 5)",
     "4:23: a yield curvature needs a hysteresis ^ give bending_hysteresis_N too"},
    {"a hysteresis without bending rigidity", file, R"([material.m]
bending_hysteresis_N = 1e-3
bending_yield_per_m = 5)",
     "3:24: a hysteresis needs a bending rigidity ^ give bending_rigidity_N_m too"},
    {"a block of a ratio and a pressure", file, R"([block.b]
bulk_Pa = 1e5
poisson = 0.3)",
     "3:11: [block.b] has either bulk_Pa or poisson ^ leave one out"},
    {"a curve that nothing keeps", rope, "closed = true\nrest_curved = true",
     "5:15: without a bending rigidity nothing keeps the curve ^ give bending_rigidity_N_m2 too"},
    {"a plane with a radius", collider, R"(shape = "plane"
radius = 1)",
     R"(4:1: radius does not go with shape "plane" ^ it belongs to sphere, capsule, cylinder, cone)"},
    {"a sphere with a size", collider, R"(shape = "sphere"
size = [1, 1, 1])",
     R"(4:1: size does not go with shape "sphere" ^ it belongs to box)"},
    {"a box with a normal", collider, R"(shape = "box"
normal = [0, 1, 0])",
     R"(4:1: normal does not go with shape "box" ^ it belongs to plane)"},
    {"parts of a shape that is not a compound", collider, R"(shape = "box"
parts = [])",
     R"(4:1: parts does not go with shape "box" ^ it belongs to compound)"},
    {"a compound without parts", collider, R"(shape = "compound"
parts = [])",
     "4:9: a compound needs parts"},
    {"a compound within a compound", collider, R"(shape = "compound"
parts = [{ shape = "compound" }])",
     R"(4:20: shape must be one of box, sphere, capsule, cylinder, cone, hull, mesh, not "compound")"},
    {"a place beside keys", collider, R"(shape = "sphere"
position = [0, 0, 0]
keys = [{ t = 0 }])",
     "4:1: a collider with keys has no position of its own ^ write it into the keys"},
    {"keys that do not ascend", collider, R"(shape = "sphere"
keys = [{ t = 0 }, { t = 2 }, { t = 1 }])",
     "4:37: keys must ascend in t: 1 follows 2"},
    {"two keys at one time", file, R"([camera.c]
keys = [{ t = 1, eye = [0, 1, 5], target = [0, 1, 0] }, { t = 1, eye = [0, 1, 6], target = [0, 1, 0] }])",
     "3:63: keys must ascend in t: 1 follows 1"},
    {"an orbit beside keys", file, R"([camera.c]
orbit_period_s = 3
keys = [{ t = 0, eye = [0, 1, 5], target = [0, 1, 0] }])",
     "3:1: orbit_period_s does not go with a camera with keys ^ it belongs to an orbiting camera"},
    {"an orbit without a period", file, "[camera.c]\norbit_period_s = 0", "3:18: orbit_period_s must not be 0"},
    {"a camera at its target", file, R"([camera.c]
eye = [0, 1, 0]
target = [0, 1, 0])",
     "3:7: eye and target are the same point"},
    {"a camera that looks straight down", file, R"([camera.c]
eye = [0, 5, 0]
target = [0, 1, 0])",
     "3:7: the camera looks straight up or down ^ move eye a little aside"},
    {"a weld with a stiffness", rope, R"([[joint]]
a = "rope.r@start"
b = "rope.r@end"
stiffness_N_per_m = 10)",
     "7:1: stiffness_N_per_m does not go with a weld ^ it belongs to a spring joint"},
    {"a spring joint with a reach", rope, R"([[joint]]
a = "rope.r@start"
b = "rope.r@end"
kind = "spring"
reach_m = 1)",
     "8:1: reach_m does not go with a spring joint ^ it belongs to a weld"},
    {"a picture without its file", rope, R"(finish = { pattern = "image" })",
     "4:1: finish of [rope.r] needs texture ^ texture is a text: Picture file, PNG or JPEG"},
    {"a file without its pattern", rope, R"(finish = { texture = "square.png" })",
     "4:12: texture does not go with a painted pattern ^ it belongs to the pattern image"},
    {"a ground that ends before it fades", file, R"([background]
fade_start = 20
fade_end = 10)",
     "4:12: fade_end must be above fade_start"},
    {"a ground that fades beyond its end", file, "[background]\nfade_start = 50",
     "3:14: fade_end must be above fade_start"},
    {"a slanted cloth", cloth, "across = [1, 1, 0]",
     "5:10: across and down must be at right angles ^ set down too; its default is [0, -1, 0]"},
    {"a slanted cloth in both directions", cloth, "across = [1, 0, 0]\ndown = [1, -1, 0]",
     "6:8: across and down must be at right angles"},
    {"a rope from a point to itself", file, "[rope.r]\nends = [[1, 2, 3], [1, 2, 3]]",
     "3:8: the two ends are the same point"},
    {"a length for a rope that is as long as its way", rope, "length_m = 2\nthrough = [{ position = [0.5, 1, 0] }]",
     "4:12: a rope with `through` is as long as its way ^ leave length_m out"},
    {"copies in one place", rope, "array = { count = [2, 1, 1] }",
     "4:19: the 2 copies lie in the same place ^ give step_x"},
    {"a net without points", file, "[net.n]\npoints = []", "3:10: a net needs points"},
    // Actions that are incomplete.
    {"an action without a moment", ropeAction, R"({ do = "grab", id = "h", target = "rope.r@end" })",
     "3:3: [[at]] needs t ^ t is a number [s]: Time, rounded to the nearest tick"},
    {"an action that does nothing", ropeAction, R"({ t = 1, target = "rope.r@end" })",
     "3:3: [[at]] needs do ^ do is one of grab, move, release, push, hold, free, cut, add-mass, ramp, spawn: "
     "Action"},
    {"an unknown action", ropeAction, R"({ t = 1, do = "gab", id = "h", target = "rope.r@end" })",
     "3:17: do must be one of grab, move, release, push, hold, free, cut, add-mass, ramp, spawn, not \"gab\" ^ did you "
     "mean \"grab\"?"},
    {"a key of another action", ropeAction,
     R"({ t = 1, do = "grab", id = "h", target = "rope.r@end", impulse_Ns = [1, 0, 0] })",
     R"(3:58: impulse_Ns does not go with do "grab" ^ it belongs to push)"},
    {"a grab of nothing", ropeAction, R"({ t = 1, do = "grab", id = "h" })",
     R"(3:3: do = "grab" needs target ^ write target = "KIND.NAME@SELECTOR")"},
    {"a grab by nobody", ropeAction, R"({ t = 1, do = "grab", target = "rope.r@end" })",
     R"(3:3: do = "grab" needs id ^ id is the name of the hand)"},
    {"a rigid hand with a largest force", ropeAction,
     R"({ t = 1, do = "grab", id = "h", target = "rope.r", rigid = true, max_force_N = 30 })",
     "3:82: a rigid hand leads its points with unlimited force ^ leave max_force_N or rigid out"},
    {"a hand without a name", ropeAction, R"({ t = 1, do = "grab", id = "", target = "rope.r@end" })",
     "3:30: a hand needs a name"},
    {"a move of nothing", ropeAction, R"({ t = 1, do = "move", to = [0, 0, 0] })",
     R"(3:3: do = "move" needs id or target ^ write id = "HAND" or target = "collider.NAME")"},
    {"a move of two things", ropeAction, R"({ t = 1, do = "move", id = "h", target = "collider.b", to = [0, 0, 0] })",
     "3:44: a move has id or target, not both ^ a hand has an id, a collider is a target"},
    {"a move to nowhere", ropeAction, R"({ t = 1, do = "move", id = "h" })",
     R"(3:3: do = "move" needs to ^ write to = [x, y, z])"},
    {"a move to a number", ropeAction, R"({ t = 1, do = "move", id = "h", to = 3 })",
     "3:40: to must be a list of 3 numbers [m], not 3"},
    {"a push of nothing", ropeAction, R"({ t = 1, do = "push", target = "rope.r@end", impulse_Ns = [0, 0, 0] })",
     "3:61: a push of [0, 0, 0] does nothing"},
    {"a push without an impulse", ropeAction, R"({ t = 1, do = "push", target = "rope.r@end" })",
     "3:3: [[at]] needs impulse_Ns ^ impulse_Ns is a list of 3 numbers [N s]: Of all the points, shared by mass"},
    {"a cut along two things", file, R"(at = [
  { t = 1, do = "cut", target = "cloth.c", plane = [[0, 0, 0], [1, 0, 0]], segment = [[0, 0], [1, 1]] },
]
[cloth.c]
material = "m"
[material.m])",
     "3:86: a cut has a plane or a segment, not both ^ leave one out; without either all of the body comes apart"},
    {"a cut along a point", clothAction,
     R"({ t = 1, do = "cut", target = "cloth.c", segment = [[0.5, 0.5], [0.5, 0.5]] })",
     "3:54: the two ends of the cut are the same point"},
    {"a cut along a plane that faces nowhere", ropeAction,
     R"({ t = 1, do = "cut", target = "rope.r", plane = [[0, 0, 0], [0, 0, 0]] })",
     "3:51: the normal of the plane must not be [0, 0, 0]"},
    {"a cut beyond the cloth", clothAction,
     R"({ t = 1, do = "cut", target = "cloth.c", segment = [[0.5, 0.5], [0.5, 1.5]] })",
     "3:73: segment[1][1] must be between 0 and 1, not 1.5"},
    {"a segment of a rope", ropeAction, R"({ t = 1, do = "cut", target = "rope.r", segment = [[0.5, 0.5], [0.5, 1]] })",
     "3:33: rope.r is no cloth grid: it has no segment ^ cut it with a plane"},
    {"a ramp to nowhere", ropeAction, R"({ t = 1, do = "ramp", key = "world.gravity" })",
     R"(3:3: do = "ramp" needs to ^ to is the value that the ramp ends at)"},
    {"a negative time", ropeAction, R"({ t = -1, do = "release", id = "h" })",
     "3:9: t must be between 0 and 1e+06 s, not -1"},
    {"actions that are no list", file, R"([at]
t = 1
[rope.r]
ends = [[0, 0, 0], [1, 0, 0]])",
     "2:2: at must be a list of tables, not a table ^ write [[at]]"},
    // Targets of actions that are not there.
    {"a body that is not there", ropeAction, R"({ t = 1, do = "push", target = "rope.s@end", impulse_Ns = [1, 0, 0] })",
     R"(3:34: there is no rope.s ^ did you mean "rope.r"?)"},
    {"points that are not there", ropeAction, R"({ t = 1, do = "hold", target = "rope.r@ent" })",
     R"(3:34: rope.r has no points "ent" ^ did you mean "end"?)"},
    {"an action at a point beyond the last", ropeAction, R"({ t = 1, do = "free", target = "rope.r@#41" })",
     "3:34: rope.r has no point #41 ^ its points are #0 … #40"},
    {"an action at a place on a rope", ropeAction, R"-({ t = 1, do = "grab", id = "h", target = "rope.r@(0,1)" })-",
     "3:44: rope.r is no grid: it has no (u,v)"},
    {"a kind that is none", ropeAction, R"({ t = 1, do = "add-mass", target = "robe.r@end", mass_kg = 1 })",
     R"(3:38: "robe" is no kind of body ^ did you mean "rope"?)"},
    {"a collider that is not there", ropeAction, R"({ t = 1, do = "move", target = "collider.bal", to = [0, 0, 0] })",
     R"(3:34: there is no collider.bal ^ did you mean "collider.ball"?)", R"([collider.ball]
shape = "sphere"
)"},
    {"a body moved like a collider", ropeAction, R"({ t = 1, do = "move", target = "rope.r", to = [0, 0, 0] })",
     R"(3:34: "rope.r" is no collider ^ a move takes a collider, or the id of a hand)"},
    {"a collider led twice", ropeAction, R"({ t = 1, do = "move", target = "collider.ball", to = [0, 0, 0] })",
     "3:34: collider.ball follows its keys ^ move it by keys or by actions", R"([collider.ball]
shape = "sphere"
keys = [{ t = 0 }]
)"},
    {"a cut of points", ropeAction, R"({ t = 1, do = "cut", target = "rope.r@end", plane = [[0, 0, 0], [1, 0, 0]] })",
     R"(3:33: "rope.r@end" names points, not a body ^ write rope.r)"},
    {"a spawn of points", ropeAction, R"({ t = 1, do = "spawn", target = "rope.r@end" })",
     R"(3:35: "rope.r@end" names points, not a body ^ write rope.r)"},
    // Times that do not fit the run.
    {"an action after the end", ropeAction, R"({ t = 7.5, do = "hold", target = "rope.r@end" })",
     "3:9: 7.5 s is past the end: the last frame shows 4.98333 s ^ set seconds in [run]"},
    {"an action in the last frame", ropeAction, R"({ t = 4.99, do = "hold", target = "rope.r@end" })",
     "3:9: 4.99 s is past the end: the last frame shows 4.98333 s ^ set seconds in [run]"},
    {"a golden after the end", rope, "[[golden]]\nframes = [0, 299, 300]",
     "5:19: frame 300 is past the end: the last is 299"},
    {"a golden of nothing", rope, "[[golden]]\nframes = []", "5:10: frames must not be empty"},
    {"a golden before the start", rope, "[[golden]]\nframes = [-1]",
     "5:11: frames[0] must be between 0 and 1e+09, not -1"},
    {"a golden through no camera", rope, R"([[golden]]
frames = [1]
camera = "main")",
     R"(6:10: there is no camera "main" ^ add a table [camera.main])"},
    // Hands out of their order, and names of joints.
    {"a move before the grab", ropeAction, R"({ t = 1, do = "move", id = "h", to = [0, 0, 0] },
  { t = 2, do = "grab", id = "h", target = "rope.r@end" })",
     R"(3:30: "h" has grabbed nothing before 1 s)"},
    {"a release of nothing", ropeAction, R"({ t = 1, do = "release", id = "h" })",
     R"(3:33: "h" has grabbed nothing before 1 s)"},
    {"a mistyped hand", ropeAction, R"({ t = 1, do = "grab", id = "left", target = "rope.r@end" },
  { t = 2, do = "release", id = "lefd" })",
     R"(4:33: "lefd" has grabbed nothing before 2 s ^ did you mean "left"?)"},
    {"a move after the release", ropeAction, R"({ t = 1, do = "grab", id = "h", target = "rope.r@end" },
  { t = 2, do = "release", id = "h" },
  { t = 3, do = "move", id = "h", to = [0, 0, 0] })",
     R"(5:30: "h" was released before 3 s)"},
    {"a second grab", ropeAction, R"({ t = 1, do = "grab", id = "h", target = "rope.r@end" },
  { t = 2, do = "grab", id = "h", target = "rope.r@start" })",
     R"(4:30: "h" holds something since 1 s ^ release it first, or give this hand another id)"},
    {"a hand called as a joint", joint, R"(at = [{ t = 1, do = "grab", id = "peg", target = "rope.r@end" }])",
     R"(2:34: "peg" is the name of a joint ^ give the hand another id, because release takes the name of either)"},
    {"a mistyped joint", joint, R"(at = [{ t = 1, do = "release", id = "pegg" }])",
     R"(2:37: "pegg" has grabbed nothing before 1 s, and no joint has that name ^ did you mean "peg"?)"},
    {"a release where joints have no names", file, R"(at = [{ t = 1, do = "release", id = "peg" }]
[rope.r]
ends = [[0, 0, 0], [1, 0, 0]]
[[joint]]
a = "rope.r@start"
b = "rope.r@end"
kind = "rod")",
     R"(2:37: "peg" has grabbed nothing before 1 s ^ a joint or a seam is released by its name; give it one)"},
    {"a claim about a joint that is not there", joint, R"(check = [{ that = "joints_left(pig) == 1" }])",
     R"(2:32: there is no joint "pig" ^ did you mean "peg"?)"},
    // Actions that contradict one another.
    {"a hand on two ways", ropeAction, R"({ t = 1, do = "grab", id = "h", target = "rope.r@end" },
  { t = 1, do = "move", id = "h", to = [0, 1, 0], over_s = 2 },
  { t = 2.5, do = "move", id = "h", to = [0, 0, 0] })",
     R"(5:9: "h" is moved from 1 s to 3 s already)"},
    {"a collider on two ways", ropeAction, R"({ t = 1, do = "move", target = "collider.b", to = [0, 1, 0], over_s = 1 },
  { t = 1, do = "move", target = "collider.b", to = [0, 0, 0] })",
     "4:9: collider.b is moved from 1 s to 2 s already", R"([collider.b]
shape = "box"
)"},
    {"two ramps of one field", ropeAction, R"({ t = 2, do = "ramp", key = "world.gravity", to = [0, 0, 0], over_s = 1 },
  { t = 1, do = "ramp", key = "world.gravity", to = [0, 9, 0], over_s = 1.5 })",
     "3:9: world.gravity is changed from 1 s to 2.5 s already"},
    {"points held and freed", ropeAction, R"({ t = 1, do = "hold", target = "rope.r@end" },
  { t = 1, do = "free", target = "rope.*" })",
     "4:34: points of rope.r are held and freed at the same moment"},
    {"a body spawned twice", ropeAction, R"({ t = 1, do = "spawn", target = "rope.r" },
  { t = 2, do = "spawn", target = "rope.*" })",
     "4:35: rope.r is spawned already at 1 s"},
    {"a body of a joint spawned", ropeAction, R"({ t = 1, do = "spawn", target = "rope.s" })",
     "3:35: a joint ties rope.s: it cannot be spawned", R"([rope.s]
ends = [[1, 0, 0], [2, 0, 0]]
[[joint]]
a = "rope.r@end"
b = "rope.s@start"
)"},
    {"a push before the spawn", ropeAction, R"({ t = 1, do = "push", target = "rope.r@end", impulse_Ns = [1, 0, 0] },
  { t = 2, do = "spawn", target = "rope.r" })",
     "3:34: rope.r@end is not there before it is spawned at 2 s"},
    // Ramps of keys that cannot change.
    {"an unknown section", ropeAction, R"({ t = 1, do = "ramp", key = "wnid.w.velocity", to = [0, 0, 0] })",
     R"(3:31: there is no "wnid" to change ^ did you mean "wind"?)"},
    {"a section that nothing changes in", ropeAction, R"({ t = 1, do = "ramp", key = "solver.dt", to = 0.1 })",
     "3:31: no key of solver can change while the scene runs ^ keys of ramps: world, material, rope, block, net, "
     "anchor, wind, filling, collider, camera, light, lamp, environment, background"},
    {"an unknown wind", ropeAction, R"({ t = 1, do = "ramp", key = "wind.breze.velocity", to = [0, 0, 0] })",
     R"(3:31: there is no wind "breze" ^ did you mean "breeze"?)", "[wind.breeze]\n"},
    {"a wind where there is none", ropeAction,
     R"({ t = 1, do = "ramp", key = "wind.breeze.velocity", to = [0, 0, 0] })",
     R"(3:31: there is no wind "breeze" ^ the scene has none)"},
    {"an unknown field", ropeAction, R"({ t = 1, do = "ramp", key = "wind.breeze.velocty", to = [0, 0, 0] })",
     R"(3:31: [wind.breeze] has no key "velocty" ^ did you mean "velocity"?)", "[wind.breeze]\n"},
    {"a key without a field", ropeAction, R"({ t = 1, do = "ramp", key = "wind.breeze", to = [0, 0, 0] })",
     R"(3:31: "wind.breeze" names no field ^ keys of ramps: velocity, gust.amplitude, drag, lift)", "[wind.breeze]\n"},
    {"a number of segments", ropeAction, R"({ t = 1, do = "ramp", key = "rope.r.segments", to = 12 })",
     "3:31: rope.r.segments cannot change while the scene runs ^ keys of ramps: stretch_N, bend_N, "
     "bending_rigidity_N_m2, damping_time_s, drag_per_s"},
    {"a field without a value", clothAction, R"({ t = 1, do = "ramp", key = "material.m.shear_N_per_m", to = 12 })",
     "3:31: material.m.shear_N_per_m has no value to begin from ^ give it in [material.m]"},
    {"the eye of a camera with keys", ropeAction, R"({ t = 1, do = "ramp", key = "camera.c.eye", to = [0, 0, 0] })",
     "3:31: camera.c is a camera with keys, which has no eye", R"([camera.c]
keys = [{ t = 0, eye = [0, 0, 1], target = [0, 0, 0] }]
)"},
    {"a number for a vector", ropeAction, R"({ t = 1, do = "ramp", key = "world.gravity", to = -1.6 })",
     "3:53: gravity must be a list of 3 numbers [m/s²], not -1.6"},
    {"too many components", ropeAction, R"({ t = 1, do = "ramp", key = "world.gravity", to = [0, 0, 0, 0] })",
     "3:53: gravity must be a list of 3 numbers [m/s²], not a list of 4"},
    {"a vector for a number", ropeAction, R"({ t = 1, do = "ramp", key = "rope.r.stretch_N", to = [1, 2] })",
     "3:56: stretch_N must be a number [N], not a list of 2"},
    {"a value out of its range", ropeAction, R"({ t = 1, do = "ramp", key = "rope.r.stretch_N", to = -5 })",
     "3:56: stretch_N must be above 0 N, not -5"},
    {"a word for a number", ropeAction, R"({ t = 1, do = "ramp", key = "rope.r.stretch_N", to = "soft" })",
     R"(3:56: to must be a number, a list of numbers or "#rrggbb", not "soft")"},
    // Seams that the run does not see or sees twice.
    {"a seam past the end", file, R"(run = { seconds = 2 }
[[seam]]
a = "cloth.a@right"
b = "cloth.b@left"
start_s = 2
over_s = 1
[material.m]
[cloth.a]
material = "m"
[cloth.b]
material = "m")",
     "6:11: 2 s is past the end: the last frame shows 1.98333 s ^ set seconds in [run]"},
    {"a seam twice", file, R"([[seam]]
a = "cloth.a@right"
b = "cloth.b@left"
[[seam]]
a = "cloth.b@left"
b = "cloth.a@right"
over_s = 1
[material.m]
[cloth.a]
material = "m"
[cloth.b]
material = "m")",
     "5:1: this seam is there already, in line 2"},
    // Claims that cannot be read.
    {"an empty claim", claim, "", "5:9: this claim is empty ^ write e.g. max_strain(cloth.*) < 0.1"},
    {"half a claim", claim, "max_strain(rope.r)", "5:27: a claim compares two things ^ add e.g. < 0.1"},
    {"a claim without a bound", claim, "max_strain(rope.r) <",
     "5:29: the end stands where a number or a function is expected"},
    {"an assignment", claim, "max_strain(rope.r) = 1", "5:28: a claim compares with ==, not ="},
    {"an unknown function", claim, "0.1 > max_stain(rope.r)",
     R"(5:15: there is no function "max_stain" ^ did you mean "max_strain"?)"},
    {"a function that resembles none", claim, "zzz(rope.r) < 1",
     R"(5:9: there is no function "zzz" ^ see taut schema --manual)"},
    {"no axis", claim, "shadow(rope.r, up) < 1", "5:24: an axis is x, y or z ^ write shadow(BODIES, AXIS)"},
    {"too few arguments", claim, "distance(rope.r@end) < 1",
     "5:9: distance takes 2 arguments ^ write distance(PLACE, PLACE)"},
    {"too many arguments", claim, "1 < speed(rope.r, rope.r)", "5:13: speed takes 1 argument ^ write speed(POINTS)"},
    {"no arguments", claim, "speed < 1", "5:9: speed needs its arguments ^ write speed(POINTS)"},
    {"a missing target", claim, "speed() < 1", "5:9: speed takes 1 argument ^ write speed(POINTS)"},
    {"a bracket that stays open", claim, "2 * (speed(rope.r) + 1 < 3", R"-(5:32: ")" is missing behind this)-"},
    {"an argument of a function of none", claim, "time(rope.r) < 1", "5:9: time takes nothing ^ write time"},
    {"a vector without a component", claim, "position(rope.r@end) < 1",
     "5:9: this has three components ^ add .x, .y or .z, or take length(…)"},
    {"a component of a number", claim, "speed(rope.r).x < 1", "5:22: only a vector has components"},
    {"an unknown component", claim, "position(rope.r).w < 1", "5:25: behind the point stands x, y or z"},
    {"a number plus a vector", claim, "position(rope.r).x + momentum(rope.r) < 1",
     "5:28: a number and a vector cannot be added or subtracted"},
    {"a product of vectors", claim, "length(momentum(rope.r) * momentum(rope.r)) < 1",
     "5:33: two vectors cannot be multiplied"},
    {"a unit behind a number", claim, "speed(rope.r) < 3 m",
     R"(5:27: "m" stands where a comparison is expected ^ use < <= > >= == or !=)"},
    {"a unit at a number", claim, "speed(rope.r) < 3m",
     "5:26: a number has no unit behind it ^ values are in SI units, see taut schema --manual"},
    {"a chain that turns back", claim, "1 < speed(rope.r) > 2",
     "5:27: a chain of comparisons must go one way, as in 0.1 < x < 0.2"},
    {"a claim about nothing", claim, "1 < 2", "5:9: this claim does not depend on the scene"},
    {"a place with two parts", claim, "distance(rope.r, [0, 1]) < 1",
     R"(5:31: "," is missing between the three components)"},
    {"a body without a kind", claim, "speed(r) < 1", R"(5:15: "r" is no target ^ write KIND.NAME, e.g. cloth.flag)"},
    {"a sign that means nothing", claim, "speed(rope.r) < 1 & 2",
     R"(5:27: "&" stands where a comparison is expected ^ use < <= > >= == or !=)"},
    {"an escape before the fault", file, R"([[check]]
that = "\u0074ime < 1 $"
[rope.r]
ends = [[0, 0, 0], [1, 0, 0]])",
     R"(3:23: "$" stands where a comparison is expected ^ use < <= > >= == or !=)"},
    {"a claim between three quotes", file, R"([[check]]
that = '''time < 1 $'''
[rope.r]
ends = [[0, 0, 0], [1, 0, 0]])",
     R"(3:20: "$" stands where a comparison is expected ^ use < <= > >= == or !=)"},
    {"a claim behind letters of two bytes", file, R"([[check]]
that = "time < 1 é"
[rope.r]
ends = [[0, 0, 0], [1, 0, 0]])",
     R"(3:18: "é" stands where a comparison is expected ^ use < <= > >= == or !=)"},
    // Claims about missing things.
    {"an unknown body", claim, "time > 3 * speed(rope.rr)", R"(5:26: there is no rope.rr ^ did you mean "rope.r"?)"},
    {"an unknown selector", claim, "speed(rope.r@ent) < 1",
     R"(5:15: rope.r has no points "ent" ^ did you mean "end"?)"},
    {"points of a function of bodies", claim, "max_strain(rope.r@end) < 1",
     R"(5:20: "rope.r@end" names points, not a body ^ write rope.r)"},
    {"a second target", claim, "distance(rope.r@end, cloth.c@left) < 1", "5:30: there is no cloth.c"},
    {"what is between a body and itself", claim, "gap(rope.r, rope.*) > 0.01",
     "5:21: rope.r and rope.* are the same body, with nothing in between ^ name another body"},
    {"what is between bodies before the spawn of one", file, R"(at = [{ t = 2, do = "spawn", target = "rope.r" }]
[rope.r]
ends = [[0, 0, 0], [1, 0, 0]]
[rope.q]
ends = [[0, 1, 0], [1, 1, 0]]
[[check]]
that = "gap(rope.q, rope.r) > 0.01")",
     "8:21: rope.r is not there at 0 s: it is spawned at 2 s ^ give the check a later from"},
    {"a body before its spawn", file, R"(at = [{ t = 2, do = "spawn", target = "rope.r" }]
[rope.r]
ends = [[0, 0, 0], [1, 0, 0]]
[[check]]
that = "height(rope.r) < 1"
from = 1.5)",
     "6:16: rope.r is not there at 1.5 s: it is spawned at 2 s ^ give the check a later from"},
    {"a moment after the end", claim, "speed(rope.r) < 1",
     "6:6: 5 s is past the end: the last frame shows 4.98333 s ^ set seconds in [run]", "at = 5\n"},
    {"a span after the end", claim, "speed(rope.r) < 1",
     "7:6: 6 s is past the end: the last frame shows 4.98333 s ^ set seconds in [run]", "from = 1\nto = 6\n"},
    {"a span that ends before it begins", claim, "speed(rope.r) < 1", "7:6: to must come after from",
     "from = 2\nto = 1\n"},
    {"a moment and a span", claim, "speed(rope.r) < 1",
     "7:1: to does not go with a check at a moment ^ it belongs to a check of a span", "at = 2\nto = 3\n"},
    {"a check without a claim", file, R"([[check]]
at = 1
[rope.r]
ends = [[0, 0, 0], [1, 0, 0]])",
     "2:1: [[check]] needs that ^ that is a text: Claim, e.g. \"max_strain(cloth.*) < 0.1\"; it must hold at "
     "every tick unless a time or a span is given"},
};

constexpr Row doubted[] = {
    {"crossings of a rope", ropesClaim, R"-(touch = "others"
[[check]]
that = "1 > 2 * crossings(rope.r)")-",
     R"(8:27: rope.r touches nothing: crossings is always 0 ^ give it touch = "others" or "all")"},
    {"contacts of bodies", ropesClaim, R"-([[check]]
that = "body_contacts() < 1")-",
     R"(7:9: no body touches anything: body_contacts is always 0 ^ give it touch = "others" or "all")"},
    {"a touch of two ropes", ropesClaim, R"-(touch = "others"
[[check]]
that = "touching(rope.touching, rope.r) < 1")-",
     "8:33: rope.r touches nothing: it passes through other bodies ^ give it touch = \"others\" or "
     "\"all\""},
    {"a penetration of faces", ropesClaim, R"-([[check]]
that = "face_penetration(rope.*) < 1")-",
     "7:26: rope.* meets no corners or edges of colliders: face_penetration is always 0 ^ give it collide = \"faces\", "
     "or touch"},
    {"faces that meet a rope", ropesClaim, R"-(collide = "faces"
[[check]]
that = "face_penetration() < 1")-",
     ""},
    {"what one of the ropes touches", ropesClaim, R"-(touch = "others"
[[check]]
that = "crossings(rope.*) + crossings() + gap(rope.r, rope.touching) < 1")-",
     ""},
};

std::string sceneOf(const Row& row) {
    std::string scene = std::string("schema = 1\n") + row.around + row.more;
    return scene.replace(scene.find(gap), gap.size(), row.text);
}

// The messages as the loader writes them, in which the line of the scene and a caret below it follow the fault.
std::vector<std::string> messagesOf(const Row& row, const std::string& severity) {
    std::vector<std::string> lines;
    std::istringstream scene(sceneOf(row));
    for (std::string line; std::getline(scene, line);) lines.push_back(line);
    std::vector<std::string> messages;
    std::istringstream said(row.messages);
    for (std::string message; std::getline(said, message);) {
        std::size_t number = 0;
        std::size_t column = 0;
        char colon = 0;
        std::istringstream place(message);
        place >> number >> colon >> column;
        const std::size_t what = std::min(message.find(": "), message.size());
        const std::size_t caret = std::min(message.find(" ^"), message.size());
        if (!place || number == 0 || number > lines.size()) {
            ADD_FAILURE() << "no place of the scene: " << message;
            continue;
        }
        messages.push_back("s.toml:" + message.substr(0, what) + ": " + severity + message.substr(what, caret - what) +
                           "\n  " + lines[number - 1] + "\n" + std::string(column, ' ') +
                           (caret < message.size() ? message.substr(caret) : " ^"));
    }
    return messages;
}

TEST(SceneErrors, AreReportedWithTheirPlaceAndARemedy) {
    const AssetFolder folder;
    LoadOptions options;
    // The caller decides which pictures can be used.
    options.pictureFault = [](const std::filesystem::path& picture, bool isAround) {
        return isAround ? picture.filename().string() + ": too narrow" : "";
    };
    for (const Row& row : refused) {
        SCOPED_TRACE(row.fault);
        std::string expected;
        for (const std::string& message : messagesOf(row, "error"))
            expected += (expected.empty() ? "" : "\n") + message;
        EXPECT_EQ(folder.messageOf(sceneOf(row), options), expected);
    }
}

TEST(SceneWarnings, ClaimsThatCountWhatNeverHappensAreDoubted) {
    const AssetFolder folder;
    for (const Row& row : doubted) {
        SCOPED_TRACE(row.fault);
        std::vector<std::string> warnings = printed(folder.load(sceneOf(row)).warnings);
        for (std::string& warning : warnings) warning = folder.withoutFolder(warning);
        EXPECT_EQ(warnings, messagesOf(row, "warning"));
    }
}

}  // namespace
}  // namespace taut::scene::refusals
