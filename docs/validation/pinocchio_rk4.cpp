// Mechanisms of hinges in Pinocchio, stepped by RK4: a tree by the articulated-body algorithm, closed loops by
// constrained dynamics with proximal iterations. docs/validation/peers.py compiles it.

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/constrained-dynamics.hpp>
#include <pinocchio/algorithm/kinematics.hpp>

#include <vector>

using Eigen::Map, Eigen::Matrix3d, Eigen::Quaterniond, Eigen::Vector3d, Eigen::VectorXd;
using pinocchio::SE3;

// A body in the form of MuJoCo, quaternions scalar first: its parent (-1: the world), its pose in the parent's axes, a
// hinge's point and axis, its centre of mass with the principal axes, mass [kg], principal inertia [kg·m²], and a
// torsion spring [N·m/rad] with the angle [rad] at which it is free.
struct Link {
  long parent;
  double place[3], turn[4], point[3], axis[3], centre[3], axes[4], mass, inertia[3], stiffness, free_angle;
};

// Two bodies of one point [m], in the axes of each.
struct Loop {
  long bodies[2];
  double points[2][3];
};

struct Plant {
  pinocchio::Model model;
  pinocchio::Data data;
  std::vector<pinocchio::RigidConstraintModel> loops;
  std::vector<pinocchio::RigidConstraintData> loop_data;
  pinocchio::ProximalSettings settings{1e-12, 1e-10, 20};
  VectorXd stiffness, free_angle, q, v;
};

static Quaterniond quaternion(const double *q) { return Quaterniond(q[0], q[1], q[2], q[3]); }
static Vector3d vector(const double *v) { return Vector3d(v[0], v[1], v[2]); }

extern "C" Plant *create(const Link *links, long count, const Loop *loops, long loop_count, const double *gravity) {
  auto *plant = new Plant;
  auto &model = plant->model;
  model.gravity.linear() = vector(gravity);
  plant->stiffness = plant->free_angle = VectorXd(count);
  std::vector<Vector3d> points;
  for (long i = 0; i < count; i++) {
    const Link &link = links[i];
    const Matrix3d turn = quaternion(link.turn).toRotationMatrix();
    const Vector3d point = vector(link.point);
    const Vector3d before = link.parent < 0 ? Vector3d::Zero().eval() : points[link.parent];
    points.push_back(point);
    const auto joint = model.addJoint(
        link.parent + 1, pinocchio::JointModelRevoluteUnaligned(vector(link.axis)),
        SE3(turn, vector(link.place) + turn * point - before), "joint" + std::to_string(i));
    const Matrix3d axes = quaternion(link.axes).toRotationMatrix();
    const Matrix3d inertia = axes * vector(link.inertia).asDiagonal() * axes.transpose();
    model.appendBodyToJoint(joint, pinocchio::Inertia(link.mass, vector(link.centre) - point, inertia), SE3::Identity());
    plant->stiffness[i] = link.stiffness;
    plant->free_angle[i] = link.free_angle;
  }
  plant->data = pinocchio::Data(model);
  for (long i = 0; i < loop_count; i++) {
    const Loop &loop = loops[i];
    SE3 at[2];
    for (int end = 0; end < 2; end++) {
      const long body = loop.bodies[end];
      at[end] = SE3(Matrix3d::Identity(), vector(loop.points[end]) - (body < 0 ? Vector3d::Zero().eval() : points[body]));
    }
    plant->loops.emplace_back(pinocchio::CONTACT_3D, model, loop.bodies[0] + 1, at[0], loop.bodies[1] + 1, at[1],
                              pinocchio::LOCAL);
  }
  for (const auto &loop : plant->loops) plant->loop_data.emplace_back(loop);
  if (loop_count > 0) pinocchio::initConstraintDynamics(model, plant->data, plant->loops, plant->loop_data);
  plant->q = plant->v = VectorXd::Zero(count);
  return plant;
}

extern "C" void reset(Plant *plant) {
  plant->q.setZero();
  plant->v.setZero();
}

static VectorXd acceleration(Plant &plant, const VectorXd &q, const VectorXd &v) {
  const VectorXd torques = plant.stiffness.cwiseProduct(plant.free_angle - q);
  if (plant.loops.empty()) return pinocchio::aba(plant.model, plant.data, q, v, torques);
  return pinocchio::constraintDynamics(plant.model, plant.data, q, v, torques, plant.loops, plant.loop_data,
                                       plant.settings);
}

extern "C" void many(Plant *plant, double h, long steps) {
  for (auto &loop : plant->loops) {
    loop.baumgarte_corrector_parameters().Kp = 1.0 / (h * h);
    loop.baumgarte_corrector_parameters().Kd = 2.0 / h;
  }
  VectorXd &q = plant->q, &v = plant->v;
  for (long i = 0; i < steps; i++) {
    const VectorXd a1 = acceleration(*plant, q, v);
    const VectorXd v2 = v + 0.5 * h * a1, q2 = q + 0.5 * h * v;
    const VectorXd a2 = acceleration(*plant, q2, v2);
    const VectorXd v3 = v + 0.5 * h * a2, q3 = q + 0.5 * h * v2;
    const VectorXd a3 = acceleration(*plant, q3, v3);
    const VectorXd v4 = v + h * a3, q4 = q + h * v3;
    const VectorXd a4 = acceleration(*plant, q4, v4);
    q += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
    v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
}

// The centres of mass [m], three numbers per body.
extern "C" void places(Plant *plant, double *out) {
  pinocchio::forwardKinematics(plant->model, plant->data, plant->q);
  for (long i = 0; i < plant->model.nv; i++) {
    Map<Vector3d>(out + 3 * i) = plant->data.oMi[i + 1].act(plant->model.inertias[i + 1].lever());
  }
}
