// The sheet of a scene of taut with Bullet's soft body. Prints the user processor time [s] of stepping.
//
//   taut_beside_bullet SCENE.json MESHES hull|mesh ROUNDS RATE | version
//
// ROUNDS: piterations, rounds of position-based dynamics a step. RATE: steps a second. Bullet has the springs of taut
// as links. A link has one number, m_kLST from 0 to 1: the part of its error that goes in a round. That is a spring of
// m_kLST m/h² for each round, with the reduced mass m of its ends and the step h. So links have m_kLST in proportion to
// the stiffness, threads have 1, and rounds and steps say how stiff all is.
// mesh: the ball as its triangles, each of which Bullet makes a body 6 cm deep. hull: as their convex hull, which is
// the same ball. Points meet it. The soft body does not touch itself.
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace {

using Json = nlohmann::json;

double userTime() {  // [s]
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<double>(used.ru_utime.tv_sec) + 1e-6 * static_cast<double>(used.ru_utime.tv_usec);
}

btScalar number(const Json& value) {
    return value.get<btScalar>();
}

btVector3 vector(const Json& value) {
    return {number(value[0]), number(value[1]), number(value[2])};
}

struct Ball {
    btTriangleMesh triangles;
    std::unique_ptr<btCollisionShape> shape;
};

void load(const Json& told, bool isMesh, Ball& ball) {
    auto hull = std::make_unique<btConvexHullShape>();
    std::ifstream file(told["mesh"].get<std::string>());
    btAlignedObjectArray<btVector3> corners;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            btScalar x = 0, y = 0, z = 0;
            words >> x >> y >> z;
            corners.push_back(number(told["scale"]) * btVector3(x, y, z));
            hull->addPoint(corners[corners.size() - 1], false);
        } else if (kind == "f") {
            int p[3];
            for (int& corner : p) {
                std::string word;
                words >> word;
                corner = std::atoi(word.c_str()) - 1;
            }
            ball.triangles.addTriangle(corners[p[0]], corners[p[1]], corners[p[2]]);
        }
    }
    hull->recalcLocalAabb();
    if (isMesh)
        ball.shape = std::make_unique<btBvhTriangleMeshShape>(&ball.triangles, true);
    else
        ball.shape = std::move(hull);
    ball.shape->setMargin(0);  // the sheet has its thickness
}

struct Sheet {
    int cells, across;
    std::unique_ptr<btSoftBody> body;
};

// Points row by row. At the rim a thread is half as stiff.
Sheet build(const Json& told, btSoftBodyWorldInfo& info) {
    const Json &sheet = told["cloth"]["sheet"], &material = told["material"][sheet["material"].get<std::string>()];
    const int cells = sheet["cells"][0].get<int>(), across = cells + 1;
    const btScalar side = number(sheet["size"][0]), area = side * side, points = static_cast<btScalar>(across * across);
    auto body = std::make_unique<btSoftBody>(&info);
    const auto links = [&](btScalar stiffness) {
        btSoftBody::Material* made = body->appendMaterial();
        made->m_kLST = stiffness / number(material["stretch_N_per_m"]);
        return made;
    };
    const btScalar stretch = number(material["stretch_N_per_m"]);
    btSoftBody::Material *thread = links(stretch), *rim = links(stretch / 2),
                         *shear = links(number(material["shear_N_per_m"])),
                         *bend = links(number(material["bend_N_per_m"]));
    const btVector3 origin = vector(sheet["origin"]);
    const btScalar cell = side / static_cast<btScalar>(cells),
                   mass = number(material["density_kg_per_m2"]) * area / points;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i)
            body->appendNode(origin + cell * btVector3(static_cast<btScalar>(i), 0, static_cast<btScalar>(j)), mass);
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const int p = j * across + i;
            if (i < cells) body->appendLink(p, p + 1, j == 0 || j == cells ? rim : thread);
            if (j < cells) body->appendLink(p, p + across, i == 0 || i == cells ? rim : thread);
            if (i + 2 <= cells) body->appendLink(p, p + 2, bend);
            if (j + 2 <= cells) body->appendLink(p, p + 2 * across, bend);
            if (i == cells || j == cells) continue;
            body->appendLink(p, p + across + 1, shear);
            body->appendLink(p + 1, p + across, shear);
            body->appendFace(p, p + across, p + across + 1);
            body->appendFace(p, p + across + 1, p + 1);
        }
    body->getCollisionShape()->setMargin(number(sheet["thickness"]));
    body->m_cfg.collisions = btSoftBody::fCollision::SDF_RS;
    body->m_cfg.kDF = 1;  // a factor of the friction of the ball
    return {cells, across, std::move(body)};
}

void write(const Sheet& sheet, const std::string& file) {
    std::ofstream obj(file);
    obj.precision(9);
    for (int p = 0; p < sheet.body->m_nodes.size(); ++p) {
        const btVector3& x = sheet.body->m_nodes[p].m_x;
        obj << "v " << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
    }
    for (int j = 0; j < sheet.cells; ++j)
        for (int i = 0; i < sheet.cells; ++i) {
            const int p = j * sheet.across + i + 1, q = p + sheet.across;
            obj << "f " << p << ' ' << q << ' ' << q + 1 << "\nf " << p << ' ' << q + 1 << ' ' << p + 1 << '\n';
        }
}

void play(const Json& told, const std::string& folder, bool isMesh, int rounds, int rate) {
    btSoftBodyRigidBodyCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadPhase;
    btSequentialImpulseConstraintSolver solver;
    btSoftRigidDynamicsWorld world(&dispatcher, &broadPhase, &solver, &configuration);
    world.setGravity({0, btScalar(-9.81), 0});
    world.getWorldInfo().m_gravity = world.getGravity();
    Ball ball;
    load(told["collider"]["ball"], isMesh, ball);
    btRigidBody::btRigidBodyConstructionInfo standing(0, nullptr, ball.shape.get());
    standing.m_friction = number(told["collider"]["ball"]["friction"]);
    btRigidBody rigid(standing);
    rigid.setWorldTransform(btTransform(btQuaternion::getIdentity(), vector(told["collider"]["ball"]["position"])));
    world.addRigidBody(&rigid);
    const Sheet sheet = build(told, world.getWorldInfo());
    const btScalar step = 1 / static_cast<btScalar>(rate);  // [s]
    sheet.body->m_cfg.piterations = rounds;
    // Bullet's damping is the part of the velocity that goes in a step.
    const std::string material = told["cloth"]["sheet"]["material"].get<std::string>();
    sheet.body->m_cfg.kDP = step * number(told["material"][material]["drag_per_s"]);
    world.addSoftBody(sheet.body.get());
    const double fps = told["run"]["fps"].get<double>(), seconds = told["run"]["seconds"].get<double>();
    double spent = 0;
    long steps = 0;
    for (int frame = 1; frame <= std::lround(fps * seconds); ++frame) {
        const double before = userTime();
        for (; steps < std::lround(frame / fps * rate); ++steps) world.stepSimulation(step, 0);
        spent += userTime() - before;
        char name[32];
        std::snprintf(name, sizeof name, "/%04d.obj", frame);
        write(sheet, folder + name);
    }
    std::printf("%.3f\n", spent);
    world.removeSoftBody(sheet.body.get());
    world.removeRigidBody(&rigid);
}

}  // namespace

int main(int count, char** arguments) {
    const std::string first = count > 1 ? arguments[1] : "", shape = count == 6 ? arguments[3] : "";
    if (count == 2 && first == "version")
        return std::printf("Bullet %d.%02d\n", btGetVersion() / 100, btGetVersion() % 100) < 0;
    if (shape != "hull" && shape != "mesh") {
        std::fprintf(stderr, "usage: taut_beside_bullet SCENE.json MESHES hull|mesh ROUNDS RATE | version\n");
        return 2;
    }
    std::ifstream file(first);
    play(Json::parse(file), arguments[2], shape == "mesh", std::atoi(arguments[4]), std::atoi(arguments[5]));
}
