#!/usr/bin/env python3
"""The second route to the test vectors in reference/vectors/.

What   Two tables, written beside this file, with 20 significant digits:
         vector_limits.csv        rest, slip onset and peak of every stack in limits.json
         vector_trajectories.csv  every row of the trajectories
       Inputs are read from the files in reference/vectors/, nothing else of them is.
How    limits        the path of equilibria of generate.py, dG/dT, by extrapolated midpoint
                     steps, with contact 2-3 closed or open; where the floor slides while
                     it is closed, Newton on the unreduced balances at each T. The program
                     integrates (rotation included) in psi by Runge-Kutta steps, or has a
                     quadrature in T, and searches along a reduced sliding branch.
                     Where nothing turns the spring 1-2: its two components in space, followed
                     in T by the same steps beside G, also where the floor slides. The program
                     follows its parts along and across the contact, and slides over a
                     direction of the state.
       trajectories  the step that README.md describes, written once more with vectors,
                     in numbers of 30 digits. The program computes with doubles.
Units  r = m = k_n = 1, epsilon = 1/stiffness, forces F = f/(m g).
Inputs are the doubles nearest to what is printed; mu_c of the geometry is 2 - sqrt 3.
Run    python3 vectors.py [limits] [trajectories]
       Some six minutes. Needs Python >= 3.9 and mpmath (written with 1.3.0).
"""

import json
import operator
import sys
import time

import mpmath
from mpmath import mp, mpf

from generate import (ARMS_DIGITS, HERE, Stack, bracketed_root, cosine,
                      extrapolated_step, mu_c, sine, text, write)

VECTORS = HERE.parent / "vectors"
TRAJECTORY_DIGITS = 30


# --- limits -----------------------------------------------------------------

class TurningStack(Stack):
    """A stack whose springs turn with their contacts. All of its state is G."""

    START = mpf(0)

    def overlap(self, state):
        return state

    def friction(self, T, state):
        """Force that Coulomb's limit between the cylinders holds."""
        return self.forces(T, state, self.load(T, state))[3]


class Numbers(tuple):
    """Numbers that a step moves together."""

    def __add__(self, other):
        return Numbers(map(operator.add, self, other))

    def __sub__(self, other):
        return Numbers(map(operator.sub, self, other))

    def __rmul__(self, factor):
        return Numbers(factor * number for number in self)

    def __truediv__(self, divisor):
        return Numbers(number / divisor for number in self)


class FixedStack(Stack):
    """A stack whose spring 1-2 is a vector that nothing turns. Its state is (G, q_x, q_y).

    q is the force of that spring on cylinder 1, of components in space, as the spring has
    them: they grow by dq = t dg along the present t = (cos psi, sin psi) and by nothing else,
    with kappa dg = rho dpsi - S_c dtheta. The balances are those of q itself, unreduced:
        (q t) R_c = e R_f,  G sin psi - q_x + c = e,  2 (G cos psi + q_y) = L.
    """

    START = Numbers([mpf(0)] * 3)
    sliding = None  # mu, where the floor slides

    def overlap(self, state):
        return state[0]

    def load(self, T, state):
        return 2 * (state[0] * cosine(T) + state[2])

    def forces(self, T, state, load):
        """z, R_c, R_f, b = q t, e. The torque, whose derivative alone was integrated, is checked."""
        G, q_x, q_y = state
        z = self.slope * load + self.offset
        r_c, r_f = 1 + self.pair * G, 1 + self.floor * z
        b = q_x * cosine(T) + q_y * sine(T)
        e = G * sine(T) - q_x + self.bottom_force(T, G)[0]
        if abs(b * r_c - e * r_f) > mpf(10) ** -25 * abs(e):
            raise ArithmeticError("a torque is left")
        return z, r_c, r_f, b, e

    def friction(self, T, state):
        return mp.hypot(*state[1:])

    def derivative(self, T, state):
        """d(G, q_x, q_y)/dT from two balances of differentials, each (a constant, its part in
        dG, its part in dg), per dpsi: that of torques, and that of the springs, from which
        dtheta has been taken, or e = mu z."""
        G, q_x, q_y = state
        s, c, rho, load = sine(T), cosine(T), 2 - G, self.load(T, state)
        z, b = self.slope * load + self.offset, q_x * c + q_y * s
        r_c, r_f = 1 + self.pair * G, 1 + self.floor * z
        between, between_g, between_psi = self.bottom_force(T, G)
        e = G * s - q_x + between
        d_z = self.slope * Numbers((-2 * G * s, 2 * c, 2 * s))
        d_b = Numbers((q_y * c - q_x * s, mpf(0), mpf(1)))
        d_e = Numbers((G * c + between_psi, s + between_g, -c))
        d_arm = Numbers((mpf(0), self.pair, mpf(0)))
        torque = r_c * d_b + b * d_arm - r_f * d_e - (e * self.floor) * d_z
        if self.sliding is None:
            s_c, s_f = self.kinematic_arms(G, z)
            d_x2, turned = Numbers((rho * c, -s, mpf(0))), Numbers((rho, mpf(0), mpf(0)))
            grown = Numbers((mpf(0), mpf(0), mpf(1)))
            other = self.kappa * (s_f * grown + s_c * d_e) - s_f * turned - s_c * d_x2
        else:
            other = d_e - self.sliding * d_z
        determinant = torque[1] * other[2] - torque[2] * other[1]
        overlap = (torque[2] * other[0] - torque[0] * other[2]) / determinant
        growth = (torque[0] * other[1] - torque[1] * other[0]) / determinant
        return 2 / (1 + T**2) * Numbers((overlap, growth * c, growth * s))


class Limit:
    """The limit of one stack: follow the path of equilibria until something gives way."""

    STEP, COLUMNS = mpf("0.05"), 14
    STACK = TurningStack

    def __init__(self, given):
        self.mu, self.mu_d = mpf(given["mu"]), mpf(given["mu_d"])
        pair, floor = given["pair"], given["floor"]
        self.stack = self.STACK(1 / mpf(given["stiffness"]), mpf(given["kappa"]),
                                mpf(pair["torque_arm"]), mpf(floor["torque_arm"]),
                                (mpf(pair["kinematic_arm"]), mpf(floor["kinematic_arm"])))
        self.found = {}
        self.under_wall = False
        self.first_event = None
        # x_2 = (2 - G) sin psi shrinks from the start if its slope with c = 0 is negative.
        slope = self.stack.overlap(self.stack.derivative(mu_c(), self.stack.START))
        if 4 * cosine(mu_c()) / (1 + mu_c()**2) < slope * sine(mu_c()):
            self.happens("contact-closes", None, None)
        self.follow(mu_c(), self.stack.START)

    # Crossings, each a function that is negative before it.

    def settles(self, T, state):
        return self.stack.load(T, state) - self.stack.epsilon

    def switches(self, T, state):
        outward = (2 - self.stack.overlap(state)) * sine(T) - 1
        return outward if self.stack.closed else -outward

    def floor_slips(self, T, state):
        z, _, _, _, e = self.stack.forces(T, state, self.stack.load(T, state))
        return e - self.mu * z

    def cylinders_slip(self, T, state):
        return self.stack.friction(T, state) - self.mu_d * self.stack.overlap(state)

    def wall_arrives(self, T, state):
        distance = 2 - self.stack.overlap(state)
        return self.stack.load(T, state) - self.stack.epsilon - distance * cosine(T)

    def crossings(self):
        common = {self.switches: "contact-opens" if self.stack.closed else "contact-closes",
                  self.floor_slips: "floor-slip" if self.under_wall else "own-weight",
                  self.cylinders_slip: "cylinder-slip"}
        leg = {self.wall_arrives: "wall-contact"} if self.under_wall else {self.settles: "rest"}
        return {**common, **leg}

    def advance(self, T, state, step):
        if not step:
            return state
        return extrapolated_step(self.stack.derivative, T, state, step, self.COLUMNS)

    def follow(self, T, state):
        while T < 1:
            T, state, name = self.next_crossing(T, state, self.crossings())
            if name and self.happens(name, T, state):
                return

    def next_crossing(self, T, state, crossings):
        """One step on, or where the first of the crossings is before, and its name."""
        following = self.advance(T, state, self.STEP)
        passed = [(self.crossed(crossing, T, state), name)
                  for crossing, name in crossings.items()
                  if crossing(T + self.STEP, following) > 0]
        if not passed:
            return T + self.STEP, following, None
        reached, name = min(passed)
        return T + reached, self.advance(T, state, reached), name

    def crossed(self, crossing, T, state):
        """How far beyond (T, state) it is; 0 if it has happened there, or from the start."""
        def along(step):
            return crossing(T + step, self.advance(T, state, step))

        near = mpf(10) ** -9 * self.STEP if self.stack.overlap(state) == 0 else mpf(0)
        return bracketed_root(along, near, self.STEP) if along(near) < 0 else mpf(0)

    def happens(self, name, T, state):
        """Note what happens at (T, state); whether it ends the path."""
        if name not in ("rest", "contact-opens"):
            self.first_event = self.first_event or name
        if name == "rest":
            self.settle(State.on_path(self, T, state))
            self.stack.compression()
            self.under_wall = True
        elif name in ("contact-closes", "contact-opens"):
            self.stack.closed = name == "contact-closes"
        elif name == "floor-slip":
            self.slip(State.on_path(self, T, state))
        elif name == "own-weight" and self.stack.closed:
            self.slide_to_rest(T, state)
        elif name == "cylinder-slip" and self.under_wall and not self.stack.closed:
            force = State.on_path(self, T, state).force
            self.found.update(cylinder_slip_F=force, cylinder_slip_T=T)
        return name not in ("rest", "contact-closes", "contact-opens")

    def settle(self, state):
        self.rest = state
        self.found.update(rest_x2=1 + state.outward, rest_y1=state.y1, rest_y2=1 - state.z)

    def slip(self, state):
        travel = self.rest.wall - state.wall
        self.found.update(
            slip_onset_F=state.force, slip_onset_T=state.T, slip_onset_y=state.outward,
            slip_onset_z=state.z, slip_onset_c=state.c / self.stack.epsilon,
            slip_onset_pair_ratio=state.b / state.G, slip_onset_wall_travel=travel)
        self.peak(self.slide(state) if self.stack.closed else state)

    def peak(self, state):
        """What a peak is: the cylinders stick there, and the wall has not arrived."""
        rise = state.y1 - (1 - state.z)
        sticks = state.friction < self.mu_d * state.G
        if sticks and state.force * self.stack.epsilon < rise:
            self.found.update(peak_F=state.force, peak_z=state.z,
                              peak_wall_travel=self.rest.wall - state.wall)

    # The floor slides while contact 2-3 is closed: e = mu d, whatever the springs were.

    def sliding(self, T, guess):
        """(G, b, d) of the unreduced balances at T."""
        s, c, stack = sine(T), cosine(T), self.stack

        def lacking(G, b, d):
            e, between = self.mu * d, 2 - 2 * (2 - G) * s
            return [b * (1 + stack.pair * G) - e * (1 + stack.floor * d),
                    G * s - b * c - e + between,
                    2 * (G * c + b * s) - 2 * (d - stack.epsilon)]
        return tuple(mp.findroot(lacking, guess, tol=mpf(10) ** (10 - 2 * mp.dps), maxsteps=50))

    def sliding_state(self, T, guess):
        G, b, d = self.sliding(T, guess)
        return State(self, T, G, b, d, b)

    def opening(self, start):
        """The sliding state in which contact 2-3 opens."""
        guess = (start.G, start.b, start.z)
        low = high = start.T
        while self.sliding_state(high, guess).outward < 0:
            low, high = high, high + mpf("0.01")
        T = bracketed_root(lambda T: self.sliding_state(T, guess).outward, low, high)
        return self.sliding_state(T, guess)

    def slide(self, start):
        """The largest force on the sliding branch: where the contact opens, or before."""
        opening = self.opening(start)
        guess = (opening.G, opening.b, opening.z)
        small = mpf(10) ** -(mp.dps // 3)

        def slope(T):
            ahead, behind = (self.sliding_state(T + side, guess).force for side in (small, -small))
            return (ahead - behind) / (2 * small)

        if slope(opening.T) >= 0:
            return opening
        T = bracketed_root(lambda T: -slope(T), start.T, opening.T)
        return self.sliding_state(T, guess)

    def slide_to_rest(self, _, __):
        """A stack that slid under its own weight rests if the contact is closed with F = 0."""
        epsilon = self.stack.epsilon
        self.stack.compression()
        guess = (epsilon / 2, self.mu * epsilon, 3 * epsilon / 2)
        opening = self.opening(self.sliding_state(mu_c() + epsilon / 100, guess))
        if opening.force < 0:
            return
        guess = (opening.G, opening.b, opening.z)
        T = bracketed_root(lambda T: self.sliding_state(T, guess).force,
                           mu_c() + epsilon / 100, opening.T)
        # It slid before it stood, so that its rest is no answer, but its wall is where the travel begins.
        self.rest = self.sliding_state(T, guess)
        self.peak(self.slide(self.rest))


class FixedLimit(Limit):
    """The same where nothing turns the spring 1-2. It remembers, so that a sliding branch is
    followed from where it begins."""

    STACK = FixedStack
    STEP = mpf("0.025")  # with 0.05 and a floor arm of -1, 1e-21 of the torque is left

    def opens(self, T, state):
        return (2 - self.stack.overlap(state)) * sine(T) - 1

    def falls(self, T, state):
        """How fast the load falls; L = 2 (G cos psi + q_y)."""
        overlap, _, lift = self.stack.derivative(T, state)
        return state[0] * sine(T) * 2 / (1 + T**2) - overlap * cosine(T) - lift

    def slide(self, start):
        """The largest force on the sliding branch: where the contact opens, or before. None if
        the cylinders slip on the way."""
        self.stack.sliding = self.mu
        T, state, name = start.T, start.path, None
        ends = {self.opens: "opens", self.falls: "falls", self.cylinders_slip: "slip"}
        while not name:
            T, state, name = self.next_crossing(T, state, ends)
        return None if name == "slip" else State.on_path(self, T, state)

    def slide_to_rest(self, T, state):
        self.stack.sliding = self.mu
        name = None
        while not name:
            T, state, name = self.next_crossing(T, state, {self.opens: "opens", self.settles: "rest"})
        if name == "rest":
            self.stack.compression()
            self.rest = State.on_path(self, T, state)
            self.peak(self.slide(self.rest))

    def peak(self, state):
        if state:
            super().peak(state)


class State:
    """A state of equilibrium under the wall, or with F = 0."""

    def __init__(self, limit, T, G, b, z, friction):
        epsilon = limit.stack.epsilon
        self.T, self.G, self.b, self.z, self.friction = T, G, b, z, friction
        self.outward = (2 - G) * sine(T) - 1
        self.c = -2 * self.outward if limit.stack.closed else mpf(0)
        self.force = 2 * z / epsilon - 3
        self.y1 = 1 - z + (2 - G) * cosine(T)
        self.wall = self.y1 + 1 - epsilon * self.force

    @classmethod
    def on_path(cls, limit, T, path):
        stack = limit.stack
        z, _, _, b, _ = stack.forces(T, path, stack.load(T, path))
        state = cls(limit, T, stack.overlap(path), b, z, stack.friction(T, path))
        state.path = path
        return state


RESULTS = ("rest_x2 rest_y1 rest_y2 slip_onset_F slip_onset_T slip_onset_y slip_onset_z slip_onset_c "
           "slip_onset_pair_ratio slip_onset_wall_travel peak_F peak_z peak_wall_travel "
           "cylinder_slip_F cylinder_slip_T").split()


def limits():
    with mp.workdps(ARMS_DIGITS):
        rows = []
        for vector in json.loads((VECTORS / "limits.json").read_text())["vectors"]:
            fixed = vector["input"]["history_update"] == "fixed"
            limit = (FixedLimit if fixed else Limit)(vector["input"])
            event = limit.first_event or "none"
            rows.append([vector["id"], event, *(text(limit.found.get(key)) for key in RESULTS)])
        write("vector_limits.csv", ["id", "first_event", *RESULTS], rows)


# --- trajectories -----------------------------------------------------------

class Body:
    def __init__(self, x, y):
        self.place, self.angle = [x, y], mpf(0)
        self.velocity, self.spin = [mpf(0), mpf(0)], mpf(0)

    def clear(self, gravity):
        self.force, self.torque = [mpf(0), -gravity], mpf(0)


class Contact:
    """A contact of the first body with another one or, if that is None, with a wall."""

    def __init__(self, first, second, friction, arms):
        self.first, self.second, self.friction = first, second, friction
        self.torque_arm, self.kinematic_arm = (mpf(arms[key]) for key in ("torque_arm", "kinematic_arm"))
        self.part()

    def part(self):
        self.spring, self.normal = mpf(0), None
        self.vector = [mpf(0), mpf(0)]
        self.pressure = self.shear = mpf(0)

    def press(self, run, normal, overlap, wall_velocity=(0, 0)):
        """Force of a contact that overlaps; n points to the first body, t = (-n_y, n_x)."""
        if overlap <= 0:
            return self.part()
        first, second = self.first, self.second
        tangent = [-normal[1], normal[0]]
        other = second.velocity if second else wall_velocity
        relative = [first.velocity[0] - other[0], first.velocity[1] - other[1]]
        spin = first.spin + (second.spin if second else 0)
        sliding = dot(relative, tangent) - (1 + self.kinematic_arm * overlap) * spin
        self.pressure = run.law["normal_stiffness"] * overlap - run.law["damping_normal"] * dot(relative, normal)
        if run.words["tensile_force"] == "never-pulls":
            self.pressure = max(self.pressure, mpf(0))
        if run.words["history_update"] == "fixed":
            spring = self.stretch_in_space(run, [sliding * t for t in tangent])
            self.shear = dot(spring, tangent)
            force = [self.pressure * n + part for n, part in zip(normal, spring)]
        else:
            self.turn(run.words["history_update"], normal)
            self.shear = self.stretch(run, sliding)
            force = [self.pressure * n + self.shear * t for n, t in zip(normal, tangent)]
        torque = -(1 + self.torque_arm * overlap) * self.shear
        first.force = [own + new for own, new in zip(first.force, force)]
        first.torque += torque
        if second:
            second.force = [own - new for own, new in zip(second.force, force)]
            second.torque += torque

    def turn(self, update, normal):
        if self.normal and update != "rotated":
            cosine = dot(self.normal, normal)
            sine = self.normal[0] * normal[1] - self.normal[1] * normal[0]
            self.spring *= cosine + (sine**2 if update == "linearised" else 0)
        self.normal = normal

    def stretch(self, run, sliding):
        """Tangential force; the spring grows by the sliding of one step unless the contact slides."""
        stiffness, damping = run.law["tangential_stiffness"], run.law["damping_tangential"] * sliding
        stretched = self.spring + sliding * run.dt
        whole = -stiffness * stretched - damping
        alone = run.words["coulomb_operand"] == "spring"
        operand, limit = (-stiffness * stretched if alone else whole), self.friction * abs(self.pressure)
        if abs(operand) < limit:
            self.spring = stretched
            return whole
        limited = -limit if operand < 0 else limit
        if run.words["sliding_spring"] == "follows-limit":
            self.spring = -(limited + (0 if alone else damping)) / stiffness
        return limited

    def stretch_in_space(self, run, sliding):
        """The same with vectors: nothing turns the spring, and all of it is limited."""
        stiffness, damping = run.law["tangential_stiffness"], run.law["damping_tangential"]
        stretched = [old + run.dt * v for old, v in zip(self.vector, sliding)]
        whole = [-stiffness * u - damping * v for u, v in zip(stretched, sliding)]
        alone = run.words["coulomb_operand"] == "spring"
        operand = [-stiffness * u for u in stretched] if alone else whole
        length, limit = mp.hypot(*operand), self.friction * abs(self.pressure)
        if length < limit:
            self.vector = stretched
            return whole
        # No vector has no direction.
        limited = [limit * part / length if length else mpf(0) for part in operand]
        if run.words["sliding_spring"] == "follows-limit":
            kept = 0 if alone else damping
            self.vector = [-(part + kept * v) / stiffness for part, v in zip(limited, sliding)]
        return limited


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


class Run:
    """One compression: everything it knows stands in the vector file."""

    def __init__(self, vector):
        case, self.steps = vector["case"], vector["steps"]
        stack, self.words = case["stack"], case["convention"]
        self.law = {key: mpf(value) for key, value in vector["law"].items()}
        self.dt, self.speed = (mpf(case["protocol"][key]) for key in ("time_step", "wall_speed"))
        self.gravity, self.inertia = 1 / mpf(stack["stiffness"]), mpf(self.words["moment_of_inertia"])
        self.bodies = [Body(mpf(0), 1 + mp.sqrt(3)), Body(mpf(1), mpf(1)), Body(mpf(-1), mpf(1))]
        mu, mu_d = mpf(stack["floor_friction"]), mpf(stack["cylinder_friction"])
        pairs, walls = self.words["pair"], self.words["floor"]
        self.pairs = [Contact(self.bodies[i], self.bodies[j], mu_d, pairs)
                      for i, j in ((1, 0), (2, 0), (2, 1))]
        self.floor = [Contact(body, None, mu, walls) for body in self.bodies]
        self.lid = [Contact(body, None, mpf(0), walls) for body in self.bodies]
        self.wall = None

    def rows(self):
        steps = self.steps
        preparation = steps["ramp"] + steps["rest"]
        sampled = set(range(0, steps["fine_from"], steps["coarse_every"]))
        sampled |= set(range(steps["fine_from"], steps["compression"] + 1, steps["fine_every"]))
        for step in range(preparation + steps["compression"] + 1):
            if step == preparation:
                self.wall = self.bodies[0].place[1] + 1
            self.evaluate(min(mpf(step) / steps["ramp"], mpf(1)))
            if step - preparation in sampled:
                yield self.row(step - preparation)
            self.move()

    def evaluate(self, x):
        for body in self.bodies:
            body.clear(self.gravity * x**3 * (10 - 15 * x + 6 * x**2))
        for contact in self.pairs:
            apart = [a - b for a, b in zip(contact.first.place, contact.second.place)]
            distance = mp.sqrt(dot(apart, apart))
            contact.press(self, [part / distance for part in apart], 2 - distance)
        for contact in self.floor:
            contact.press(self, [mpf(0), mpf(1)], 1 - contact.first.place[1])
        for contact in self.lid:
            if self.wall is not None:
                overlap = contact.first.place[1] + 1 - self.wall
                contact.press(self, [mpf(0), mpf(-1)], overlap, (mpf(0), -self.speed))

    def move(self):
        for body in self.bodies:
            for axis in (0, 1):
                body.velocity[axis] += body.force[axis] * self.dt
                body.place[axis] += body.velocity[axis] * self.dt
            body.spin += body.torque / self.inertia * self.dt
            body.angle += body.spin * self.dt
        if self.wall is not None:
            self.wall -= self.speed * self.dt

    def row(self, step):
        motion = [number for body in self.bodies for number in (*body.place, body.angle)]
        # The tangent of the floor points to the left.
        floor = [number for contact in self.floor[1:] for number in (contact.pressure, -contact.shear)]
        return [step, step * self.dt, self.lid[0].pressure, *motion, *floor]


def trajectories():
    with mp.workdps(TRAJECTORY_DIGITS):
        rows = []
        for file in sorted(VECTORS.glob("trajectory-*.json")):
            vector = json.loads(file.read_text())
            columns = [column["name"] for column in vector["columns"]]
            rows += [[vector["id"], row[0], *map(text, row[1:])] for row in Run(vector).rows()]
        write("vector_trajectories.csv", ["id", *columns], rows)


def main():
    print("mpmath", mpmath.__version__)
    wanted = sys.argv[1:] or ["limits", "trajectories"]
    for table in (table for table in (limits, trajectories) if table.__name__ in wanted):
        started = time.time()
        table()
        print(f"{table.__name__}: {time.time() - started:.0f} s")


if __name__ == "__main__":
    main()
