"""MuJoCo as judge of imported scenes: where it has the centres of mass of an MJCF file's bodies.

    python3 -m venv target/judge && target/judge/bin/pip install mujoco
    target/judge/bin/python tests/command_line/import/judge.py record FILE.xml [KEYFRAME] > FILE.csv
    target/judge/bin/python tests/command_line/import/judge.py distance FILE.xml out/SCENE/trace.csv [KEYFRAME]

`record` writes a table of 0.5 s: time, then x, y, z of each group of bodies that are rigid with each other, by
the name of its first. `distance` prints how far a trace of host-sim is from MuJoCo's, body by body. What a scene
has no counterpart for is off: contact but of spheres, capsules and boxes with planes and of spheres with spheres, equalities of tendons, tendons that are not
between two sites or of two or three joints, actuators that are no linear law or act at neither a joint nor a tendon. Controls are the keyframe's.
"""

import csv
import sys

import mujoco
import numpy as np

DURATION, SAMPLES = 0.5, 50


def load(file, step):
    spec = mujoco.MjSpec.from_file(file)
    for one in list(spec.sensors):
        spec.delete(one)
    for one in list(spec.equalities):
        if one.type not in (mujoco.mjtEq.mjEQ_CONNECT, mujoco.mjtEq.mjEQ_WELD, mujoco.mjtEq.mjEQ_JOINT):
            spec.delete(one)
    model = spec.compile()
    off = mujoco.mjtDisableBit
    if not touches_known_alone(model):
        model.opt.disableflags |= off.mjDSBL_CONTACT
    # Contacts, limits and loops as stiff as the step bears: an error halves in a few steps, and the force is the
    # constraint's.
    stiff, whole = (4 * step, 1), (0.9999, 0.9999, 0.001, 0.5, 2)
    model.geom_solref[:], model.geom_solimp[:] = stiff, whole
    model.pair_solref[:], model.pair_solimp[:] = stiff, whole
    model.jnt_solref[:], model.jnt_solimp[:] = stiff, whole
    model.dof_solref[:], model.dof_solimp[:] = stiff, whole
    model.eq_solref[:], model.eq_solimp[:] = stiff, whole
    model.tendon_solref_lim[:], model.tendon_solimp_lim[:] = stiff, whole
    model.opt.impratio = 100
    model.opt.disableflags |= off.mjDSBL_REFSAFE
    site, joint = mujoco.mjtWrap.mjWRAP_SITE, mujoco.mjtWrap.mjWRAP_JOINT
    for tendon in range(model.ntendon):
        first = model.tendon_adr[tendon]
        kinds = model.wrap_type[first : first + model.tendon_num[tendon]]
        if all(kinds == joint) and len(kinds) in (2, 3):
            continue
        if len(kinds) != 2 or any(kinds != site):
            model.tendon_stiffness[tendon] = model.tendon_damping[tendon] = 0
    linear = (model.actuator_dyntype == 0) & (model.actuator_gaintype == 0) & (model.actuator_biastype <= 1)
    linear &= (model.actuator_trntype <= 1) | (model.actuator_trntype == int(mujoco.mjtTrn.mjTRN_TENDON))
    model.actuator_gainprm[~linear] = model.actuator_biasprm[~linear] = 0
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    model.opt.timestep = step
    model.opt.iterations, model.opt.tolerance = 200, 0
    return model


def touches_known_alone(model):
    kinds, plane = model.geom_type, int(mujoco.mjtGeom.mjGEOM_PLANE)
    sphere = int(mujoco.mjtGeom.mjGEOM_SPHERE)
    solids = [int(getattr(mujoco.mjtGeom, f"mjGEOM_{name}")) for name in ("SPHERE", "CAPSULE", "BOX")]
    meets = model.geom_contype[:, None] & model.geom_conaffinity[None, :]
    pairs = [(kinds[i], kinds[j]) for i, j in np.argwhere(meets)]
    pairs += [(kinds[i], kinds[j]) for i, j in zip(model.pair_geom1, model.pair_geom2)]
    known = [
        tuple(pair) == (sphere, sphere) or plane in pair and any(one in solids for one in pair) for pair in pairs
    ]
    return bool(pairs) and all(known)


def groups(model):
    leads = [b for b in range(1, model.nbody) if model.body_weldid[b] == b]
    return {lead: [b for b in range(model.nbody) if model.body_weldid[b] == lead] for lead in leads}


def centres(model, data):
    found = []
    for bodies in groups(model).values():
        mass = model.body_mass[bodies]
        found.append(mass @ data.xipos[bodies] / mass.sum())
    return np.array(found)


def trajectory(file, step, keyframe=None):
    model = load(file, step)
    data = mujoco.MjData(model)
    if keyframe:
        data.qpos[:], data.ctrl[:] = model.key(keyframe).qpos, model.key(keyframe).ctrl
    mujoco.mj_forward(model, data)
    names = [model.body(lead).name for lead in groups(model)]
    places, times, worst = [centres(model, data)], [0.0], 0.0
    steps = round(DURATION / SAMPLES / step)
    for sample in range(SAMPLES):
        for _ in range(steps):
            mujoco.mj_step(model, data)
        mujoco.mj_forward(model, data)
        worst = max([worst, *abs(data.efc_pos[: data.nefc])])
        places.append(centres(model, data))
        times.append((sample + 1) * DURATION / SAMPLES)
    return names, np.array(times), np.array(places), worst


def record(file, keyframe=None):
    names, times, places, worst = trajectory(file, 1e-5, keyframe)
    _, _, coarse, _ = trajectory(file, 2e-5, keyframe)
    print(f"# MuJoCo {mujoco.__version__}, RK4, step 1e-5 s; loops open by {worst:.1e} m at most;")
    print(f"# at twice the step it is {np.abs(places - coarse).max():.1e} m off. Written by tests/command_line/import/judge.py")
    print(",".join(["time"] + [f"{name}.{axis}" for name in names for axis in "xyz"]))
    for time, row in zip(times, places):
        print(",".join([f"{time:.2f}"] + [f"{value:.9f}" for value in row.ravel()]))


def distance(file, trace, keyframe=None):
    names, times, places, worst = trajectory(file, 1e-5, keyframe)
    with open(trace) as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    at = {round(float(row["time"]), 6): row for row in rows}
    shared = [i for i, time in enumerate(times) if round(time, 6) in at]
    print(f"{len(shared)} times in common; MuJoCo's loops are open by {worst:.1e} m at most")
    largest = {}
    for number, name in enumerate(names):
        gaps = []
        for i in shared:
            row = at[round(times[i], 6)]
            scene = [float(row[f"{name}.{axis}"]) for axis in "xyz"]
            gaps.append(np.linalg.norm(scene - places[i, number]))
        largest[name] = max(gaps)
    for name, gap in sorted(largest.items(), key=lambda pair: -pair[1]):
        print(f"{name:30} {gap * 1e3:.4f} mm")


if __name__ == "__main__":
    {"record": record, "distance": distance}[sys.argv[1]](*sys.argv[2:])
