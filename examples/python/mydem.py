"""A DEM of the three-cylinder stack in plain Python: reads task.json, steps, writes result.csv.

Units: radius r = 1, mass m = 1, normal stiffness k_n = 1, so forces in k_n r, times in sqrt(m/k_n).

         1           Cylinder 1 rests on 2 (right) and 3 (left), which rest on the floor y = 0.  All
       3   2         just touch and are free of stress when the run begins.  Gravity rises smoothly,
    -----------      the stack rests, and then a frictionless wall moves down onto cylinder 1.

A contact is a spring and a dashpot along the normal, and the same along the tangent with the force
capped at mu times the normal force (Cundall and Strack).  Positions and velocities leapfrog: the
velocities belong to half a step before the positions; a step computes the forces at the present
positions, kicks the velocities with them, and moves the positions on.
"""
import json
from math import sqrt

RADIUS, MASS, INERTIA = 1.0, 1.0, 0.5  # a solid cylinder turns with m r^2 / 2


class Cylinder:
    """Position, angle (counter-clockwise), their rates, and force and torque of the present step."""

    def __init__(self, x, y, vx=0.0, vy=0.0, spin=0.0):
        self.x, self.y, self.angle, self.vx, self.vy, self.spin = x, y, 0.0, vx, vy, spin

    def clear(self, gravity):
        self.fx, self.fy, self.torque = 0.0, -MASS * gravity, 0.0

    def move(self, dt):
        self.vx += self.fx / MASS * dt
        self.vy += self.fy / MASS * dt
        self.spin += self.torque / INERTIA * dt
        self.x, self.y, self.angle = self.x + self.vx * dt, self.y + self.vy * dt, self.angle + self.spin * dt


class Contact:
    """The law of one contact, the stretch of its tangential spring, and its present forces."""

    def __init__(self, task, friction):
        self.kn, self.kt = task["normal_stiffness"], task["tangential_stiffness"]
        self.cn, self.ct = task["damping_normal"], task["damping_tangential"]
        self.dt, self.friction, self.stretch = task["time_step"], friction, 0.0

    def press(self, overlap, separation, sliding):
        """Forces at an overlap, while the surfaces part and slide at these speeds."""
        if overlap <= 0.0:  # they do not touch, and will have forgotten when they do
            self.stretch = self.normal = self.tangential = 0.0
            return
        self.normal = self.kn * overlap - self.cn * separation
        stretch = self.stretch + sliding * self.dt
        self.tangential = -self.kt * stretch - self.ct * sliding
        limit = self.friction * abs(self.normal)
        if abs(self.tangential) < limit:
            self.stretch = stretch  # it sticks
        else:  # it slides, and the spring keeps its length
            self.tangential = limit if self.tangential > 0.0 else -limit

    def of_pair(self, one, two):
        """Two cylinders; the normal points from the second to the first, the tangent is (-ny, nx)."""
        dx, dy, vx, vy = one.x - two.x, one.y - two.y, one.vx - two.vx, one.vy - two.vy
        distance = sqrt(dx * dx + dy * dy)
        nx, ny = dx / distance, dy / distance
        # The surfaces move with the spin at this radius (the kinematic arm) ...
        sliding = nx * vy - ny * vx - RADIUS * (one.spin + two.spin)
        self.press(2.0 * RADIUS - distance, nx * vx + ny * vy, sliding)
        fx, fy = self.normal * nx - self.tangential * ny, self.normal * ny + self.tangential * nx
        torque = -RADIUS * self.tangential  # ... and the force turns both at this one (the torque arm)
        one.fx, one.fy, one.torque = one.fx + fx, one.fy + fy, one.torque + torque
        two.fx, two.fy, two.torque = two.fx - fx, two.fy - fy, two.torque + torque

    def of_floor(self, body):
        """A cylinder on the floor, whose tangent is (-1, 0)."""
        self.press(RADIUS - body.y, body.vy, -body.vx - RADIUS * body.spin)
        body.fx -= self.tangential
        body.fy += self.normal
        body.torque -= RADIUS * self.tangential

    def of_wall(self, body, height, speed):
        """A cylinder under the wall at this height, which moves down and has no friction."""
        self.press(body.y + RADIUS - height, -body.vy - speed, 0.0)
        body.fy -= self.normal


class Scene:
    """Cylinders, floor and top wall, with a contact for each two that may touch."""

    def __init__(self, task, bodies, height, speed):
        self.dt, self.bodies, self.height, self.speed, self.gravity = task["time_step"], bodies, height, speed, 0.0
        pairs = [(one, two) for index, one in enumerate(bodies) for two in bodies[:index]]
        self.pairs = [(Contact(task, task["cylinder_friction"]), *pair) for pair in pairs]
        self.floor = [(Contact(task, task["floor_friction"]), body) for body in bodies]
        self.wall = [(Contact(task, 0.0), body) for body in bodies]

    def compute_forces(self):
        for body in self.bodies:
            body.clear(self.gravity)
        for contact, one, two in self.pairs:
            contact.of_pair(one, two)
        for contact, body in self.floor:
            contact.of_floor(body)
        for contact, body in self.wall:
            contact.of_wall(body, self.height, self.speed)

    def move(self):
        for body in self.bodies:
            body.move(self.dt)
        self.height -= self.speed * self.dt


def stack(task, write):
    """Prepares the stack under gravity, compresses it, and writes the rows that are asked for."""
    top, right, left = bodies = Cylinder(0.0, 1.0 + sqrt(3.0)), Cylinder(1.0, 1.0), Cylinder(-1.0, 1.0)
    scene = Scene(task, bodies, float("inf"), 0.0)
    for step in range(task["ramp_steps"] + task["rest_steps"]):
        x = min(step / task["ramp_steps"], 1.0)  # gravity rises without a jerk at either end
        scene.gravity = task["gravity"] * x**3 * (10.0 - 15.0 * x + 6.0 * x**2)
        scene.compute_forces()
        scene.move()
    scene.gravity = task["gravity"]
    scene.height, scene.speed = top.y + RADIUS, task["wall_speed"]  # it just touches
    write("step,time,wall_force,x1,y1,theta1,x2,y2,theta2,x3,y3,theta3,floor_n2,floor_t2,floor_n3,floor_t3")
    fine, last = task["fine_from_step"], task["compression_steps"]
    rows = {*range(0, fine, task["coarse_every"]), *range(fine, last + 1, task["fine_every"])}
    (wall, _), (on_right, _), (on_left, _) = scene.wall[0], *scene.floor[1:]
    for step in range(last + 1):
        scene.compute_forces()
        if step in rows:  # positions and forces of the same moment; forces of the floor along +x
            write(step, step * scene.dt, wall.normal, *(value for b in bodies for value in (b.x, b.y, b.angle)),
                  on_right.normal, -on_right.tangential, on_left.normal, -on_left.tangential)
        scene.move()


def motion(task, write):
    """Moves two cylinders without gravity and writes every step: so the law of a contact is measured."""
    bodies = [Cylinder(*(task[name + body] for name in ("x", "y", "vx", "vy", "spin"))) for body in "12"]
    scene = Scene(task, bodies, task["wall_height"], task["wall_speed"])
    write("step,x1,y1,vx1,vy1,spin1,fx1,fy1,torque1,x2,y2,vx2,vy2,spin2,fx2,fy2,torque2,wall_force")
    for step in range(task["steps"] + 1):
        scene.compute_forces()
        state = (value for b in bodies for value in (b.x, b.y, b.vx, b.vy, b.spin, b.fx, b.fy, b.torque))
        write(step, *state, sum(contact.normal for contact, _ in scene.wall))
        scene.move()


if __name__ == "__main__":
    with open("task.json") as file:
        parameters = json.load(file)
    with open("result.csv", "w") as out:  # str() and repr() of a number give every digit of it
        simulate = stack if "ramp_steps" in parameters else motion
        simulate(parameters, lambda *row: print(*row, sep=",", file=out))
