"""Where three rigid disks slide apart, by a solver of another kind.

Siconos (Debian: python3-siconos) steps rigid bodies with Signorini's condition and Coulomb friction as inequalities, without
any stiffness, by the Moreau-Jean scheme.  Two disks lie on the floor, one on top of them, and the force on the top one grows from
nothing.  Prints, for each friction of the floor, the last force at which the floor sticks and the first one at which both
bottom disks slide and keep sliding:

    /usr/bin/python3 reference/witness/siconos_stack.py > reference/witness/siconos.csv

Units: mass, radius and weight of a disk are 1; the friction between disks is 0.7.
"""

import os
import subprocess
import sys

# The matrices are small: more threads only wait for one another.
os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy
import siconos.kernel as kernel
import siconos.numerics as numerics
from siconos.mechanics.collision.bodies import Disk, DiskDiskR, DiskPlanR

DISK_FRICTION = 0.7
STEP = 0.002
# Floor friction, and the growth of the force in a step.
CASES = [(0.12, 4e-5), (0.2, 2e-4), (0.25, 1e-3)]
# A disk that has moved so far slides.
MOVED = 1e-4
# Relative distance from Coulomb's limit at which a contact slides.
AT_LIMIT = 1e-6


def pull(disk, force):
    """Sets the force on a disk, downwards."""
    disk.setFExtPtr(numpy.array([0.0, -force, 0.0]))


def stack(floor_friction):
    """The simulation, the disks, and the two contacts with the floor."""
    places = [(0.0, 1.0 + 3**0.5), (1.0, 1.0), (-1.0, 1.0)]
    disks = [Disk(1.0, 1.0, numpy.array([x, y, 0.0]), numpy.zeros(3)) for x, y in places]
    for disk in disks:
        pull(disk, 1.0)
    model = kernel.NonSmoothDynamicalSystem(0.0, 1e9)
    for disk in disks:
        model.insertDynamicalSystem(disk)
    between = kernel.NewtonImpactFrictionNSL(0.0, 0.0, DISK_FRICTION, 2)
    beneath = kernel.NewtonImpactFrictionNSL(0.0, 0.0, floor_friction, 2)
    for first, second in [(0, 1), (0, 2), (1, 2)]:
        contact = kernel.Interaction(between, DiskDiskR(1.0, 1.0))
        model.link(contact, disks[first], disks[second])
    floor = []
    for disk in disks[1:]:
        # Radius, the plane A x + B y + C = 0, a point of it and its width (0: unlimited).
        contact = kernel.Interaction(beneath, DiskPlanR(1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0))
        model.link(contact, disk)
        floor.append(contact)
    solver = kernel.FrictionContact(2, numerics.SICONOS_FRICTION_2D_NSGS)
    solver.numericsSolverOptions().iparam[0] = 100000
    solver.numericsSolverOptions().dparam[0] = 1e-13
    simulation = kernel.TimeStepping(
        model, kernel.TimeDiscretisation(0.0, STEP), kernel.MoreauJeanOSI(0.5000001), solver
    )
    return simulation, disks, floor


def onset(floor_friction, growth):
    """The last force at which a contact with the floor sticks before both disks move."""
    simulation, disks, floor = stack(floor_friction)
    sticking = force = 0.0
    while True:
        pull(disks[0], 1.0 + force)
        simulation.computeOneStep()
        impulses = [contact.lambda_(1) for contact in floor]
        slides = all(abs(t) >= floor_friction * n * (1.0 - AT_LIMIT) for n, t in impulses)
        if not slides:
            sticking = force
        if all(abs(abs(disk.q()[0]) - 1.0) > MOVED for disk in disks[1:]):
            return sticking
        simulation.nextStep()
        force += growth


def main():
    query = ["dpkg-query", "--show", "--showformat=${Package} ${Version}", "python3-siconos"]
    print("# " + subprocess.run(query, capture_output=True, text=True, check=True).stdout)
    print("mu,growth,sticks_at,slides_at")
    for floor_friction, growth in CASES:
        sticking = onset(floor_friction, growth)
        print(f"{floor_friction},{growth},{sticking:.6f},{sticking + growth:.6f}")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
