"""Rigid cylinders by contact dynamics, in plain Python: reads task.json, steps, writes result.csv.

Units: radius r = 1, mass m = 1, gravity g = 1, so forces in m g and times in sqrt(r/g).

In a step (Moreau's) gravity changes the velocities, and the impulses of the contacts correct them so that no gap closes
beyond zero within the step, surfaces that touch stick, or slide with a friction of mu times the normal impulse, and nothing
bounces.  The impulses are found one contact after the other, again and again (Gauss and Seidel, with over-relaxation).  A row
has the places at the end of its step, and the impulses divided by the time step.
"""
import json
from math import hypot

RADIUS = 1.0
RELAXATION = 1.75    # of the changes in a sweep
ACCURACY = 1e-11     # of an impulse, over the largest one
MOST_SWEEPS = 2000   # after which bodies stay where they are, because they jam


class Body:
    """Place, angle (counter-clockwise) and their rates; a wall has no inverse mass."""

    def __init__(self, x, y, inverse_mass=0.0, inverse_inertia=0.0, vy=0.0):
        self.x, self.y, self.angle, self.vx, self.vy, self.spin = x, y, 0.0, 0.0, vy, 0.0
        self.inverse_mass, self.inverse_inertia = inverse_mass, inverse_inertia

    def move(self, dt):
        self.x, self.y, self.angle = self.x + self.vx * dt, self.y + self.vy * dt, self.angle + self.spin * dt


class Contact:
    """Two bodies with the normal from the second to the first, the tangent (-ny, nx), and the impulses of the last step."""

    def __init__(self, one, two, friction, normal=None):
        self.one, self.two, self.friction, self.fixed = one, two, friction, normal
        self.normal = self.tangential = 0.0
        masses = one.inverse_mass + two.inverse_mass
        arm = RADIUS if normal else 2.0 * RADIUS  # a wall has no arm
        spins = RADIUS**2 * (one.inverse_inertia + two.inverse_inertia)
        self.reach, self.response, self.turning_response = arm, masses, masses + spins

    def begin(self, dt):
        """Finds normal and gap at the beginning of a step, and applies the impulses of the step before as a first guess."""
        dx, dy = self.one.x - self.two.x, self.one.y - self.two.y
        distance = self.fixed[1] * dy if self.fixed else hypot(dx, dy)
        self.nx, self.ny = self.fixed or (dx / distance, dy / distance)
        self.closing = (distance - self.reach) / dt  # the speed that may close the gap
        self.apply(self.normal, self.tangential)

    def apply(self, normal, tangential):
        fx, fy = normal * self.nx - tangential * self.ny, normal * self.ny + tangential * self.nx
        for body, sign in (self.one, 1.0), (self.two, -1.0):
            body.vx += sign * fx * body.inverse_mass
            body.vy += sign * fy * body.inverse_mass
            body.spin -= RADIUS * tangential * body.inverse_inertia

    def correct(self):
        """Changes the impulses to what this contact needs now, and returns the size of the change."""
        one, two = self.one, self.two
        vx, vy = one.vx - two.vx, one.vy - two.vy
        parting = self.nx * vx + self.ny * vy
        sliding = self.nx * vy - self.ny * vx - RADIUS * (one.spin + two.spin)
        normal = max(0.0, self.normal - RELAXATION * (parting + self.closing) / self.response)
        limit = self.friction * normal
        tangential = max(-limit, min(limit, self.tangential - RELAXATION * sliding / self.turning_response))
        changes = normal - self.normal, tangential - self.tangential
        self.normal, self.tangential = normal, tangential
        self.apply(*changes)
        return abs(changes[0]) + abs(changes[1])


def stack(task, write):
    """Compresses the stack from the first step on, and writes the rows that are asked for."""
    bodies = [Body(task[f"initial_x{number}"], task[f"initial_y{number}"], 1.0 / body["mass"], 1.0 / body["moment_of_inertia"])
              for number, body in enumerate(task["bodies"], 1)]
    top, right, left = bodies
    dt = task["time_step"]
    floor, wall = Body(0.0, 0.0), Body(0.0, top.y + RADIUS, vy=-task["wall_speed"])
    pairs = [Contact(*two, task["cylinder_friction"]) for two in ((top, right), (top, left), (right, left))]
    supports = [Contact(body, floor, task["floor_friction"], (0.0, 1.0)) for body in (right, left)]
    press = Contact(top, wall, 0.0, (0.0, -1.0))
    contacts = [press, *pairs, *supports]
    write("step,time,wall_force,x1,y1,theta1,x2,y2,theta2,x3,y3,theta3,floor_n2,floor_t2,floor_n3,floor_t3")
    sweeps = MOST_SWEEPS
    for step in range(task["compression_steps"] + 1):
        if step > 0:
            for body in bodies:
                body.vy -= task["gravity"] * dt
            for contact in contacts:
                contact.begin(dt)
            for _ in range(sweeps):
                change = max(contact.correct() for contact in contacts)
                if change <= ACCURACY * max(contact.normal for contact in contacts):
                    sweeps = MOST_SWEEPS
                    break
            else:  # nobody waits for a jam twice
                sweeps = 10
                for body in bodies:
                    body.vx = body.vy = body.spin = 0.0
            for body in (*bodies, wall):
                body.move(dt)
        # The tangent of the floor is (-1, 0).
        write(step, step * dt, press.normal / dt, *(value for body in bodies for value in (body.x, body.y, body.angle)),
              *(value for own in supports for value in (own.normal / dt, -own.tangential / dt)))


if __name__ == "__main__":
    with open("task.json") as file:
        parameters = json.load(file)
    if others := set(parameters["features"]) - {"friction"}:
        raise SystemExit(f"features: {others} are not in this code")
    with open("result.csv", "w") as out:
        stack(parameters, lambda *row: print(*row, sep=",", file=out))
