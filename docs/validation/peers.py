"""Work and precision where ideal joints are meant: this kernel, MuJoCo, Pinocchio and generated code on the same
mechanisms.

    pip install ./python mujoco==4.0.0 casadi==3.8.2 pin==4.1.0 cmeel-eigen==3.4.1
    python docs/validation/peers.py docs/results/peers.csv      # gcc and g++ compile the generated code and Pinocchio's

A tool's error [m] is the largest distance of a centre of mass from the truth at ten times of the window. The cost is the
least CPU time of a run without output, in seconds per simulated second. A cell is the cheapest of the settings tried
that stays within the accuracy, and does so at the next shorter step, too. See docs/validation/peers.md.
"""

from __future__ import annotations

import csv
import ctypes
import math
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

import casadi
import mujoco
import numpy as np
import pinocchio

import dbd

ACCURACIES = (1e-3, 1e-4, 1e-5, 1e-6)
SAMPLES = 10
STEPS = [0.05 / 2 ** (i / 2) for i in range(26)]
STIFFNESSES = (1e7, 1e8, 1e9, 1e10, 1e11, 1e12)


def chain(links: int) -> str:
    """The links of `chain-open-30`, hung 30 degrees from the vertical, any number of them."""
    head, body = dbd.SCENES["chain-open-30"].split("[[body]]", 1)
    first = tomllib.loads("[[body]]" + body.split("[[", 1)[0])["body"][0]
    along = [2.0 * x for x in first["position"]]
    texts = [head]
    for i in range(links):
        centre = [(i + 0.5) * x for x in along]
        texts.append(
            f'[[body]]\nname = "{i}"\nmass = {first["mass"]}\ninertia = {first["inertia"]}\nposition = {centre}\n'
            f'orientation = {{ quaternion = {first["orientation"]["quaternion"]} }}\n'
        )
    for i in range(links):
        between = ["world" if i == 0 else str(i - 1), str(i)]
        texts.append(
            f'[[joint]]\nname = "j{i}"\ntype = "revolute"\nbetween = {between}\nat = {[i * x for x in along]}\n'
            "axis = [0, 0, 1]\nstiffness = 1e6\nspan = 0.1\n"
        )
    return "".join(texts)


def spiders(scene: dict) -> dict:
    """Every universal joint as the body that it contains and two revolutes."""
    bodies, joints = list(scene["body"]), []
    for joint in scene["joint"]:
        if joint["type"] == "revolute":
            joints.append(joint)
            continue
        name = f"{joint['name']}.spider"
        bodies.append({"name": name, "position": joint["at"], **joint["spider"]})
        a, b = joint["between"]
        for between, axis in zip(([a, name], [name, b]), joint["axes"]):
            joints.append({"type": "revolute", "between": between, "at": joint["at"], "axis": axis})
    return {**scene, "body": bodies, "joint": joints}


def quaternion(body: dict) -> np.ndarray:
    turn = body.get("orientation", {"quaternion": [1.0, 0.0, 0.0, 0.0]})
    if "quaternion" in turn:
        q = np.array(turn["quaternion"], float)
        return q / np.linalg.norm(q)
    half = 0.5 * turn["angle"]
    axis = np.array(turn["axis"], float)
    return np.array([math.cos(half), *(math.sin(half) * axis / np.linalg.norm(axis))])


def rotation(q: np.ndarray) -> np.ndarray:
    matrix = np.empty(9)
    mujoco.mju_quat2Mat(matrix, q)
    return matrix.reshape(3, 3)


def in_plane(scene: dict) -> bool:
    axes = [np.abs(joint["axis"]) for joint in scene["joint"] if joint["type"] == "revolute"]
    return len(axes) == len(scene["joint"]) and all(np.allclose(axis, axes[0]) for axis in axes)


def mjcf(scene: dict) -> str:
    """MuJoCo's model: hinges along a tree of the revolutes, `connect` where one closes a loop.

    Revolutes about one direction move in a plane, where one point closes a loop; else two points of the axis do.
    """
    scene = spiders(scene)
    bodies = {body["name"]: body for body in scene["body"]}
    planar = in_plane(scene)
    springs = {tuple(spring["between"]): spring for spring in scene.get("torsion_spring", [])}
    parent, tree, loops = {name: name for name in ["world", *bodies]}, [], []

    def root(name: str) -> str:
        return name if parent[name] == name else root(parent[name])

    # Into the tree first what has a spring, which acts along a hinge.
    for joint in sorted(scene["joint"], key=lambda joint: tuple(joint["between"]) not in springs):
        a, b = map(root, joint["between"])
        (loops if a == b else tree).append(joint)
        parent[a] = b

    def branch(name: str, frame: tuple[np.ndarray, np.ndarray]) -> str:
        place, turn = frame
        text = ""
        for joint in [joint for joint in tree if name in joint["between"]]:
            tree.remove(joint)
            a, b = joint["between"]
            child = b if a == name else a
            body = bodies[child]
            centre, q = np.array(body["position"], float), quaternion(body)
            own = rotation(q)
            at = own.T @ (np.array(joint["at"], float) - centre)
            along = own.T @ np.array(joint["axis"], float) * (1.0 if a == name else -1.0)
            extra = ""
            if spring := springs.pop((a, b), None):
                k = spring["stiffness"]
                extra = f' stiffness="{k!r}" springref="{spring.get("preload", 0.0) / k!r}"'
            hinge = f'<joint type="hinge" pos="{words(at)}" axis="{words(along)}"{extra}/>'
            back = np.empty(4)
            mujoco.mju_negQuat(back, turn)
            relative = np.empty(4)
            mujoco.mju_mulQuat(relative, back, q)
            text += (
                f'<body name="{child}" pos="{words(rotation(turn).T @ (centre - place))}" quat="{words(relative)}">'
                f'{hinge}<inertial pos="0 0 0" mass="{body["mass"]!r}" diaginertia="{words(body["inertia"])}"/>'
                f"{branch(child, (centre, q))}</body>"
            )
        return text

    world = branch("world", (np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0])))
    assert not tree and not springs, "a joint or a spring of this scene has no place in the tree"
    closed = ""
    for joint in loops:
        a, b = joint["between"]
        body, other = (b, a) if a == "world" else (a, b)
        centre, own = np.array(bodies[body]["position"], float), rotation(quaternion(bodies[body]))
        beside = np.array(joint["axis"], float) * 0.05
        for at in [joint["at"]] if planar else [joint["at"] + beside, joint["at"] - beside]:
            anchor = own.T @ (np.array(at, float) - centre)
            second = "" if other == "world" else f' body2="{other}"'
            closed += f'<connect body1="{body}"{second} anchor="{words(anchor)}"/>'
    return (
        f'<mujoco><compiler angle="radian"/><option integrator="RK4" gravity="{words(scene["gravity"])}">'
        '<flag contact="disable"/></option>'
        f"<worldbody>{world}</worldbody><equality>{closed}</equality></mujoco>"
    )


def words(numbers) -> str:
    return " ".join(repr(float(number)) for number in numbers)


class MuJoCo:
    """RK4 with constraints as hard as its parameters make them: `solref` of two steps, `solimp` 0.9999."""

    name = f"MuJoCo {mujoco.__version__}"

    def __init__(self, scene: dict) -> None:
        self.text = mjcf(scene)
        self.rows = [body["name"] for body in spiders(scene)["body"]]

    def settings(self):
        return [("RK4",)]

    def run(self, _, step: float, samples: int, per_sample: int):
        model = mujoco.MjModel.from_xml_string(self.text)
        model.opt.timestep = step
        model.eq_solref[:] = [2.0 * step, 1.0]
        model.eq_solimp[:] = [0.9999, 0.9999, 0.001, 0.5, 2.0]
        rows = [model.body(name).id for name in self.rows]
        data = mujoco.MjData(model)
        places = []
        for _ in range(samples):
            mujoco.mj_step(model, data, per_sample)
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            places.append(data.xipos[rows].copy())

        def again() -> float:
            mujoco.mj_resetData(model, data)
            begin = time.process_time()
            mujoco.mj_step(model, data, samples * per_sample)
            return time.process_time() - begin

        return np.array(places), again


class Link(ctypes.Structure):
    """A body of MuJoCo's model with its hinge, as pinocchio_rk4.cpp reads it."""

    _fields_ = [
        ("parent", ctypes.c_long),
        ("place", ctypes.c_double * 3),
        ("turn", ctypes.c_double * 4),
        ("point", ctypes.c_double * 3),
        ("axis", ctypes.c_double * 3),
        ("centre", ctypes.c_double * 3),
        ("axes", ctypes.c_double * 4),
        ("mass", ctypes.c_double),
        ("inertia", ctypes.c_double * 3),
        ("stiffness", ctypes.c_double),
        ("free_angle", ctypes.c_double),
    ]


class Loop(ctypes.Structure):
    """A `connect` of MuJoCo's model."""

    _fields_ = [("bodies", ctypes.c_long * 2), ("points", ctypes.c_double * 3 * 2)]


class Pinocchio:
    """RK4 in C++: a tree by the articulated-body algorithm, loops by constrained dynamics with proximal iterations.

    Its model is the one that MuJoCo compiles.
    """

    name = f"Pinocchio {pinocchio.__version__}"
    library = None

    def __init__(self, scene: dict, folder: Path) -> None:
        self.api = Pinocchio.library = Pinocchio.library or self.compile(folder)
        model = mujoco.MjModel.from_xml_string(mjcf(scene))
        rows = range(1, model.nbody)
        assert list(model.jnt_bodyid) == list(rows), "a body of this scene has more or less than one hinge"
        links = [
            Link(
                model.body_parentid[row] - 1,
                tuple(model.body_pos[row]),
                tuple(model.body_quat[row]),
                tuple(model.jnt_pos[row - 1]),
                tuple(model.jnt_axis[row - 1]),
                tuple(model.body_ipos[row]),
                tuple(model.body_iquat[row]),
                model.body_mass[row],
                tuple(model.body_inertia[row]),
                model.jnt_stiffness[row - 1].flat[0],
                model.qpos_spring[row - 1],
            )
            for row in rows
        ]
        loops = [
            Loop((a - 1, b - 1), (tuple(points[:3]), tuple(points[3:6])))
            for a, b, points in zip(model.eq_obj1id, model.eq_obj2id, model.eq_data)
        ]
        gravity = np.array(scene["gravity"], float)
        self.bodies = len(links)
        self.plant = self.api.create(
            (Link * len(links))(*links), len(links), (Loop * len(loops))(*loops), len(loops), gravity.ctypes.data
        )
        order = [model.body(body["name"]).id - 1 for body in spiders(scene)["body"]]
        self.order = np.array(order)

    @staticmethod
    def compile(folder: Path):
        prefix = next(parent for parent in Path(pinocchio.__file__).parents if parent.name == "cmeel.prefix")
        # Those that Pinocchio's own build of the variants of joints has.
        limits = ("LIMIT_LIST_SIZE=30", "LIMIT_VECTOR_SIZE=30", "CFG_NO_PREPROCESSED_HEADERS")
        options = [f"-DBOOST_MPL_{limit}" for limit in limits] + ["-DBOOST_FUSION_INVOKE_MAX_ARITY=12"]
        options += [f"-I{prefix}/include", f"-I{prefix}/include/eigen3", f"-L{prefix}/lib", f"-Wl,-rpath,{prefix}/lib"]
        library = folder / "pinocchio_rk4.so"
        source = Path(__file__).with_name("pinocchio_rk4.cpp")
        command = ["g++", "-std=c++17", "-O3", "-w", "-DNDEBUG", "-shared", "-fPIC", source, "-o", library]
        subprocess.run([*command, *options, "-lpinocchio_default"], check=True)
        api = ctypes.CDLL(str(library))
        pointer, count = ctypes.c_void_p, ctypes.c_long
        api.create.restype = pointer
        api.create.argtypes = [pointer, count, pointer, count, pointer]
        api.reset.argtypes = [pointer]
        api.many.argtypes = [pointer, ctypes.c_double, count]
        api.places.argtypes = [pointer, pointer]
        return api

    def settings(self):
        return [("RK4",)]

    def run(self, _, step: float, samples: int, per_sample: int):
        self.api.reset(self.plant)
        places = []
        for _ in range(samples):
            self.api.many(self.plant, step, per_sample)
            found = np.empty((self.bodies, 3))
            self.api.places(self.plant, found.ctypes.data)
            places.append(found[self.order])

        def again() -> float:
            self.api.reset(self.plant)
            begin = time.process_time()
            self.api.many(self.plant, step, samples * per_sample)
            return time.process_time() - begin

        return np.array(places), again


class Kernel:
    """Joints as stiff springs: the stiffness is a setting as the step is."""

    name = f"this kernel {dbd.__version__}"

    def __init__(self, text: str, scene: dict, folder: Path) -> None:
        self.path = folder / f"{scene['name']}.toml"
        self.path.write_text(text)
        revolutes = [joint["name"] for joint in scene["joint"] if joint["type"] == "revolute"]
        self.model = [f'joint.{name}.realisation="bushing"' for name in revolutes]
        self.model += ["planar=true"] if in_plane(scene) else []

    def settings(self):
        schemes = ("generalized-alpha-3", "generalized-alpha")
        return [(scheme, stiffness) for scheme in schemes for stiffness in STIFFNESSES]

    def run(self, setting, step: float, samples: int, per_sample: int):
        scheme, stiffness = setting
        changes = [*self.model, f"joint.*.stiffness={stiffness!r}"]
        plant = dbd.Plant(self.path, scheme=scheme, step=step, changes=changes)
        places = []
        for _ in range(samples):
            plant.advance(per_sample)
            places.append(plant.state.position)

        def again() -> float:
            plant.reset()
            begin = time.process_time()
            plant.advance(samples * per_sample)
            return time.process_time() - begin

        return np.array(places), again


class Generated:
    """RK4 in reduced coordinates, in C that CasADi writes: a planar loop whose last two links close it."""

    name = f"CasADi {casadi.__version__}"

    def __init__(self, scene: dict, folder: Path) -> None:
        bodies, joints = scene["body"], scene["joint"]
        pins = [np.array(joint["at"][:2], float) for joint in self.order(bodies, joints)]
        links = [pins[i + 1] - pins[i] for i in range(len(bodies))]
        angles = [math.atan2(link[1], link[0]) for link in links]
        lengths = [float(np.linalg.norm(link)) for link in links]
        free = len(bodies) - 2
        q, v = casadi.SX.sym("q", free), casadi.SX.sym("v", free)
        joint = casadi.DM(pins[0])
        turned, starts = [], []
        for i in range(free):
            starts.append(joint)
            turned.append((casadi.cos(q[i]), casadi.sin(q[i])))
            joint = joint + lengths[i] * casadi.vertcat(*turned[-1])
        # The last two links meet where two circles do, on the side where they met at the start.
        ends = casadi.DM(pins[-1])
        d = ends - joint
        square = casadi.dot(d, d)
        a, b = lengths[free], lengths[free + 1]
        along = (square + a * a - b * b) / (2.0 * square)
        across = casadi.sqrt(a * a / square - along * along)
        base = pins[-1] - pins[free]
        side = math.copysign(1.0, base[0] * links[free][1] - base[1] * links[free][0])
        meet = joint + along * d + side * across * casadi.vertcat(-d[1], d[0])
        for begin, end, length in ((joint, meet, a), (meet, ends, b)):
            starts.append(begin)
            way = (end - begin) / length
            turned.append((way[0], way[1]))
        names = [body["name"] for body in bodies]
        potential, places, lines, weights = 0, [], [], []
        for i, body in enumerate(bodies):
            off = np.array(body["position"][:2], float) - pins[i]
            c, s = math.cos(angles[i]), math.sin(angles[i])
            off = casadi.DM([c * off[0] + s * off[1], -s * off[0] + c * off[1]])
            cosine, sine = turned[i]
            place = starts[i] + casadi.vertcat(cosine * off[0] - sine * off[1], sine * off[0] + cosine * off[1])
            # The rate of an angle by its sine and cosine.
            lines += [casadi.jacobian(place, q), cosine * casadi.jacobian(sine, q) - sine * casadi.jacobian(cosine, q)]
            across_plane = rotation(quaternion(body))[2] ** 2 @ np.array(body["inertia"], float)
            weights += [body["mass"], body["mass"], across_plane]
            potential -= body["mass"] * casadi.dot(casadi.DM(scene["gravity"][:2]), place)
            places.append(place)
        for spring in scene.get("torsion_spring", []):
            # The angle between two links since the start, by the product of their directions.
            direction, began = (1.0, 0.0), 0.0
            for sign, name in zip((-1.0, 1.0), spring["between"]):
                if name != "world":
                    (cosine, sine), row = turned[names.index(name)], names.index(name)
                    x, y = direction
                    direction = (x * cosine - sign * y * sine, y * cosine + sign * x * sine)
                    began += sign * angles[row]
            x, y = direction
            c, s = math.cos(began), math.sin(began)
            angle = casadi.atan2(c * y - s * x, c * x + s * y)
            potential += 0.5 * spring["stiffness"] * angle * angle - spring.get("preload", 0.0) * angle
        moves = casadi.vertcat(*lines)
        weighted = casadi.diag(casadi.DM(weights)) @ moves
        # M·v̇ = −∂V/∂q − Jᵀ·m·(J̇·v)
        change = casadi.jtimes(moves @ v, q, v)
        force = -casadi.gradient(potential, q) - weighted.T @ change
        rate = casadi.vertcat(v, casadi.solve(moves.T @ weighted, force))
        x, h = casadi.vertcat(q, v), casadi.SX.sym("h")
        rate = casadi.Function("rate", [x], [casadi.cse(rate)])
        k1 = rate(x)
        k2 = rate(x + 0.5 * h * k1)
        k3 = rate(x + 0.5 * h * k2)
        k4 = rate(x + h * k3)
        step = casadi.Function("rk4", [x, h], [casadi.cse(x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4))])
        self.places = casadi.Function("places", [x], [casadi.horzcat(*places)])
        self.start = np.array(angles[:free] + [0.0] * free)
        self.library = self.compile(step, folder / scene["name"], 2 * free)

    @staticmethod
    def order(bodies: list[dict], joints: list[dict]) -> list[dict]:
        """The joints along the loop: before the first body, after it, and so on."""
        left, at, found = list(joints), "world", []
        for body in bodies:
            joint = next(joint for joint in left if {at, body["name"]} == set(joint["between"]))
            left.remove(joint)
            found.append(joint)
            at = body["name"]
        return found + left

    @staticmethod
    def compile(step: casadi.Function, path: Path, size: int):
        # casadi.Function.generate writes into the present folder alone.
        generator = casadi.CodeGenerator(f"{path.name.replace('-', '_')}.c")
        generator.add(step)
        source = Path(generator.generate(f"{path.parent}/"))
        with source.open("a") as file:
            file.write(
                "\nvoid many(double *x, double h, long n) {\n"
                f"  double y[{size}]; casadi_int iw[1]; double w[65536];\n"
                "  for (long i = 0; i < n; i++) {\n"
                "    const double *in[2] = {x, &h}; double *out[1] = {y};\n"
                "    rk4(in, out, iw, w, 0);\n"
                f"    for (int k = 0; k < {size}; k++) x[k] = y[k];\n  }}\n}}\n"
            )
        library = source.with_suffix(".so")
        subprocess.run(["gcc", "-O3", "-shared", "-fPIC", source, "-o", library, "-lm"], check=True)
        many = ctypes.CDLL(str(library)).many
        many.argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_long]
        return many

    def settings(self):
        return [("RK4",)]

    def run(self, _, step: float, samples: int, per_sample: int):
        state = self.start.copy()
        places = []
        for _ in range(samples):
            self.library(state.ctypes.data, step, per_sample)
            flat = np.array(self.places(state)).T
            places.append(np.hstack([flat, np.zeros((len(flat), 1))]))

        def again() -> float:
            state[:] = self.start
            begin = time.process_time()
            self.library(state.ctypes.data, step, samples * per_sample)
            return time.process_time() - begin

        return np.array(places), again


def off(places: np.ndarray, truth: np.ndarray) -> float:
    """[m] the largest distance of a centre of mass, infinite where a run broke down."""
    apart = np.linalg.norm(places - truth, axis=2)
    return float(apart.max()) if np.isfinite(apart).all() else math.inf


def least(again, window: float) -> float:
    """The least CPU seconds per simulated second of runs that take some hundredths of a second together."""
    took = [again() for _ in range(3)]
    while sum(took) < 0.06 and len(took) < 400:
        took.append(again())
    return min(took) / window


def try_all(tool, window: float, truth: np.ndarray) -> list[tuple]:
    """Every setting, from long steps to the second that holds the finest accuracy: (setting, step, error, cost)."""
    rows = []
    for setting in tool.settings():
        for step in STEPS:
            per_sample = max(1, round(window / SAMPLES / step))
            used = window / SAMPLES / per_sample
            if rows and rows[-1][0] == setting and rows[-1][1] == used:
                continue
            try:
                places, again = tool.run(setting, used, SAMPLES, per_sample)
                error = off(places, truth)
            except (dbd.Error, mujoco.FatalError) as problem:
                print(f"    {setting} {used:g}: {problem}", file=sys.stderr)
                error, again = math.inf, None
            cost = least(again, window) if error < 10.0 * ACCURACIES[0] else math.inf
            rows.append((setting, used, error, cost))
            held = [row for row in rows[-2:] if row[0] == setting and row[2] <= ACCURACIES[-1]]
            if len(held) == 2:
                break
    return rows


def cheapest(rows: list[tuple], accuracy: float):
    """The cheapest that is within the accuracy and is so at the next shorter step, too."""
    held = [
        row
        for row, finer in zip(rows, rows[1:])
        if row[0] == finer[0] and row[2] <= accuracy and finer[2] <= accuracy
    ]
    return min(held, key=lambda row: row[3], default=None)


def main(path: str) -> None:
    mechanisms = [
        ("four-bar", dbd.SCENES["four-bar"], 0.1),
        ("six-bar", dbd.SCENES["six-bar"], 0.1),
        ("3ruu", dbd.SCENES["3ruu"], 0.1),
        ("chain of 10", chain(10), 0.5),
        ("chain of 100", chain(100), 0.5),
    ]
    rows = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for name, text, window in mechanisms:
            scene = tomllib.loads(text)
            tools = [Kernel(text, scene, folder), Pinocchio(scene, folder), MuJoCo(scene)]
            if name in ("four-bar", "six-bar"):
                tools.append(Generated(scene, folder))
            # The truth is a tool's with exact joints, at a step beyond all of those compared.
            sure = tools[-1]
            step = 1e-5
            per_sample = round(window / SAMPLES / step)
            truth, _ = sure.run(("RK4",), window / SAMPLES / per_sample, SAMPLES, per_sample)
            half, _ = sure.run(("RK4",), window / SAMPLES / (per_sample // 2), SAMPLES, per_sample // 2)
            print(f"{name}: truth by {sure.name}, {off(half, truth):.1e} m from twice its step", file=sys.stderr)
            for tool in tools:
                tried = try_all(tool, window, truth)
                print(f"  {tool.name}: at best {min(row[2] for row in tried):.1e} m", file=sys.stderr)
                for accuracy in ACCURACIES:
                    found = cheapest(tried, accuracy)
                    row = [name, window, tool.name, f"{accuracy:.0e}"]
                    if found is None:
                        rows.append([*row, "", "", "", ""])
                        continue
                    setting, step, error, cost = found
                    method = " ".join(part if isinstance(part, str) else f"{part:.0e} N/m" for part in setting)
                    rows.append([*row, f"{cost:.3e}", method, f"{step:.3g}", f"{error:.1e}"])
                    print(f"    {accuracy:.0e} m: {cost:.2e} s/s, {method}, {step:.3g} s", file=sys.stderr)
    with open(path, "w", newline="") as file:
        file.write(
            "# CPU seconds per simulated second to an accuracy where ideal joints are meant, written by\n"
            "# docs/validation/peers.py; docs/validation/peers.md is rendered from here.\n"
        )
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow("mechanism,window_s,tool,accuracy_m,cpu_s_per_s,method,step_s,error_m".split(","))
        writer.writerows(rows)


if __name__ == "__main__":
    main(sys.argv[1])
