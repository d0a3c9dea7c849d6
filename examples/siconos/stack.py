"""The stack of three rigid cylinders by Siconos: reads task.json, steps, writes result.csv.

Lengths in r, masses in m, forces in m g.  In step s the discs move from the places of row s - 1 to those of row s; the
row has the impulses of this step over the time step, and the places at its end.
"""
import json

import siconos.kernel as kernel
import siconos.numerics as numerics
from siconos.mechanics.collision.bodies import Disk, DiskDiskR, DiskPlanR

TOLERANCE = 1e-13     # of the contact solver
MOST_SWEEPS = 100000
NEAR = 1e-4           # gap, in r, up to which a contact is one: it may be a rounding above zero
WALL = 1000.0, 1e12   # radius and mass of the top wall, a disc that nothing slows down
WIDE = 200.0          # width of the floor

with open("task.json") as file:
    task = json.load(file)
if others := set(task["features"]) - {"friction"}:
    raise SystemExit(f"features: {others} are not in this code")

dt, steps = task["time_step"], task["compression_steps"]
scene = kernel.NonSmoothDynamicalSystem(0.0, dt * (steps + 2))
discs = []
for number, body in enumerate(task["bodies"], 1):
    # A Disk has the moment of inertia m r^2 / 2, as the bodies of the task.
    disc = Disk(body["radius"], body["mass"], [task[f"initial_x{number}"], task[f"initial_y{number}"], 0.0], [0.0, 0.0, 0.0])
    disc.setFExtPtr([0.0, -body["mass"] * task["gravity"], 0.0])
    discs.append(disc)
radius, mass = WALL
height = task["initial_y1"] + task["radius"]
wall = Disk(radius, mass, [0.0, height + radius, 0.0], [0.0, -task["wall_speed"], 0.0])
for disc in (*discs, wall):
    scene.insertDynamicalSystem(disc)


def contact(relation, friction, *bodies):
    interaction = kernel.Interaction(kernel.NewtonImpactFrictionNSL(0.0, 0.0, friction, 2), relation)
    scene.link(interaction, *bodies)
    return interaction


one, two, three = discs
r = task["radius"]
pairs = [contact(DiskDiskR(r, r), task["cylinder_friction"], *pair) for pair in ((one, two), (one, three), (two, three))]
press = contact(DiskDiskR(r, radius), 0.0, one, wall)
# Without the last three numbers DiskPlanR ends some radii from the origin, and a disc beyond touches its end (Siconos 4.4).
floor = [contact(DiskPlanR(r, 0.0, 1.0, 0.0, 0.0, 0.0, WIDE), task["floor_friction"], disc) for disc in (two, three)]

scheme = kernel.MoreauJeanOSI(1.0)
scheme.setConstraintActivationThreshold(NEAR)
solver = kernel.FrictionContact(2, numerics.SICONOS_FRICTION_2D_NSGS)
options = solver.numericsSolverOptions()
options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = MOST_SWEEPS
options.dparam[numerics.SICONOS_DPARAM_TOL] = TOLERANCE
simulation = kernel.TimeStepping(scene, kernel.TimeDiscretisation(0.0, dt), scheme, solver)
simulation.setNewtonOptions(kernel.SICONOS_TS_LINEAR)  # the geometry is that of the beginning of the step


def row(step, wall_force, supports):
    places = [value for disc in discs for value in disc.q()]
    values = [step * dt, wall_force, *places, *supports]
    print(step, *(repr(float(value)) for value in values), sep=",", file=out)


with open("result.csv", "w") as out:
    print("step,time,wall_force,x1,y1,theta1,x2,y2,theta2,x3,y3,theta3,floor_n2,floor_t2,floor_n3,floor_t3", file=out)
    row(0, 0.0, [0.0] * 4)
    for step in range(1, steps + 1):
        simulation.computeOneStep()
        # The tangent of the floor points to the left.
        supports = [part for own in floor for part in (own.lambda_(1)[0] / dt, -own.lambda_(1)[1] / dt)]
        row(step, press.lambda_(1)[0] / dt, supports)
        simulation.nextStep()
