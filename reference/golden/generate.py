#!/usr/bin/env python3
"""Golden values for the theory of the three-cylinder stack.

What   Four tables, written beside this file; every number is good to the 20
       significant digits printed:
         small_displacement.csv  the paper's small-displacement theory
         quasistatic.csv         exact quasi-static limit of the DEM, arms 0, 0
         arms.csv                the same limit with any pair of arms
         separate_arms.csv       the same with torque arms and kinematic arms apart
How    From the equations of equilibrium alone, by routes that a program would
       not take, so that agreement means something:
         elastic      Newton on the five equations of equilibrium in the five
                      displacements and forces, not z = D E (which only says
                      where to start and which root is meant)
         quasistatic  Taylor series of the path G(T), summed by a recurrence;
                      checked by a double quadrature in the angle psi
         arms         one ordinary differential equation dG/dT, extrapolated
                      midpoint steps; checked by a second resolution, by the
                      quasistatic table, and by a follower that only adds up
                      spring increments and never differentiates anything
Units  r = m = k_n = 1, epsilon = 1/stiffness, forces F = f/(m g).
Inputs mu, stiffness and kappa are the doubles nearest to what is printed. In
       the rows whose mu is the double nearest to 2 - sqrt 3, mu is 2 - sqrt 3.
Empty  No such value; the functions below say when.
Digits 60 for small_displacement and quasistatic, 40 for arms.
Run    python3 generate.py
       Two to four minutes. Needs Python >= 3.9 and mpmath (written with 1.3.0).
"""

import csv
import itertools
import time
from pathlib import Path

import mpmath
from mpmath import mp, mpf

HERE = Path(__file__).resolve().parent
DIGITS = 60
ARMS_DIGITS = 40
PRINTED = 20

MU = [0.1, 0.12, 0.15, 0.2, 0.25, "critical", 0.28, 0.3, 0.4, 0.5, 0.6, 0.7]
KAPPA = [0.5, 1, 2.5, 10]
STIFFNESS = [10, 100, 1000, 10**4, 10**6]
# Beyond the grid: so soft that a stack may not carry itself, and almost rigid.
EXTREMES = [(mu, stiffness, 2.5)
            for stiffness in (1, 10**8)
            for mu in (0.12, 0.2, 0.25, "critical", 0.28, 0.3, 0.5)]
MU_D = 0.7  # friction between the cylinders

ARMS = [(0, 0), (-0.5, -0.5), (-0.5, -1), (0, -0.5), (-1, 0)]
# Of LAMMPS pair granular, and any others; each (torque arm, kinematic arm).
SEPARATE_ARMS = [((-0.5, 0), (0, 0)), ((0, -0.5), (0, 0)), ((0, 0), (-0.5, 0)), ((0, 0), (0, -0.5)),
                 ((-0.5, 0.25), (-1, -0.5))]
SEPARATE_STACKS = [(stiffness, kappa, mu) for stiffness, kappa in ((100, 2.5), (10**4, 2.5), (1000, 1.5))
                   for mu in (0.2, 0.3)]
ARMS_MU = [0.12, 0.2, 0.25, "critical", 0.3, 0.4, 0.5]
ARMS_GRIDS = [  # (stiffness, kappa, mu)
    ([100, 1000, 10**4], [2.5], ARMS_MU),
    ([10, 10**6], [2.5], [0.2, "critical", 0.3, 0.5]),
    ([100], [1.5, 5], [0.2, "critical", 0.3, 0.5]),
]


# --- numbers in, numbers out ------------------------------------------------

def mu_c():
    """Critical friction, 2 - sqrt 3 = tan 15 deg."""
    return 2 - mp.sqrt(3)


def friction(mu):
    return mu_c() if mu == "critical" else mpf(mu)


def label(value):
    """An input as it stands in the table: the shortest decimal of its double."""
    if value == "critical":
        # The nearest double; 2.0 - sqrt(3.0) in doubles is another one.
        return f"{float(mu_c()):.17f}"
    return repr(value)


def text(value):
    return "" if value is None else mp.nstr(value, PRINTED, strip_zeros=False)


def write(name, columns, rows):
    with open(HERE / name, "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(columns)
        table.writerows(rows)
    print(f"{name}: {len(rows)} rows")


def bracketed_root(function, low, high):
    """The root in [low, high], where function changes sign (Illinois rule)."""
    f_low, f_high = function(low), function(high)
    tolerance = mpf(10) ** (5 - mp.dps) * (abs(low) + abs(high))
    while abs(high - low) > tolerance:
        middle = (low * f_high - high * f_low) / (f_high - f_low)
        f_middle = function(middle)
        if f_middle == 0 or abs(middle - high) < tolerance:
            return middle
        if (f_middle > 0) != (f_high > 0):
            low, f_low = high, f_high
        else:
            f_low /= 2
        high, f_high = middle, f_middle
    return high


# --- 1. the paper's small-displacement theory -------------------------------

def rigid(mu):
    """F of rigid cylinders: e = mu_c (F + 1)/2 against mu d = mu (F + 3)/2."""
    if mu >= mu_c():
        return None  # infinite
    return max(mpf(0), (3 * mu - mu_c()) / (mu_c() - mu))


def slip_displacement(mu, alpha, kappa):
    """Right-hand side D E of the elastic equation z = D(mu, alpha) E(mu, alpha)."""
    tau = mu / (1 - alpha)  # = tan(psi/2)
    return ((tau**2 + 2 * mp.sqrt(3) * tau - 1) / (mu * (1 + tau**2))
            / (1 + kappa * (1 + tau**2)))


def naive(mu, epsilon, kappa):
    """F of the leading order of z in epsilon; none where that is below F = 0."""
    if mu < mu_c():
        z = mu_c() * epsilon / (mu_c() - mu)
    elif mu == mu_c():
        z = mp.sqrt(epsilon / (mu_c() * (1 + 4 * kappa * mu_c())))
    else:
        z = slip_displacement(mu, 0, kappa)
    return 2 * z / epsilon - 3 if z >= 3 * epsilon / 2 else None


def phi(mu, kappa):
    """(D E - z_star)/alpha at the alpha that the rigid limit selects."""
    if mu < mu_c():
        alpha = 1 - mu / mu_c()
        return (slip_displacement(mu, alpha, kappa)
                - slip_displacement(mu, 0, kappa)) / alpha
    return mp.diff(lambda alpha: slip_displacement(mu, alpha, kappa), 0)


def perturbation(mu, epsilon, kappa):
    """F from z (z - z_star) = epsilon Phi; none if complex or negative."""
    z_star = mpf(0) if mu == mu_c() else slip_displacement(mu, 0, kappa)
    square = z_star**2 + 4 * epsilon * phi(mu, kappa)
    if square < 0:
        return None
    force = (z_star + mp.sqrt(square)) / epsilon - 3
    return force if force >= 0 else None


def quintic(mu, epsilon, kappa):
    """Coefficients, highest first, of z = D E cleared of its denominators.

    With w = z (1 - alpha) = z - epsilon:
    mu z (w^2 + mu^2 z^2)(w^2 + kappa (w^2 + mu^2 z^2))
        = w^2 (mu^2 z^2 + 2 sqrt3 mu w z - w^2).
    """
    z, w = [mpf(0), mpf(1)], [-epsilon, mpf(1)]
    ww, zz, wz = multiply(w, w), multiply(z, z), multiply(w, z)
    both = add(ww, scale(mu**2, zz))
    left = multiply(scale(mu, z), multiply(both, add(ww, scale(kappa, both))))
    right = multiply(ww, add(scale(mu**2, zz), scale(2 * mp.sqrt(3) * mu, wz),
                             scale(-1, ww)))
    return list(reversed(add(left, scale(-1, right))))


def multiply(p, q):
    product = [mpf(0)] * (len(p) + len(q) - 1)
    for (i, a), (j, b) in itertools.product(enumerate(p), enumerate(q)):
        product[i + j] += a * b
    return product


def add(*terms):
    return [sum(column) for column in itertools.zip_longest(*terms, fillvalue=mpf(0))]


def scale(factor, p):
    return [factor * a for a in p]


def admissible_roots(mu, epsilon, kappa):
    """Real roots z >= 3 epsilon/2 (F >= 0), ascending."""
    # In units of epsilon the small roots are O(1), which polyroots likes better.
    coefficients = [c * epsilon ** (5 - i)
                    for i, c in enumerate(quintic(mu, epsilon, kappa))]
    largest = max(abs(c) for c in coefficients)
    roots = mp.polyroots([c / largest for c in coefficients],
                         maxsteps=500, extraprec=400)
    real = [epsilon * r.real for r in roots if abs(r.imag) < mpf(10) ** -30 * abs(r)]
    return sorted(z for z in real if z >= 3 * epsilon / 2)


def equilibrium(unknowns, mu, epsilon, kappa):
    """Residuals of the paper's model at slip; forces in k_n r, f in m g."""
    delta11, delta21, delta22, theta, force = unknowns
    relative = (-1 - delta22, mp.sqrt(3) + delta21 - delta11)  # r_1 - r_2
    distance = mp.hypot(*relative)
    n = (relative[0] / distance, relative[1] / distance)
    t = (n[1], -n[0])
    delta12 = (delta22, delta11 - delta21)
    a = delta12[0] * n[0] + delta12[1] * n[1]
    b = (delta12[0] * t[0] + delta12[1] * t[1] - theta) / kappa
    d = delta21
    e = (delta22 + theta) / kappa
    return [
        b - e,                                              # torque on 2
        a * n[0] + b * t[0] + e,                            # horizontal, 2
        2 * (a * n[1] + b * t[1]) - epsilon * (force + 1),  # vertical, 1
        d - a * n[1] - b * t[1] - epsilon,                  # vertical, 2
        e - mu * d,                                         # slip at the floor
    ]


def newton(function, start):
    """Newton's method in several unknowns with a forward-difference Jacobian."""
    point = list(start)
    for _ in range(60):
        residual = function(point)
        jacobian = mp.matrix(len(point))
        for j, value in enumerate(point):
            step = mpf(10) ** (-mp.dps // 2) * (abs(value) + mpf(10) ** -20)
            moved = function([v + step if k == j else v for k, v in enumerate(point)])
            for i in range(len(point)):
                jacobian[i, j] = (moved[i] - residual[i]) / step
        change = mp.lu_solve(jacobian, mp.matrix(residual))
        point = [v - c for v, c in zip(point, change)]
        if all(abs(c) <= mpf(10) ** -45 * (abs(v) + mpf(10) ** -30)
               for v, c in zip(point, change)):
            return point
    raise ArithmeticError("Newton did not converge")


def start_of_newton(z, mu, epsilon, kappa):
    """Displacements that belong to a root z, deliberately a little off."""
    psi = 2 * mp.atan(mu / (1 - epsilon / z))
    distance = mp.sin(psi) + mp.sqrt(3) * mp.cos(psi) - (z - epsilon)
    y = distance * mp.sin(psi) - 1
    x = mp.sqrt(3) - distance * mp.cos(psi)
    theta = mu * kappa * z - y
    off = 1 + mpf(10) ** -9
    return [x + z * off, z * off, y * off, theta * off, (2 * z / epsilon - 3) * off]


def elastic(mu, epsilon, kappa):
    """[F, x, y, z, theta] of the largest admissible root; empty if there is none."""
    roots = admissible_roots(mu, epsilon, kappa)
    if not roots:
        return [None] * 5
    delta11, z, y, theta, force = newton(
        lambda unknowns: equilibrium(unknowns, mu, epsilon, kappa),
        start_of_newton(roots[-1], mu, epsilon, kappa))
    if abs(z / roots[-1] - 1) > mpf(10) ** -30:
        raise ArithmeticError("Newton left the root it started from")
    return [force, delta11 - z, y, z, theta]


def cases():
    grid = [(mu, stiffness, kappa) for kappa in KAPPA
            for stiffness in STIFFNESS for mu in MU]
    return grid + EXTREMES


def small_displacement():
    rows = []
    for mu, stiffness, kappa in cases():
        model = friction(mu), 1 / mpf(stiffness), mpf(kappa)
        values = [rigid(model[0]), naive(*model), perturbation(*model), *elastic(*model)]
        rows.append([label(mu), label(stiffness), label(kappa), *map(text, values)])
    columns = ("mu stiffness kappa rigid naive perturbation elastic "
               "elastic_x elastic_y elastic_z elastic_theta")
    write("small_displacement.csv", columns.split(), rows)


# --- 2. exact quasi-static limit, arms 0, 0 ---------------------------------

class Path:
    """Overlap G of contact 1-2 along T = tan(psi/2), from G(mu_c) = 0.

    With equal arms b = e, b = a T and 2 a = load on 1. The two tangential
    springs added, so that the rotation drops out, and x_2 = (2 - G) sin psi:
        2 kappa d(G T) = (2 - G) dpsi + d((2 - G) sin psi),
    hence, with dpsi = 2 dT/(1 + T^2),
        T (1 + T^2)(1 + kappa (1 + T^2)) G' = 4 - (2 + kappa (1 + T^2)^2) G,
    a recurrence for the Taylor coefficients of G about any T.
    """

    TERMS = 90

    def __init__(self, kappa):
        self.kappa = kappa
        self.origins, self.series = [mu_c()], []
        value = mpf(0)
        while self.origins[-1] < 1:
            origin = self.origins[-1]
            self.series.append(self.taylor(origin, value))
            # The nearest singularity is T = 0: a fifth of the radius of
            # convergence makes 90 terms worth 62 digits.
            self.origins.append(origin * mpf(6) / 5)
            value = self.overlap(self.origins[-1])

    def taylor(self, origin, value):
        kappa = self.kappa
        p = shifted([0, 1 + kappa, 0, 1 + 2 * kappa, 0, kappa], origin)
        q = shifted([2 + kappa, 0, 2 * kappa, 0, kappa], origin)
        g = [value]
        for n in range(self.TERMS):
            right = mpf(4 if n == 0 else 0)
            right -= sum(q[k] * g[n - k] for k in range(min(n, 4) + 1))
            right -= sum(p[k] * (n + 1 - k) * g[n + 1 - k] for k in range(1, min(n, 5) + 1))
            g.append(right / (p[0] * (n + 1)))
        return g

    def overlap(self, tangent):
        leg = 0
        while leg + 1 < len(self.series) and tangent > self.origins[leg + 1]:
            leg += 1
        return mp.polyval(self.series[leg][::-1], tangent - self.origins[leg])


def shifted(p, origin):
    """Coefficients in u of the polynomial p(origin + u), lowest first."""
    result = [mpf(0)]
    for coefficient in reversed(p):
        result = add(multiply(result, [origin, mpf(1)]), [mpf(coefficient)])
    return result[:len(p)]


def overlap_by_quadrature(kappa, tangent):
    """G again, as a check: with h = 2 kappa T + sin psi the path reads
    d(h G)/dpsi = 2 (1 + cos psi) - (h G)/h, integrated in psi twice over."""
    def h(psi):
        return 2 * kappa * mp.tan(psi / 2) + mp.sin(psi)

    end = 2 * mp.atan(tangent)

    def damped(psi):
        return 2 * (1 + mp.cos(psi)) * mp.exp(-mp.quad(lambda s: 1 / h(s), [psi, end]))

    return mp.quad(damped, [mp.pi / 6, end]) / h(end)


def check_path(paths):
    """Largest relative difference between the Taylor series and the quadrature."""
    worst = mpf(0)
    with mp.workdps(35):
        for kappa, path in paths.items():
            for tangent in (mpf("0.268"), mpf("0.3"), mpf("0.55"), mpf(1)):
                other = overlap_by_quadrature(mpf(kappa), tangent)
                worst = max(worst, abs(path.overlap(tangent) / other - 1))
    print("quasistatic: Taylor series against quadrature, largest relative difference",
          mp.nstr(worst, 3))
    if worst > mpf(10) ** -25:
        raise ArithmeticError("the two ways to G(T) disagree")


def sine(tangent):
    return 2 * tangent / (1 + tangent**2)


def cosine(tangent):
    return (1 - tangent**2) / (1 + tangent**2)


class Landscape:
    """A path sampled finely, to find the first crossing of anything along it."""

    SAMPLES = 400

    def __init__(self, path):
        self.path = path
        self.tangents = [mu_c() + (1 - mu_c()) * i / self.SAMPLES
                         for i in range(self.SAMPLES + 1)]
        self.overlaps = [path.overlap(tangent) for tangent in self.tangents]

    def first_positive(self, function, start):
        """First T >= start from which function(T, G) > 0; None if there is none."""
        def along(tangent):
            return function(tangent, self.path.overlap(tangent))

        if along(start) > 0:
            return start
        previous = start
        for tangent, overlap in zip(self.tangents, self.overlaps):
            if tangent <= start:
                continue
            if function(tangent, overlap) > 0:
                return bracketed_root(along, previous, tangent)
            previous = tangent
        return None


def floor_slip(land, mu, epsilon):
    """T of floor slip in compression, e = mu d; None if never, or if F would be
    negative there: then the stack slides under its own weight."""
    # T (F + 1) = mu (F + 3) with F + 1 = 2 G/epsilon.
    tangent = land.first_positive(lambda T, G: G * (T - mu) - epsilon * mu, max(mu, mu_c()))
    if tangent is None or tangent >= 1 or tangent > 3 * mu:
        return None
    return tangent


def contact_closes(land):
    """T from which x_2 < 1, that is contact 2-3 is pressed.

    At the start dx_2/dT = sqrt3/(2 mu_c) - 1/(2 mu_c^2 (1 + 4 kappa mu_c)), so
    that x_2 shrinks at once if kappa < 1/2 + 1/sqrt 3 = 1.0773502691896258.
    """
    if land.path.kappa < mpf(1) / 2 + 1 / mp.sqrt(3):
        return mu_c()
    just_after = mu_c() + mpf(10) ** -6  # x_2 = 1 exactly at the start
    return land.first_positive(lambda T, G: 1 - (2 - G) * sine(T), just_after)


def wall_contact(land, epsilon):
    """T at which the top wall, at y_1 + 1 - epsilon F, reaches y_2 + 1.

    During the ramp epsilon F = 2 G - epsilon is negative, and so no contact."""
    return land.first_positive(
        lambda T, G: 2 * G - epsilon - (2 - G) * cosine(T), mu_c())


def own_weight(land, mu, epsilon):
    """T at which the stack slides during the gravity ramp (e = mu d at F = 0
    means T = 3 mu); None if gravity is up before that."""
    gravity_is_up = land.first_positive(lambda T, G: G - epsilon / 2, mu_c())
    if gravity_is_up is not None and gravity_is_up <= 3 * mu:
        return None
    return 3 * mu if 3 * mu < 1 else None


def first_event(land, mu, epsilon, slip):
    events = {
        "contact-closes": contact_closes(land),
        "own-weight": own_weight(land, mu, epsilon),
        "cylinder-slip": mpf(MU_D),
        "wall-contact": wall_contact(land, epsilon),
        "floor-slip": slip,
    }
    return min((T, name) for name, T in events.items() if T is not None)[1]


def quasistatic():
    paths = {kappa: Path(mpf(kappa)) for kappa in KAPPA}
    check_path(paths)
    lands = {kappa: Landscape(path) for kappa, path in paths.items()}
    rows = []
    for mu, stiffness, kappa in cases():
        land, m, epsilon = lands[kappa], friction(mu), 1 / mpf(stiffness)
        slip = floor_slip(land, m, epsilon)
        force = y = None
        if slip is not None:
            overlap = land.path.overlap(slip)
            force, y = 2 * overlap / epsilon - 1, (2 - overlap) * sine(slip) - 1
        rows.append([label(mu), label(stiffness), label(kappa), label(MU_D),
                     text(force), text(slip), text(y),
                     first_event(land, m, epsilon, slip)])
    write("quasistatic.csv",
          "mu stiffness kappa mu_d floor_slip_force T y event".split(), rows)


# --- 3. any torque arms -----------------------------------------------------

class Stack:
    """Equilibrium with torque arms R_c = 1 + pair G and R_f = 1 + floor z, and
    springs that grow with kinematic arms S_c and S_f of the same form.

    b R_c = e R_f and -a sin psi + b cos psi + e = c give, with a = G,
        b = N R_f, e = N R_c, N = (G sin psi + c)/W, W = R_f cos psi + R_c,
    and the load on cylinder 1, L = 2 (a cos psi + b sin psi), becomes
        P(L, G, psi) = L W - 2 G (R_c cos psi + R_f) - 2 c R_f sin psi = 0,
    with c = 2 (1 - x_2) where contact 2-3 is closed, and c = 0 where it is open.
    The floor carries z = slope L + offset: 3 L/2 while gravity is raised
    (three equal weights), L/2 + epsilon under compression.
    """

    def __init__(self, epsilon, kappa, pair_arm, floor_arm, kinematic_arms=None):
        self.epsilon, self.kappa = epsilon, kappa
        self.pair, self.floor = pair_arm, floor_arm
        self.kinematic = kinematic_arms or (pair_arm, floor_arm)
        self.closed = False
        self.ramp()

    def ramp(self):
        self.slope, self.offset = mpf(3) / 2, mpf(0)

    def compression(self):
        self.slope, self.offset = mpf(1) / 2, self.epsilon

    def bottom_force(self, T, G):
        """c, and its derivatives in G and psi; x_2 < 1 where the contact is closed."""
        if not self.closed:
            return mpf(0), mpf(0), mpf(0)
        return 2 - 2 * (2 - G) * sine(T), 2 * sine(T), -2 * (2 - G) * cosine(T)

    def load(self, T, G):
        """L from P = 0, a quadratic in L; the root that is 2 G with equal arms and c = 0."""
        c = cosine(T)
        r_c = 1 + self.pair * G
        arm = 1 + self.floor * self.offset       # R_f at L = 0
        growth = self.floor * self.slope         # dR_f/dL
        pushed = 2 * self.bottom_force(T, G)[0] * sine(T)
        linear = arm * c + r_c - (2 * G + pushed) * growth
        constant = 2 * G * (r_c * c + arm) + pushed * arm
        root = mp.sqrt(linear**2 + 4 * growth * c * constant)
        return 2 * constant / (linear + root)

    def forces(self, T, G, load):
        """z, R_c, R_f, b, e."""
        z = self.slope * load + self.offset
        r_c, r_f = 1 + self.pair * G, 1 + self.floor * z
        n = (G * sine(T) + self.bottom_force(T, G)[0]) / (r_f * cosine(T) + r_c)
        return z, r_c, r_f, n * r_f, n * r_c

    def kinematic_arms(self, G, z):
        """S_c, S_f."""
        pair, floor = self.kinematic
        return 1 + pair * G, 1 + floor * z

    def floor_slip(self, T, G, mu):
        """e - mu d, positive beyond floor slip."""
        z, _, _, _, e = self.forces(T, G, self.load(T, G))
        return e - mu * z

    def derivative(self, T, G):
        """dG/dT. The rotation drops out of
            kappa db = rho dpsi - S_c dtheta,  kappa de = dx_2 + S_f dtheta
        as kappa (S_f db + S_c de) = S_f rho dpsi + S_c dx_2, x_2 = rho sin psi.
        Every differential below is a pair (its part in dG, its part in dpsi).
        """
        s, c, rho, load = sine(T), cosine(T), 2 - G, self.load(T, G)
        z, r_c, r_f, _, _ = self.forces(T, G, load)
        s_c, s_f = self.kinematic_arms(G, z)
        between, between_g, between_psi = self.bottom_force(T, G)
        growth = self.floor * self.slope
        w = r_f * c + r_c
        n = (G * s + between) / w
        p_load = w + load * growth * c - 2 * (G + between * s) * growth
        d_load = ((2 * (r_c * c + r_f) + 2 * G * self.pair * c - load * self.pair
                   + 2 * between_g * r_f * s) / p_load,
                  ((load * r_f - 2 * G * r_c) * s
                   + 2 * r_f * (between_psi * s + between * c)) / p_load)
        d_rf = (growth * d_load[0], growth * d_load[1])
        d_w = (c * d_rf[0] + self.pair, c * d_rf[1] - r_f * s)
        d_n = ((s + between_g - n * d_w[0]) / w, (G * c + between_psi - n * d_w[1]) / w)
        arms = s_f * r_f + s_c * r_c
        d_arms = (s_f * d_rf[0] + s_c * self.pair, s_f * d_rf[1])
        in_overlap = self.kappa * (n * d_arms[0] + arms * d_n[0]) + s_c * s
        in_angle = rho * (s_f + s_c * c) - self.kappa * (n * d_arms[1] + arms * d_n[1])
        return in_angle / in_overlap * 2 / (1 + T**2)


def extrapolated_step(function, T, G, step, columns):
    """G after one step: modified midpoint rule with 2, 4, 6, ... substeps,
    extrapolated to infinitely many (Gragg, Bulirsch, Stoer)."""
    row = []
    for j in range(1, columns + 1):
        h = step / (2 * j)
        before, here = G, G + h * function(T, G)
        for i in range(1, 2 * j):
            before, here = here, before + 2 * h * function(T + i * h, here)
        new = [(before + here + h * function(T + step, here)) / 2]
        for k, old in enumerate(row):
            ratio = mpf(j) / (j - 1 - k)
            new.append(new[k] + (new[k] - old) / (ratio**2 - 1))
        row = new
    return row[-1]


class ArmsPath:
    """The two legs of a stack's path in T, walked in extrapolated steps."""

    def __init__(self, stack, step, columns):
        self.stack, self.step, self.columns = stack, mpf(step), columns
        stack.ramp()
        T, G = self.walk(mu_c(), mpf(0), lambda T, G: stack.load(T, G) - stack.epsilon)
        stack.compression()
        self.nodes = [(T, G)]  # of the compression leg, extended when needed

    def advance(self, T, G, step):
        return extrapolated_step(self.stack.derivative, T, G, step, self.columns)

    def crossing(self, T, G, event):
        """Where event becomes zero within one step after (T, G)."""
        reached = bracketed_root(
            lambda h: event(T + h, self.advance(T, G, h) if h else G), mpf(0), self.step)
        return T + reached, self.advance(T, G, reached)

    def walk(self, T, G, event):
        """From (T, G), where event < 0, to where it vanishes."""
        while True:
            following = self.advance(T, G, self.step)
            if event(T + self.step, following) >= 0:
                return self.crossing(T, G, event)
            T, G = T + self.step, following

    def floor_slip_force(self, mu):
        """F at the first floor slip under compression; None if there is none before
        T = 1, or if the stack slides under its own weight."""
        def event(T, G):
            return self.stack.floor_slip(T, G, mu)

        if event(*self.nodes[0]) >= 0:
            return None
        index = 0
        while self.nodes[index][0] < 1:
            if index + 1 == len(self.nodes):
                T, G = self.nodes[index]
                self.nodes.append((T + self.step, self.advance(T, G, self.step)))
            if event(*self.nodes[index + 1]) >= 0:
                T, G = self.crossing(*self.nodes[index], event)
                return self.stack.load(T, G) / self.stack.epsilon - 1 if T < 1 else None
            index += 1
        return None


def follower_by_increments(stack, mu, steps):
    """Floor slip force once more, as a check: add up spring increments.

    Each leg of the path is cut into equal steps of T; arms and rho are averaged
    over a step; nothing is differentiated. The error is even in the step.
    The end of the compression leg is where floor slip is, to be found outside.
    """
    def increment(here, there):
        (T0, G0, f0), (T1, G1, f1) = here, there
        s_c, s_f = ((one + other) / 2 for one, other in zip(
            stack.kinematic_arms(G0, f0[0]), stack.kinematic_arms(G1, f1[0])))
        rho = 2 - (G0 + G1) / 2
        d_psi = 2 * (mp.atan(T1) - mp.atan(T0))
        d_x2 = (2 - G1) * sine(T1) - (2 - G0) * sine(T0)
        return (stack.kappa * (s_f * (f1[3] - f0[3]) + s_c * (f1[4] - f0[4]))
                - s_f * rho * d_psi - s_c * d_x2)

    def state(T, G):
        return T, G, stack.forces(T, G, stack.load(T, G))

    def leg(T, G, end):
        h = (end - T) / steps
        for _ in range(steps):
            here = state(T, G)
            guess = G + 3 * h
            G = mp.findroot(lambda g: increment(here, state(T + h, g)),
                            (guess, guess + h / 100), tol=mpf(10) ** -44, verify=False)
            T += h
        return G

    def to_event(T, G, event, guess):
        def miss(end):
            return event(end, leg(T, G, end))
        end = mp.findroot(miss, (guess, guess + mpf(10) ** -4),
                          tol=mpf(10) ** -40, verify=False)
        return end, leg(T, G, end)

    stack.ramp()
    T, G = to_event(mu_c(), mpf(0), lambda T, G: stack.load(T, G) - stack.epsilon,
                    mu_c() + stack.epsilon / 8)
    stack.compression()
    T, G = to_event(T, G, lambda T, G: stack.floor_slip(T, G, mu), mu + mpf("0.02"))
    return stack.load(T, G) / stack.epsilon - 1


def separate(stiffness, kappa, pair, floor):
    """A stack; pair and floor are each (torque arm, kinematic arm)."""
    return Stack(1 / mpf(stiffness), mpf(kappa), mpf(pair[0]), mpf(floor[0]),
                 (mpf(pair[1]), mpf(floor[1])))


def check_increments():
    """Extrapolate the follower by increments to step zero and compare."""
    worst = mpf(0)
    for pair, floor in [((arm, arm), (other, other)) for arm, other in ARMS] + SEPARATE_ARMS:
        stack = separate(100, 2.5, pair, floor)
        row = []
        for j, steps in enumerate((4, 8, 16, 32, 64)):
            new = [follower_by_increments(stack, mpf("0.3"), steps)]
            for k, old in enumerate(row):
                new.append(new[k] + (new[k] - old) / (4 ** (k + 1) - 1))
            row = new
        exact = ArmsPath(stack, "0.05", 14).floor_slip_force(mpf("0.3"))
        worst = max(worst, abs(row[-1] / exact - 1))
    print("arms: follower by increments, largest relative difference", mp.nstr(worst, 3))
    if worst > mpf(10) ** -9:
        raise ArithmeticError("the follower by increments disagrees")


def check_equal_arms():
    """Arms 0, 0 must give the quasistatic table."""
    worst = mpf(0)
    for kappa, stiffness in ((1, 100), (2.5, 10), (2.5, 10**4), (10, 1000)):
        land, epsilon = Landscape(Path(mpf(kappa))), 1 / mpf(stiffness)
        path = ArmsPath(Stack(epsilon, mpf(kappa), mpf(0), mpf(0)), "0.05", 14)
        for mu in (0.12, 0.25, "critical", 0.4):
            slip = floor_slip(land, friction(mu), epsilon)
            force = 2 * land.path.overlap(slip) / epsilon - 1
            worst = max(worst, abs(path.floor_slip_force(friction(mu)) / force - 1))
    print("arms: arms 0, 0 against quasistatic, largest relative difference",
          mp.nstr(worst, 3))
    if worst > mpf(10) ** -PRINTED:
        raise ArithmeticError("arms 0, 0 are not the quasistatic limit")


def arms():
    check_equal_arms()
    check_increments()
    rows, worst = [], mpf(0)
    for stiffnesses, kappas, frictions in ARMS_GRIDS:
        for kappa, stiffness, (pair, floor) in itertools.product(kappas, stiffnesses, ARMS):
            stack = Stack(1 / mpf(stiffness), mpf(kappa), mpf(pair), mpf(floor))
            fine = ArmsPath(stack, "0.05", 14)
            coarse = ArmsPath(stack, "0.06", 13)
            for mu in frictions:
                force = fine.floor_slip_force(friction(mu))
                other = coarse.floor_slip_force(friction(mu))
                worst = max(worst, abs(other / force - 1))
                rows.append([label(mu), label(stiffness), label(kappa),
                             label(pair), label(floor), text(force)])
    print("arms: coarser steps, largest relative change", mp.nstr(worst, 3))
    write("arms.csv", "mu stiffness kappa pair_arm floor_arm floor_slip_force".split(), rows)


def separate_arms():
    rows, worst = [], mpf(0)
    for (stiffness, kappa, mu), (pair, floor) in itertools.product(SEPARATE_STACKS, SEPARATE_ARMS):
        stack = separate(stiffness, kappa, pair, floor)
        force = ArmsPath(stack, "0.05", 14).floor_slip_force(friction(mu))
        other = ArmsPath(stack, "0.06", 13).floor_slip_force(friction(mu))
        worst = max(worst, abs(other / force - 1))
        rows.append([*map(label, (mu, stiffness, kappa, *pair, *floor)), text(force)])
    print("separate arms: coarser steps, largest relative change", mp.nstr(worst, 3))
    write("separate_arms.csv", "mu stiffness kappa pair_torque_arm pair_kinematic_arm "
          "floor_torque_arm floor_kinematic_arm floor_slip_force".split(), rows)


def main():
    print("mpmath", mpmath.__version__)
    for table, digits in ((small_displacement, DIGITS), (quasistatic, DIGITS),
                          (arms, ARMS_DIGITS), (separate_arms, ARMS_DIGITS)):
        started = time.time()
        with mp.workdps(digits):
            table()
        print(f"{table.__name__}: {time.time() - started:.0f} s")


if __name__ == "__main__":
    main()
