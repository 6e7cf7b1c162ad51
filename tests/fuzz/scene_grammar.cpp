#include "fuzz/scene_grammar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace taut::fuzz {
namespace {

class Choices {
  public:
    explicit Choices(View bytes) : rest_(bytes) {}

    int below(int count) { return static_cast<int>(byte() * static_cast<unsigned>(count) >> 8U); }
    // The rarer of two, never at the end of the bytes.
    bool oneIn(int count) { return below(count) == count - 1; }
    const char* of(const std::vector<const char*>& words) { return words[below(static_cast<int>(words.size()))]; }
    double between(double least, double most) {
        const unsigned high = byte(), low = byte();
        return least + (most - least) * (high << 8U | low) / 65535.0;
    }
    // Even in its logarithm.
    double magnitude(double least, double most) { return std::exp(between(std::log(least), std::log(most))); }
    std::string vector(double most) {
        const double x = between(-most, most), y = between(-most, most), z = between(-most, most);
        return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", x, y, z);
    }

  private:
    unsigned byte() {
        if (rest_.empty()) return 0;
        const unsigned value = rest_.front();
        rest_ = rest_.subspan(1);
        return value;
    }

    View rest_;
};

class Growing {
  public:
    explicit Growing(View bytes) : choices_(bytes) {}

    GrownScene scene() {
        add({"schema = 1\nrun = {{ fps = {}, seconds = 1 }}\n", choices_.of({"60", "24", "120", "1000"})});
        addSolver();
        if (choices_.oneIn(4)) add({"world.gravity = {}\n", choices_.vector(50)});
        if (choices_.oneIn(4)) add({"contact.friction = {:.6g}\n", choices_.magnitude(1e-3, 10)});
        if (choices_.oneIn(8)) add({"contact.detections = {}\n", choices_.of({"1", "2", "16"})});
        addMaterial();
        const int colliders = choices_.below(3), bodies = 1 + choices_.below(3);
        isJoined_ = bodies > 1 && choices_.oneIn(4);
        for (int i = 0; i < colliders; ++i) addCollider(i);
        for (int i = 0; i < bodies; ++i) addBody(i, colliders);
        addTies(colliders);
        if (bodies > 1 && !isJoined_ && choices_.oneIn(5)) {
            happens(choices_.below(4), {"do = \"spawn\"\ntarget = \"{}\"\n", bodies_.back().name});
            bodies_.pop_back();
        }
        for (int i = choices_.below(4); i > 0; --i) addAction();
        addFilling();
        addFigure(colliders);
        return {text_ + timeline_, isClosed_ && timeline_.empty()};
    }

  private:
    struct Own {
        std::string name;  // "cloth.b0"
        std::vector<const char*> selectors;
        bool isHeld = false;
    };

    // In braces, so that its parts are chosen in the order in which they are written.
    struct Text : std::string {
        template <class... Parts>
        Text(fmt::format_string<Parts...> text, Parts&&... parts)
            : std::string(fmt::format(text, std::forward<Parts>(parts)...)) {}
    };
    void add(const Text& text) { text_ += text; }
    void happens(int tick, const Text& text) { timeline_ += fmt::format("[[at]]\nt = {:.6g}\n{}", tick / 60.0, text); }

    void addSolver() {
        add({"solver.integrator = \"{}\"\n",
             choices_.of({"leapfrog", "implicit-euler", "velocity-verlet", "symplectic-euler", "rk4", "heun",
                          "midpoint", "euler", "blanes-moan", "sdirk2"})});
        if (choices_.oneIn(3)) add({"solver.precision = \"double\"\n"});
        if (choices_.oneIn(4)) add({"solver.dt = {:.6g}\n", choices_.magnitude(2e-4, 2e-2)});
        if (choices_.oneIn(4)) add({"solver.on_divergence = \"freeze\"\n"});
        if (choices_.oneIn(8)) add({"solver.newton_steps = 3\n"});
    }

    void addGivingWay() {
        if (choices_.oneIn(5)) add({"yield_strain = {:.6g}\n", choices_.magnitude(1e-3, 1)});
        if (choices_.oneIn(5)) add({"break_strain = {:.6g}\n", choices_.magnitude(1e-2, 1)});
    }
    void addDamping() {
        if (choices_.oneIn(2)) add({"damping_time_s = {:.6g}\n", choices_.magnitude(1e-7, 1e-1)});
    }

    void addMaterial() {
        add({"[material.m]\n"});
        if (choices_.oneIn(2)) add({"stretch_N_per_m = {:.6g}\n", choices_.magnitude(1e-1, 1e5)});
        if (choices_.oneIn(2)) add({"density_kg_per_m2 = {:.6g}\n", choices_.magnitude(1e-3, 10)});
        if (choices_.oneIn(3))
            add({"bend_N_per_m = {:.6g}\n", choices_.magnitude(1e-3, 1e4)});
        else if (choices_.oneIn(2))
            add({"bending_rigidity_N_m = {:.6g}\n", choices_.magnitude(1e-6, 1)});
        addDamping();
        addGivingWay();
    }

    // About a third of a metre.
    std::string shape(const char* comma) {
        const std::string kind = choices_.of({"box", "sphere", "capsule", "cone", "cylinder"});
        if (kind == "box")
            return Text{"shape = \"box\"{}size = [{:.6g}, {:.6g}, {:.6g}]", comma, choices_.between(0.05, 0.5),
                        choices_.between(0.05, 0.5), choices_.between(0.05, 0.5)};
        if (kind == "sphere") return Text{"shape = \"sphere\"{}radius = {:.6g}", comma, choices_.between(0.02, 0.3)};
        return Text{"shape = \"{0}\"{1}radius = {2:.6g}{1}height = {3:.6g}", kind, comma, choices_.between(0.02, 0.3),
                    choices_.between(0.05, 0.5)};
    }

    void addCollider(int number) {
        add({"[collider.c{}]\n", number});
        if (choices_.oneIn(4))
            add({"shape = \"compound\"\nparts = [{{ {} }}, {{ {}, position = {} }}]\n", shape(", "), shape(", "),
                 choices_.vector(0.3)});
        else if (choices_.oneIn(4))
            add({"shape = \"plane\"\n"});
        else
            add({"{}\n", shape("\n")});
        const double y = choices_.between(-0.4, 0);
        if (choices_.oneIn(3)) {
            isClosed_ = false;
            const double turn = choices_.magnitude(0.01, 0.3);  // it begins, turns, and ends
            add(
                {"keys = [{{ t = {:.6g}, position = [0, {:.6g}, 0] }}, {{ t = {:.6g}, position = {}, rotation_deg = {} "
                 "}}, {{ t = {:.6g}, position = {}, ease = \"linear\" }}]\n",
                 choices_.oneIn(2) ? turn / 3 : 0.0, y, turn, choices_.vector(0.4), choices_.vector(180),
                 turn + choices_.magnitude(0.01, 0.3), choices_.vector(0.4)});
        } else {
            movable_ = Text{"collider.c{}", number};
            add({"position = [{:.6g}, {:.6g}, {:.6g}]\n", choices_.between(-0.2, 0.2), y, choices_.between(-0.2, 0.2)});
            if (choices_.oneIn(2)) add({"rotation_deg = {}\n", choices_.vector(180)});
        }
        if (choices_.oneIn(3)) add({"friction = {:.6g}\n", choices_.magnitude(1e-3, 10)});
        if (choices_.oneIn(3)) add({"restitution = {:.6g}\n", choices_.between(0, 1)});
    }

    void addBody(int number, int colliders) {
        switch (choices_.below(5)) {
            case 0:
                bodies_.push_back({Text{"cloth.b{}", number},
                                   {"top", "left", "corners", "top-left", "(0.5,0.5)", "bottom-right", "all"}});
                add({"[{}]\nmaterial = \"m\"\nsize = [{:.6g}, {:.6g}]\ncells = [{}, {}]\norigin = {}\n",
                     bodies_.back().name, choices_.between(0.1, 0.5), choices_.between(0.1, 0.5), 1 + choices_.below(5),
                     1 + choices_.below(5), choices_.vector(0.15)});
                if (!choices_.oneIn(3)) add({"down = [0, 0, 1]\n"});
                break;
            case 1:
                bodies_.push_back({Text{"rope.b{}", number}, {"start", "end", "ends", "50%", "all"}});
                add({"[{}]\nends = [{}, {}]\nsegments = {}\nmass_kg = {:.6g}\nstretch_N = {:.6g}\n",
                     bodies_.back().name, choices_.vector(0.2), choices_.vector(0.2), 1 + choices_.below(7),
                     choices_.magnitude(1e-3, 10), choices_.magnitude(1, 1e5)});
                if (choices_.oneIn(3))
                    add({"bend_N = {:.6g}\n", choices_.magnitude(1e-3, 100)});
                else if (choices_.oneIn(2))
                    add({"bending_rigidity_N_m2 = {:.6g}\n", choices_.magnitude(1e-6, 1)});
                addDamping();
                addGivingWay();
                break;
            case 2:
                bodies_.push_back({Text{"block.b{}", number}, {"left", "top", "corners", "back", "all"}});
                add({"[{}]\nsize = [{:.6g}, {:.6g}, {:.6g}]\ncells = [{}, {}, {}]\nposition = {}\n",
                     bodies_.back().name, choices_.between(0.05, 0.3), choices_.between(0.05, 0.3),
                     choices_.between(0.05, 0.3), 1 + choices_.below(3), 1 + choices_.below(2), 1 + choices_.below(2),
                     choices_.vector(0.15)});
                if (choices_.oneIn(2)) add({"rotation_deg = {}\n", choices_.vector(180)});
                if (choices_.oneIn(2)) add({"young_Pa = {:.6g}\n", choices_.magnitude(10, 1e7)});
                if (choices_.oneIn(2)) add({"density_kg_per_m3 = {:.6g}\n", choices_.magnitude(1, 1e4)});
                addDamping();
                addGivingWay();
                break;
            case 3:
                bodies_.push_back({Text{"solid.b{}", number}, {"all", "#0"}});
                add({"[{}]\n{}\nposition = {}\n", bodies_.back().name, shape("\n"), choices_.vector(0.15)});
                if (choices_.oneIn(2)) add({"rotation_deg = {}\n", choices_.vector(180)});
                break;
            default:
                bodies_.push_back({Text{"net.b{}", number}, {"p0", "p1", "p2", "all"}});
                add(
                    {"[{}]\npoints = [{{ name = \"p0\", position = {} }}, {{ name = \"p1\", position = {} }}, "
                     "{{ name = \"p2\", position = {}, mass_kg = {:.6g} }}]\n"
                     "springs = [{{ a = \"p0\", b = \"p1\", stiffness_N_per_m = {:.6g} }}, {{ a = \"p1\", b = \"p2\" "
                     "}}]\n",
                     bodies_.back().name, choices_.vector(0.2), choices_.vector(0.2), choices_.vector(0.2),
                     choices_.magnitude(1e-3, 100), choices_.magnitude(1e-2, 1e5)});
                addDamping();
                addGivingWay();
        }
        add({"touch = \"{}\"\n", choices_.of({"others", "all", "nothing"})});
        if (!bodies_.back().name.starts_with("solid") && choices_.oneIn(2))
            add({"thickness = {:.6g}\n", choices_.magnitude(1e-4, 3e-2)});
        if (choices_.oneIn(3)) add({"collide = {}\n", choices_.of({"\"faces\"", "false"})});
        if (choices_.oneIn(3)) add({"velocity = {}\n", choices_.vector(10)});
        if (choices_.oneIn(4)) add({"spin_rad_per_s = {}\n", choices_.vector(30)});
        if (choices_.oneIn(4)) add({"friction = {:.6g}\n", choices_.magnitude(1e-2, 10)});
        if (choices_.oneIn(4)) add({"jitter_m = {:.6g}\n", choices_.magnitude(1e-6, 1e-2)});
        if (choices_.oneIn(3)) {
            bodies_.back().isHeld = true;
            add({"hold = [\"{}\"]\n", choices_.of(bodies_.back().selectors)});
            if (colliders > 0 && choices_.oneIn(2)) add({"hold_on = \"collider.c0\"\n"});
        }
        if (!isJoined_ && choices_.oneIn(6))
            add({"solver = {{ integrator = \"{}\" }}\n", choices_.of({"implicit-euler", "rk4", "leapfrog"})});
    }

    std::string points() {
        const Own& own = bodies_[choices_.below(static_cast<int>(bodies_.size()))];
        return own.name + "@" + choices_.of(own.selectors);
    }

    static bool isSolid(const Own& own) { return own.name.starts_with("solid"); }

    // A joint at a place of a solid.
    void addMounted(const std::string& solid, const std::string& other, bool isRigid) {
        const std::string kind = isRigid ? choices_.of({"hinge", "ball", "slider"}) : "ball";
        add({"[[joint]]\na = \"{}\"\nb = \"{}\"\nkind = \"{}\"\nplace = {}\naxis = {}\n", solid, other, kind,
             choices_.vector(0.2), choices_.vector(1)});
        if (choices_.oneIn(3)) add({"touch = true\n"});
        if (kind == "ball") {
            if (isRigid && choices_.oneIn(2)) add({"cone_deg = {:.6g}\n", choices_.between(1, 170)});
            return;
        }
        const bool slides = kind == "slider";
        const auto keyOf = [&](const char* ofHinge, const char* ofSlider) { return slides ? ofSlider : ofHinge; };
        const double most = slides ? 1.0 : 170.0;
        if (choices_.oneIn(2))
            add({"{} = [{:.6g}, {:.6g}]\n", keyOf("limits_deg", "limits_m"), choices_.between(-most, 0),
                 choices_.between(most / 170.0, most)});
        if (choices_.oneIn(3))
            add({"{} = {:.6g}\n", keyOf("friction_N_m", "friction_N"), choices_.magnitude(1e-3, 100)});
        if (choices_.oneIn(3))
            add({"{} = {:.6g}\n", keyOf("damping_N_m_s", "damping_N_s_per_m"), choices_.magnitude(1e-3, 100)});
        if (choices_.oneIn(3)) {
            isClosed_ = false;
            add({"{} = {:.6g}\n{} = {:.6g}\n", keyOf("motor_rad_per_s", "motor_m_per_s"), choices_.between(-20, 20),
                 keyOf("motor_N_m", "motor_N"), choices_.magnitude(1e-3, 100)});
        }
    }

    void addJoint(const Own& a, const Own& b) {
        if (isSolid(a) && choices_.oneIn(2)) {
            addMounted(a.name, isSolid(b) ? b.name : b.name + "@#0", isSolid(b));
            return;
        }
        const auto isCloth = [](const Own& own) { return own.name.starts_with("cloth"); };
        if (isCloth(a) && isCloth(b) && choices_.oneIn(2)) {
            add({"[[seam]]\na = \"{}@right\"\nb = \"{}@left\"\nover_s = {:.6g}\n", a.name, b.name,
                 choices_.magnitude(0.01, 0.3)});
            return;
        }
        const std::string kind = choices_.of({"spring", "weld", "rod"});
        const auto endOf = [&](const Own& own) {
            return own.name + "@" + (isSolid(own) && choices_.oneIn(2) ? "centre" : choices_.of(own.selectors));
        };
        const std::string end = endOf(a);
        add({"[[joint]]\na = \"{}\"\nb = \"{}\"\nkind = \"{}\"\n", end, endOf(b), kind});
        if (kind == "spring") add({"stiffness_N_per_m = {:.6g}\n", choices_.magnitude(1, 1e5)});
        if (kind == "weld") add({"reach_m = 2\n"});
    }

    void addTies(int colliders) {
        if (isJoined_) addJoint(bodies_[0], bodies_[1]);
        if (colliders > 0 && isSolid(bodies_[0]) && choices_.oneIn(3))
            addMounted(bodies_[0].name, "collider.c0", true);
        else if (colliders > 0 && !bodies_[0].isHeld && choices_.oneIn(5))
            add({"[[joint]]\na = \"{}@{}\"\nb = \"collider.c0\"\nkind = \"{}\"\n", bodies_[0].name,
                 choices_.of(bodies_[0].selectors), choices_.of({"weld", "spring"})});
        if (choices_.oneIn(6)) {
            isClosed_ = false;
            add({"[wind.w]\nvelocity = {}\ngust.amplitude = {:.6g}\n", choices_.vector(20),
                 choices_.magnitude(0.1, 20)});
        }
        if (choices_.oneIn(6))
            add({"[anchor.a]\ntarget = \"{}\"\nat = {}\nstiffness_N_per_m = {:.6g}\n", points(), choices_.vector(0.5),
                 choices_.magnitude(0.1, 1e4)});
    }

    // Of a block, whose surface is closed.
    void addFilling() {
        const auto block =
            std::find_if(bodies_.begin(), bodies_.end(), [](const Own& own) { return own.name.starts_with("block"); });
        if (block == bodies_.end() || !choices_.oneIn(2)) return;
        isClosed_ = false;
        add({"[filling.f]\nin = [\"{}\"]\npressure_Pa = {:.6g}\n", block->name, choices_.magnitude(1, 1e5)});
        const std::string keeps = choices_.of({"pressure", "amount", "volume"});
        add({"keeps = \"{}\"\n", keeps});
        if (keeps == "volume") add({"bulk_modulus_Pa = {:.6g}\n", choices_.magnitude(10, 1e6)});
    }

    // Some half a metre high, with a skin over two joints, or a shape that changes.
    void addFigure(int colliders) {
        if (!choices_.oneIn(4)) return;
        isClosed_ = false;
        add({"[collider.f]\nshape = \"figure\"\nmesh = \"arm.gltf\"\nscale = {:.6g}\nposition = {}\n",
             choices_.between(0.1, 0.3), choices_.vector(0.15)});
        if (choices_.oneIn(2)) add({"rotation_deg = {}\n", choices_.vector(180)});
        add({"animation = \"{}\"\nstart_s = {:.6g}\nspeed = {:.6g}\n", choices_.of({"bend", "grow"}),
             choices_.between(-0.05, 1), choices_.magnitude(0.1, 30)});
        if (choices_.oneIn(2)) add({"loop = false\n"});
        if (choices_.oneIn(2)) add({"friction = {:.6g}\n", choices_.magnitude(1e-3, 10)});
        if (colliders == 0 && !bodies_[0].isHeld && choices_.oneIn(3))
            add({"[[joint]]\na = \"{}@{}\"\nb = \"collider.f.upper\"\nkind = \"weld\"\n", bodies_[0].name,
                 choices_.of(bodies_[0].selectors)});
    }

    // Of each field one: two at a time are refused.
    void addRamp(int tick, double over, const std::string& key, const std::string& to) {
        if (std::find(ramped_.begin(), ramped_.end(), key) != ramped_.end()) return;
        ramped_.push_back(key);
        happens(tick, {"do = \"ramp\"\nkey = \"{}\"\nto = {}\nover_s = {:.6g}\n", key, to, over});
    }

    void addAction() {
        const int tick = choices_.below(6);
        const double over = choices_.oneIn(2) ? choices_.magnitude(0.01, 0.3) : 0.0;
        switch (choices_.below(9)) {
            case 0:
                happens(tick, {"do = \"push\"\ntarget = \"{}\"\nimpulse_Ns = {}\n", points(), choices_.vector(0.1)});
                break;
            case 1:
                addRamp(tick, over, "material.m.stretch_N_per_m", Text{"{:.6g}", choices_.magnitude(1, 1e5)});
                break;
            case 2: addRamp(tick, over, "world.gravity", choices_.vector(50)); break;
            case 3:
                happens(tick, {"do = \"grab\"\nid = \"h{0}\"\ntarget = \"{1}\"\nrigid = {2}\n", hands_, points(),
                               choices_.of({"false", "true"})});
                happens(tick, {"do = \"move\"\nid = \"h{}\"\nto = {}\nrotation_deg = {}\nover_s = {:.6g}\n", hands_,
                               choices_.vector(0.3), choices_.vector(60), over});
                if (choices_.oneIn(2)) happens(tick + 3, {"do = \"release\"\nid = \"h{}\"\n", hands_});
                ++hands_;
                break;
            // Both of a point at one moment is refused.
            case 4: happens(tick & ~1, {"do = \"hold\"\ntarget = \"{}\"\n", points()}); break;
            case 5: happens(tick | 1, {"do = \"free\"\ntarget = \"{}\"\n", points()}); break;
            case 6:
                happens(tick, {"do = \"cut\"\ntarget = \"{}\"\nplane = [{}, {}]\n",
                               bodies_[choices_.below(static_cast<int>(bodies_.size()))].name, choices_.vector(0.1),
                               choices_.vector(1)});
                break;
            case 7:
                happens(tick, {"do = \"add-mass\"\ntarget = \"{}\"\nmass_kg = {:.6g}\n", points(),
                               choices_.magnitude(1e-3, 10)});
                break;
            default:
                if (movable_.empty()) return;
                happens(tick, {"do = \"move\"\ntarget = \"{}\"\nto = {}\nover_s = {:.6g}\n", movable_,
                               choices_.vector(0.3), over});
                movable_.clear();
        }
    }

    Choices choices_;
    std::string text_, timeline_;
    std::vector<Own> bodies_;
    bool isClosed_ = true, isJoined_ = false;
    std::vector<std::string> ramped_;
    std::string movable_;  // a collider that nothing moves yet
    int hands_ = 0;
};

}  // namespace

GrownScene grownScene(View bytes) {
    return Growing(bytes).scene();
}

}  // namespace taut::fuzz
