#!/usr/bin/env python3
"""What a wall speed adds to onset and peak, to first order, by another way than src/theory/path/speed.rs: writes
first_order.csv. Needs numpy and scipy.

    python3 first_order.py > first_order.csv

Places and forces are those of bodies in the plane. A spring is a displacement, as a vector in space (`fixed`) or as a length
along the tangent (`turns`), and every derivative is a difference of two balances of forces. Linear springs, cylinders,
gravity that rises slowly, then a wall that moves down; docs/theory.md, section 8.7, has the derivation.
"""

import csv
import math
import sys

import numpy as np
from scipy.integrate import solve_ivp

RESTITUTION = 0.7
INERTIA = np.diag([1.0, 1.0, 1.0, 0.5])
REST = np.zeros(4)


def damping(stiffness):
    log = math.log(RESTITUTION)
    return -2.0 * log * math.sqrt(stiffness / (math.pi**2 + log**2))


def slope(function, place, step=1e-6):
    columns = [(function(place + step * unit) - function(place - step * unit)) / (2 * step) for unit in np.eye(len(place))]
    return np.array(columns).T


class Stack:
    """Place: y1, x2, y2 and the rotation of cylinder 2. Springs: two components of the pair's, and the floor's."""

    def __init__(self, stiffness, kappa, friction, turns, arms):
        self.epsilon = 1.0 / stiffness
        self.tangential = 1.0 / kappa
        self.friction = friction
        self.turns = turns
        self.arms = arms
        self.damping = damping(1.0), damping(self.tangential)

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

    def rates(self, place):
        """Rates of the springs, as rows that velocities are multiplied with."""
        upper, lower = self.surfaces(place)
        tangent = [1.0, 0.0] if self.turns else self.frame(place)[2]
        return np.array([tangent[0] * upper, tangent[1] * upper, lower])

    def contacts(self, place, velocity, springs, slides):
        """Normal and tangential force of the pair, then of the floor."""
        distance, normal, tangent = self.frame(place)
        upper, lower = self.surfaces(place) @ velocity
        opening = normal @ np.array([-velocity[1], velocity[0] - velocity[2]])
        spring = springs[0] * tangent if self.turns else springs[:2]
        pair = self.tangential * spring + self.damping[1] * upper * tangent
        normal_force = 2.0 - distance - self.damping[0] * opening + pair @ normal
        floor = 1.0 - place[2] - self.damping[0] * velocity[2]
        sticking = self.tangential * springs[2] + self.damping[1] * lower
        return normal_force, pair @ tangent, floor, self.friction * floor if slides else sticking

    def balance(self, place, velocity, springs, wall, weight, slides=False):
        distance, normal, tangent = self.frame(place)
        a, b, d, e = self.contacts(place, velocity, springs, slides)
        force = a * normal + b * tangent
        upper = 1.0 + self.arms[0] * (2.0 - distance)
        lower = 1.0 + self.arms[2] * (1.0 - place[2])
        return np.array([2.0 * force[1] - wall - weight, -force[0] - e, d - force[1] - weight, b * upper - e * lower])

    def stiffness(self, place, springs, weight, wall, slides=False):
        """Forces per change of place, and of springs."""
        by_place = slope(lambda own: self.balance(own, REST, springs, wall * own[0], weight, slides), place)
        by_springs = slope(lambda own: self.balance(place, REST, own, 0.0, weight, slides), springs)
        return by_place, by_springs

    def lag(self, place, springs, kept):
        """Motion per wall travel, rates of the springs, and the lag of the place at the wall speed 1."""
        by_place, by_springs = self.stiffness(place, springs, self.epsilon, 1.0)
        rates = self.rates(place)
        tangent = by_place + by_springs @ rates
        motion = np.linalg.solve(tangent, [1.0, 0.0, 0.0, 0.0])
        force = by_springs @ kept + slope(lambda own: self.balance(place, own, springs, 0.0, self.epsilon), REST) @ motion
        force[0] -= self.damping[0] * (motion[0] + 1.0)
        return motion, rates, np.linalg.solve(tangent, -force)

    def settled(self):
        def ramp(weight, state):
            place, springs = state[:4], state[4:]
            by_place, by_springs = self.stiffness(place, springs, weight * self.epsilon, 0.0)
            rates = self.rates(place)
            weights = [self.epsilon, 0.0, self.epsilon, 0.0]
            motion = np.linalg.solve(by_place + by_springs @ rates, weights)
            return np.r_[motion, rates @ motion]

        start = np.r_[1.0 + math.sqrt(3.0), 1.0, 1.0, 0.0, np.zeros(3)]
        return solve_ivp(ramp, (0.0, 1.0), start, method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]

    def onset(self):
        """The state in which the floor slips, what springs have kept of the lag by then, and the wall travel."""

        def compression(_, state):
            place, springs, kept = state[:4], state[4:7], state[7:]
            motion, rates, lag = self.lag(place, springs, kept)
            change = lambda along: (self.rates(place + 1e-6 * along) - self.rates(place - 1e-6 * along)) / 2e-6
            return np.r_[motion, rates @ motion, change(lag) @ motion - change(motion) @ lag]

        def excess(_, state):
            _, _, d, e = self.contacts(state[:4], REST, state[4:7], False)
            return e - self.friction * d

        excess.terminal = True
        start = self.settled()
        tolerances = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-14}
        way = solve_ivp(compression, (0.0, 2.0), np.r_[start, np.zeros(3)], events=excess, **tolerances)
        travel, state = way.t_events[0][0], way.y_events[0][0]
        return state, state[0] - start[0] + travel

    def first_order(self):
        """F at the onset, and what a speed adds to onset and peak, per speed."""
        state, wall = self.onset()
        place, springs, kept = state[:4], state[4:7], state[7:]
        motion, rates, lag = self.lag(place, springs, kept)
        late_springs = kept + rates @ lag

        def excess(numbers):
            _, _, d, e = self.contacts(numbers[:4], numbers[4:8], numbers[8:], False)
            return np.array([e - self.friction * d])

        along = slope(excess, np.r_[place, REST, springs])[0]
        growth = along @ np.r_[motion, REST, rates @ motion]
        late = -(along @ np.r_[lag, motion, late_springs]) / growth
        start = lag + late * motion
        own = late_springs + late * rates @ motion - rates @ start
        by_place, by_springs = self.stiffness(place, springs, self.epsilon, 1.0, True)
        by_springs[:, 2] = 0.0
        by_place += by_springs @ rates
        by_velocity = slope(
            lambda own: self.balance(place, own, springs, self.damping[0] * own[0], self.epsilon, True), REST
        )

        def sliding(time, numbers):
            force = by_place @ numbers[:4] + by_velocity @ numbers[4:] + by_springs @ own
            force[0] -= time + late + self.damping[0]
            return np.r_[numbers[4:], np.linalg.solve(INERTIA, force)]

        times = np.linspace(0.0, 60.0, 60001)
        tolerances = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-13}
        found = solve_ivp(sliding, (0.0, 60.0), np.r_[start, motion], t_eval=times, **tolerances)
        force = found.y[0] + found.t + late + self.damping[0] * (found.y[4] + 1.0)
        return [wall / self.epsilon, force[0] / self.epsilon, force.max() / self.epsilon]


NO_ARMS = (0.0, 0.0, 0.0, 0.0)
ARMS = (-0.5, -0.2, -0.8, 0.3)
STACKS = [
    (1e2, 2.5, 0.2, NO_ARMS),
    (1e2, 2.5, 0.3, NO_ARMS),
    (1e2, 2.5, 0.3, ARMS),
    (137.0, 2.3, 0.22, ARMS),
    (1e3, 2.5, 0.24, NO_ARMS),
    (1e4, 2.5, 0.12, NO_ARMS),
    (1e4, 2.5, 0.24, NO_ARMS),
]


def main():
    out = csv.writer(sys.stdout, lineterminator="\n")
    arms = ["pair_torque_arm", "pair_kinematic_arm", "floor_torque_arm", "floor_kinematic_arm"]
    out.writerow(["stiffness", "kappa", "mu", "spring", *arms, "force", "onset_per_speed", "peak_per_speed"])
    for stiffness, kappa, friction, own in STACKS:
        for turns in [False, True]:
            found = Stack(stiffness, kappa, friction, turns, own).first_order()
            spring = "turns" if turns else "fixed"
            out.writerow([stiffness, kappa, friction, spring, *own, *(f"{number:.10g}" for number in found)])


if __name__ == "__main__":
    main()
