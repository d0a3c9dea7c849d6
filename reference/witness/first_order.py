#!/usr/bin/env python3
"""What a wall speed adds to onset and peak, to first order, by another way than src/theory/path/speed.rs: writes
first_order.csv. Needs numpy and scipy.

    python3 first_order.py > first_order.csv

Places and forces are those of bodies in the plane. A spring is a displacement, or a force where the law remembers that, as a
vector in space (`fixed`) or as a length along the tangent (`turns`), and every derivative is a difference of two balances of
forces. Linear and other springs, cylinders, gravity that rises slowly, then a wall that moves down; docs/theory.md, section
8.7, has the derivation.
"""

import csv
import math
import sys

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

RESTITUTION = 0.7
INERTIA = np.diag([1.0, 1.0, 1.0, 0.5])
REST = np.zeros(4)
WITHOUT_WEIGHT = np.array([1.0 + math.sqrt(3.0), 1.0, 1.0, 0.0])
# Lengths of the state from which the weight grows where contacts are soft without it, relative to those at full weight.
# Springs are wrong by its square.
FIRST_LENGTH = 1e-4


def damping(stiffness, power):
    log = math.log(RESTITUTION)
    return -2.0 * log * math.sqrt((power + 1.0) / (2.0 * power) * stiffness / (math.pi**2 + log**2))


def slope(function, place, step=1e-6):
    columns = [(function(place + step * unit) - function(place - step * unit)) / (2 * step) for unit in np.eye(len(place))]
    return np.array(columns).T


class Law:
    """A normal force K d^p of the overlap d, and what belongs to it."""

    def __init__(self, scale, kappa, power, stiffens, viscoelastic):
        self.scale, self.power, self.stiffens = scale, power, stiffens
        self.tangential = scale * power / kappa
        self.dampers = damping(scale * power, power), damping(scale * power / kappa, power)
        self.growth = (power - 1.0) * (1.0 if viscoelastic else 0.5)

    def force(self, overlap):
        return self.scale * overlap**self.power

    def stiffness(self, overlap):
        return self.scale * self.power * overlap ** (self.power - 1.0)

    def tangential_stiffness(self, overlap):
        return self.tangential * overlap ** (self.power - 1.0) * self.stiffening(overlap)

    def damping(self, overlap):
        normal, tangential = (own * overlap**self.growth for own in self.dampers)
        return normal, tangential * self.stiffening(overlap)

    def stiffening(self, overlap):
        return 2.0 / (2.0 - overlap) if self.stiffens else 1.0


class Stack:
    """Place: y1, x2, y2 and the rotation of cylinder 2. Springs: two components of the pair's, and the floor's."""

    def __init__(self, stiffness, kappa, friction, turns, arms, power, floor_ratio, history, stiffening, growth):
        self.epsilon = 1.0 / stiffness
        self.friction = friction
        self.turns = turns
        self.arms = arms
        self.keeps_force = history == "force"
        self.pair = Law(1.0, kappa, power, stiffening != "none", growth == "viscoelastic")
        self.wall = Law(floor_ratio, kappa, power, stiffening == "every", growth == "viscoelastic")

    def frame(self, place):
        along, up = -place[1], place[0] - place[2]
        distance = math.hypot(along, up)
        normal = np.array([along, up]) / distance
        return distance, normal, np.array([normal[1], -normal[0]])

    def surfaces(self, place):
        """Sliding speeds of pair and floor, as rows that velocities are multiplied with."""
        distance, normal, tangent = self.frame(place)
        pair = 1.0 + self.arms[1] * (2.0 - distance)
        floor = 1.0 + self.arms[3] * (1.0 - place[2])
        upper = np.array([-tangent[1] * 1.0, tangent[0], tangent[1], -pair])
        return np.array([upper, [0.0, 1.0, 0.0, floor]])

    def overlaps(self, place):
        return 2.0 - self.frame(place)[0], 1.0 - place[2]

    def rates(self, place):
        """Rates of the springs, as rows that velocities are multiplied with."""
        upper, lower = self.surfaces(place)
        if self.keeps_force:
            pair, floor = self.overlaps(place)
            upper, lower = self.pair.tangential_stiffness(pair) * upper, self.wall.tangential_stiffness(floor) * lower
        tangent = [1.0, 0.0] if self.turns else self.frame(place)[2]
        return np.array([tangent[0] * upper, tangent[1] * upper, lower])

    def exerted(self, place, springs):
        """Forces of the springs."""
        if self.keeps_force:
            return springs
        pair, floor = self.overlaps(place)
        pair, floor = self.pair.tangential_stiffness(pair), self.wall.tangential_stiffness(floor)
        return np.array([pair, pair, floor]) * springs

    def contacts(self, place, velocity, springs, slides):
        """Normal and tangential force of the pair, then of the floor."""
        distance, normal, tangent = self.frame(place)
        upper, lower = self.surfaces(place) @ velocity
        opening = normal @ np.array([-velocity[1], velocity[0] - velocity[2]])
        springs = self.exerted(place, springs)
        spring = springs[0] * tangent if self.turns else springs[:2]
        (own, across), (below, along) = map(Law.damping, (self.pair, self.wall), self.overlaps(place))
        pair = spring + across * upper * tangent
        normal_force = self.pair.force(2.0 - distance) - own * opening + pair @ normal
        floor = self.wall.force(1.0 - place[2]) - below * velocity[2]
        sticking = springs[2] + along * lower
        return normal_force, pair @ tangent, floor, self.friction * floor if slides else sticking

    def balance(self, place, velocity, springs, wall, weight, slides=False):
        distance, normal, tangent = self.frame(place)
        a, b, d, e = self.contacts(place, velocity, springs, slides)
        force = a * normal + b * tangent
        upper = 1.0 + self.arms[0] * (2.0 - distance)
        lower = 1.0 + self.arms[2] * (1.0 - place[2])
        return np.array([2.0 * force[1] - wall - weight, -force[0] - e, d - force[1] - weight, b * upper - e * lower])

    def step(self, place):
        """Step of differences: small beside the overlaps where stiffnesses grow with them."""
        return 1e-6 if self.pair.power == 1.0 else min(1e-6, 1e-3 * min(self.overlaps(place)))

    def stiffness(self, place, springs, weight, wall, slides=False):
        """Forces per change of place, and of springs, where the wall is so stiff."""
        step = self.step(place)
        by_place = slope(lambda own: self.balance(own, REST, springs, wall * own[0], weight, slides), place, step)
        by_springs = slope(lambda own: self.balance(place, REST, own, 0.0, weight, slides), springs)
        return by_place, by_springs

    def lag(self, place, springs, kept, pressed):
        """Motion per travel of the wall, in which it is `pressed`, rates of the springs, and the lag of the place at the
        wall speed 1."""
        wall = self.wall.stiffness(pressed)
        by_place, by_springs = self.stiffness(place, springs, self.epsilon, wall)
        rates = self.rates(place)
        tangent = by_place + by_springs @ rates
        motion = np.linalg.solve(tangent, [wall, 0.0, 0.0, 0.0])
        force = by_springs @ kept + slope(lambda own: self.balance(place, own, springs, 0.0, self.epsilon), REST) @ motion
        force[0] -= self.wall.damping(pressed)[0] * (motion[0] + 1.0)
        return motion, rates, np.linalg.solve(tangent, -force)

    def light(self, part):
        """The state at a small `part` of the weight, where all lengths have grown alike."""
        upper, lower = self.surfaces(WITHOUT_WEIGHT)
        tangent = [1.0, 0.0] if self.turns else self.frame(WITHOUT_WEIGHT)[2]
        surfaces = np.array([tangent[0] * upper, tangent[1] * upper, lower])
        power = self.pair.power
        depth = (1.5 * part * self.epsilon) ** (1.0 / power)

        def state(change):
            place, springs = WITHOUT_WEIGHT + depth * change, depth * surfaces @ change
            if self.keeps_force:
                pair, floor = self.overlaps(place)
                pair, floor = self.pair.tangential_stiffness(pair), self.wall.tangential_stiffness(floor)
                springs *= np.array([pair, pair, floor]) / power
            return place, springs

        def lacks(change):
            place, springs = state(change)
            return self.balance(place, REST, springs, 0.0, part * self.epsilon) / (part * self.epsilon)

        return np.concatenate(state(fsolve(lacks, [-2.0, 0.3, -1.0, -0.3], xtol=1e-10)))

    def settled(self):
        """The state at full weight, which grows as lengths do to its power."""
        power = self.pair.power

        def ramp(length, state):
            place, springs = state[:4], state[4:]
            by_place, by_springs = self.stiffness(place, springs, length**power * self.epsilon, 0.0)
            rates = self.rates(place)
            growth = power * length ** (power - 1.0) * self.epsilon
            motion = np.linalg.solve(by_place + by_springs @ rates, [growth, 0.0, growth, 0.0])
            return np.r_[motion, rates @ motion]

        first = 0.0 if power == 1.0 else FIRST_LENGTH
        start = np.r_[WITHOUT_WEIGHT, np.zeros(3)] if power == 1.0 else self.light(first**power)
        return solve_ivp(ramp, (first, 1.0), start, method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]

    def onset(self):
        """The state in which the floor slips, what springs have kept of the lag by then, and the overlap of the wall."""

        def compression(_, state):
            place, springs, kept, pressed = state[:4], state[4:7], state[7:10], state[10]
            motion, rates, lag = self.lag(place, springs, kept, max(pressed, 0.0))
            change = lambda along: (self.rates(place + 1e-6 * along) - self.rates(place - 1e-6 * along)) / 2e-6
            return np.r_[motion, rates @ motion, change(lag) @ motion - change(motion) @ lag, 1.0 + motion[0]]

        def excess(_, state):
            _, _, d, e = self.contacts(state[:4], REST, state[4:7], False)
            return e - self.friction * d

        excess.terminal = True
        tolerances = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-14}
        way = solve_ivp(compression, (0.0, 2.0), np.r_[self.settled(), np.zeros(4)], events=excess, **tolerances)
        return way.y_events[0][0]

    def first_order(self):
        """F at the onset, and what a speed adds to onset and peak, per speed."""
        state = self.onset()
        place, springs, kept, pressed = state[:4], state[4:7], state[7:10], state[10]
        motion, rates, lag = self.lag(place, springs, kept, pressed)
        late_springs = kept + rates @ lag
        step = self.step(place)

        def excess(numbers):
            _, _, d, e = self.contacts(numbers[:4], numbers[4:8], numbers[8:], False)
            return np.array([e - self.friction * d])

        along = slope(excess, np.r_[place, REST, springs], step)[0]
        growth = along @ np.r_[motion, REST, rates @ motion]
        late = -(along @ np.r_[lag, motion, late_springs]) / growth
        start = lag + late * motion
        own = late_springs + late * rates @ motion - rates @ start
        wall, damper = self.wall.stiffness(pressed), self.wall.damping(pressed)[0]
        by_place, by_springs = self.stiffness(place, springs, self.epsilon, wall, True)
        by_springs[:, 2] = 0.0
        by_place += by_springs @ rates
        by_velocity = slope(lambda own: self.balance(place, own, springs, damper * own[0], self.epsilon, True), REST)

        def sliding(time, numbers):
            force = by_place @ numbers[:4] + by_velocity @ numbers[4:] + by_springs @ own
            force[0] -= wall * (time + late) + damper
            return np.r_[numbers[4:], np.linalg.solve(INERTIA, force)]

        last = 60.0 / math.sqrt(self.pair.stiffness(self.overlaps(place)[0]))
        times = np.linspace(0.0, last, 60001)
        tolerances = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-13}
        found = solve_ivp(sliding, (0.0, last), np.r_[start, motion], t_eval=times, **tolerances)
        force = wall * (found.y[0] + found.t + late) + damper * (found.y[4] + 1.0)
        return [self.wall.force(pressed) / self.epsilon, force[0] / self.epsilon, force.max() / self.epsilon]


NO_ARMS = (0.0, 0.0, 0.0, 0.0)
ARMS = (-0.5, -0.2, -0.8, 0.3)
LINEAR = (1.0, 1.0, "displacement", "none", "constant-ratio")
HERTZ = (1.5, 1.3, "displacement", "none", "constant-ratio")
STEEP = (1.75, 0.8, "displacement", "every", "viscoelastic")
STACKS = [
    (1e2, 2.5, 0.2, NO_ARMS, LINEAR),
    (1e2, 2.5, 0.3, NO_ARMS, LINEAR),
    (1e2, 2.5, 0.3, ARMS, LINEAR),
    (137.0, 2.3, 0.22, ARMS, LINEAR),
    (1e3, 2.5, 0.24, NO_ARMS, LINEAR),
    (1e4, 2.5, 0.12, NO_ARMS, LINEAR),
    (1e4, 2.5, 0.24, NO_ARMS, LINEAR),
    (137.0, 4.3, 0.31, ARMS, HERTZ),
    (137.0, 4.3, 0.31, ARMS, (1.5, 1.3, "force", "none", "constant-ratio")),
    (570.0, 4.7, 0.27, ARMS, STEEP),
]


def main():
    out = csv.writer(sys.stdout, lineterminator="\n")
    arms = ["pair_torque_arm", "pair_kinematic_arm", "floor_torque_arm", "floor_kinematic_arm"]
    laws = ["power", "floor_ratio", "history", "tangential_stiffening", "damping"]
    results = ["force", "onset_per_speed", "peak_per_speed"]
    out.writerow(["stiffness", "kappa", "mu", "spring", *arms, *laws, *results])
    for stiffness, kappa, friction, own, law in STACKS:
        for turns in [False, True]:
            found = Stack(stiffness, kappa, friction, turns, own, *law).first_order()
            spring = "turns" if turns else "fixed"
            out.writerow([stiffness, kappa, friction, spring, *own, *law, *(f"{number:.10g}" for number in found)])


if __name__ == "__main__":
    main()
