"""The stack of three rigid cylinders by MigFlow: reads task.json, steps, writes result.csv.

Lengths in r, masses in m, forces in m g.  In step s the discs move from the places of row s - 1 to those of row s; the
row has the forces of this step and the places at its end.
"""
import json

import numpy as np
from migflow import scontact

TOLERANCE = 1e-12  # of the contact solver: relative velocities, in r sqrt(g/r)
FAR = 100.0        # ends of floor and top wall

with open("task.json") as file:
    task = json.load(file)
if others := set(task["features"]) - {"friction"}:
    raise SystemExit(f"features: {others} are not in this code")

problem = scontact.ParticleProblem(2)
top = task["initial_y1"] + task["radius"]
for name, height in ("floor", 0.0), ("top", top):
    ends = [np.array([-FAR, height]), np.array([FAR, height])]
    problem.add_boundary_segment(*ends, name, name)
for number, body in enumerate(task["bodies"], 1):
    place = np.array([task[f"initial_x{number}"], task[f"initial_y{number}"]])
    inverse_inertia = 1.0 / body["moment_of_inertia"]
    problem.add_particle(place, body["radius"], body["mass"], "disc", inverse_inertia=inverse_inertia)
problem.set_friction_coefficient(task["floor_friction"], "floor", "disc")
problem.set_friction_coefficient(task["cylinder_friction"], "disc", "disc")
problem.set_friction_coefficient(0.0, "top", "disc")
problem.contact_detection_d = 0.2 * task["radius"]
problem.set_boundary_velocity("top", np.array([0.0, -task["wall_speed"]]))
weights = np.array([[0.0, -body["mass"] * task["gravity"]] for body in task["bodies"]])
floor = problem.get_tag_id("floor")


def on_floor():
    """Forces of the floor on each disc, by number."""
    forces = np.zeros((3, 2))
    for contact in problem.contacts():
        if contact["contact_type"] == 1 and problem.segments()["tag"][contact["o"][0]] == floor:
            forces[contact["o"][1]] += contact["reaction"]
    return forces


def row(step, wall, floor):
    places = zip(problem.position(), problem.body_theta()[bodies].ravel())
    bodies_in_row = [value for (x, y), angle in places for value in (x, y, angle)]
    sides = [value for number in (1, 2) for value in (floor[number][1], floor[number][0])]
    values = [step, step * task["time_step"], wall, *bodies_in_row, *sides]
    print(*(repr(float(value)) if index else value for index, value in enumerate(values)), sep=",", file=out)


bodies = problem.particle_body()
with open("result.csv", "w") as out:
    print("step,time,wall_force,x1,y1,theta1,x2,y2,theta2,x3,y3,theta3,floor_n2,floor_t2,floor_n3,floor_t3", file=out)
    row(0, 0.0, np.zeros((3, 2)))
    for step in range(1, task["compression_steps"] + 1):
        # Where the discs jam it does not converge, and the forces grow with the way of the wall.
        problem.iterate(task["time_step"], weights, tol=TOLERANCE)
        row(step, problem.get_boundary_forces("top")[1], on_floor())
