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
       trajectories  the step that README.md describes, written once more with vectors,
                     in numbers of 30 digits. The program computes with doubles.
Units  r = m = k_n = 1, epsilon = 1/stiffness, forces F = f/(m g).
Inputs are the doubles nearest to what is printed; mu_c of the geometry is 2 - sqrt 3.
Run    python3 vectors.py [limits] [trajectories]
       Some three minutes. Needs Python >= 3.9 and mpmath (written with 1.3.0).
"""

import json
import sys
import time

import mpmath
from mpmath import mp, mpf

from generate import (ARMS_DIGITS, HERE, Stack, bracketed_root, cosine,
                      extrapolated_step, mu_c, sine, text, write)

VECTORS = HERE.parent / "vectors"
TRAJECTORY_DIGITS = 30


# --- limits -----------------------------------------------------------------

class Limit:
    """The limit of one stack: follow the path of equilibria until something gives way."""

    STEP, COLUMNS = mpf("0.05"), 14

    def __init__(self, given):
        self.mu, self.mu_d = mpf(given["mu"]), mpf(given["mu_d"])
        pair, floor = given["pair"], given["floor"]
        self.stack = Stack(1 / mpf(given["stiffness"]), mpf(given["kappa"]),
                           mpf(pair["torque_arm"]), mpf(floor["torque_arm"]),
                           (mpf(pair["kinematic_arm"]), mpf(floor["kinematic_arm"])))
        self.found = {}
        self.under_wall = False
        self.first_event = None
        # x_2 = (2 - G) sin psi shrinks from the start if its slope with c = 0 is negative.
        slope = self.stack.derivative(mu_c(), mpf(0))
        if 4 * cosine(mu_c()) / (1 + mu_c()**2) < slope * sine(mu_c()):
            self.happens("contact-closes", None, None)
        self.follow(mu_c(), mpf(0))

    # Crossings, each a function that is negative before it.

    def settles(self, T, G):
        return self.stack.load(T, G) - self.stack.epsilon

    def switches(self, T, G):
        outward = (2 - G) * sine(T) - 1
        return outward if self.stack.closed else -outward

    def floor_slips(self, T, G):
        z, _, _, _, e = self.stack.forces(T, G, self.stack.load(T, G))
        return e - self.mu * z

    def cylinders_slip(self, T, G):
        return self.stack.forces(T, G, self.stack.load(T, G))[3] - self.mu_d * G

    def wall_arrives(self, T, G):
        return self.stack.load(T, G) - self.stack.epsilon - (2 - G) * cosine(T)

    def crossings(self):
        common = {self.switches: "contact-opens" if self.stack.closed else "contact-closes",
                  self.floor_slips: "floor-slip" if self.under_wall else "own-weight",
                  self.cylinders_slip: "cylinder-slip"}
        leg = {self.wall_arrives: "wall-contact"} if self.under_wall else {self.settles: "rest"}
        return {**common, **leg}

    def advance(self, T, G, step):
        return extrapolated_step(self.stack.derivative, T, G, step, self.COLUMNS) if step else G

    def follow(self, T, G):
        while T < 1:
            following = self.advance(T, G, self.STEP)
            passed = [(self.crossed(crossing, T, G), name)
                      for crossing, name in self.crossings().items()
                      if crossing(T + self.STEP, following) > 0]
            if not passed:
                T, G = T + self.STEP, following
                continue
            reached, name = min(passed)
            T, G = T + reached, self.advance(T, G, reached)
            if self.happens(name, T, G):
                return

    def crossed(self, crossing, T, G):
        """How far beyond (T, G) it is; 0 if it has happened there, or from the start."""
        def along(step):
            return crossing(T + step, self.advance(T, G, step))

        near = mpf(10) ** -9 * self.STEP if G == 0 else mpf(0)
        return bracketed_root(along, near, self.STEP) if along(near) < 0 else mpf(0)

    def happens(self, name, T, G):
        """Note what happens at (T, G); whether it ends the path."""
        if name not in ("rest", "contact-opens"):
            self.first_event = self.first_event or name
        if name == "rest":
            self.settle(State.on_path(self, T, G))
            self.stack.compression()
            self.under_wall = True
        elif name in ("contact-closes", "contact-opens"):
            self.stack.closed = name == "contact-closes"
        elif name == "floor-slip":
            self.slip(State.on_path(self, T, G))
        elif name == "own-weight" and self.stack.closed:
            self.slide_to_rest()
        elif name == "cylinder-slip" and self.under_wall and not self.stack.closed:
            state = State.on_path(self, T, G)
            self.found.update(cylinder_slip_F=state.force, cylinder_slip_T=T)
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
        if state and state.b < self.mu_d * state.G and state.force * self.stack.epsilon < rise:
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
        return State(self, T, G, b, d, self.mu * d)

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

    def slide_to_rest(self):
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


class State:
    """A state of equilibrium under the wall, or with F = 0."""

    def __init__(self, limit, T, G, b, z, e):
        epsilon = limit.stack.epsilon
        self.T, self.G, self.b, self.z, self.e = T, G, b, z, e
        self.outward = (2 - G) * sine(T) - 1
        self.c = -2 * self.outward if limit.stack.closed else mpf(0)
        self.force = 2 * z / epsilon - 3
        self.y1 = 1 - z + (2 - G) * cosine(T)
        self.wall = self.y1 + 1 - epsilon * self.force

    @classmethod
    def on_path(cls, limit, T, G):
        stack = limit.stack
        z, _, _, b, e = stack.forces(T, G, stack.load(T, G))
        return cls(limit, T, G, b, z, e)


RESULTS = ("rest_x2 rest_y1 rest_y2 slip_onset_F slip_onset_T slip_onset_y slip_onset_z slip_onset_c "
           "slip_onset_pair_ratio slip_onset_wall_travel peak_F peak_z peak_wall_travel "
           "cylinder_slip_F cylinder_slip_T").split()


def limits():
    with mp.workdps(ARMS_DIGITS):
        rows = []
        for vector in json.loads((VECTORS / "limits.json").read_text())["vectors"]:
            limit = Limit(vector["input"])
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
