//! Setup and rigid cylinders: Eqs. (1) to (4), and the supplement's repetition of the first three.

use super::Check;
use crate::model::{CRITICAL_FRICTION, ContactConvention, Stack};
use crate::paper::claims::finding::{Finding, imbalance, relative, worst};
use crate::paper::claims::printed::PaperTheory;
use crate::paper::claims::truth::{Forces, equilibrium, pairs, turned};
use crate::theory::quasistatic_limit;
use nalgebra::{Matrix6, Vector2, Vector6};

pub(crate) const CHECKS: &[Check] = &[
    Check::theory("mass", mass),
    Check::theory("vertical-balance-of-stack", stack_balance),
    Check::theory("coulomb-slip", coulomb_slip),
    Check::theory("bottom-contact-open", bottom_contact_open),
    Check::theory("six-conditions", six_conditions),
    Check::theory("torque-balance", torque_balance),
    Check::theory("horizontal-balance", horizontal_balance),
    Check::theory("vertical-balance", vertical_balance),
    Check::theory("whose-balances", whose_balances),
    Check::theory("unit-vectors", unit_vectors),
    Check::theory("rigid-directions", rigid_directions),
    Check::theory("rigid-floor-load", rigid_floor_load),
    Check::theory("rigid-floor-shear", rigid_floor_shear),
    Check::theory("rigid-slips-at-once", slips_at_once),
    Check::theory("rigid-never-slips", never_slips),
    Check::theory("rigid-yield-force", rigid_yield_force),
    Check::theory("rigid-divergence", rigid_divergence),
    Check::theory("critical-friction", critical_friction),
    Check::theory("critical-friction-decimal", critical_friction_decimal),
];

const WEIGHT: f64 = 0.37;
const RADIUS: f64 = 1.7;
const FORCES: [f64; 5] = [0.0, 0.1, 1.0, 10.0, 1e3];
const ANGLES: [f64; 4] = [0.35, std::f64::consts::FRAC_PI_6, 0.8, 1.1];

fn direction(angle: f64) -> Vector2<f64> {
    Vector2::new(-angle.sin(), angle.cos())
}

fn upright() -> Vector2<f64> {
    direction(std::f64::consts::FRAC_PI_6)
}

/// A stack in equilibrium: the force f, the direction from cylinder 2 to 1, and the contact forces.
struct Balanced {
    f: f64,
    normal: Vector2<f64>,
    forces: Forces,
}

/// Equilibria at several angles and forces.
fn balanced() -> impl Iterator<Item = Balanced> {
    pairs(ANGLES, FORCES).filter_map(|(angle, force)| {
        let (normal, f) = (direction(angle), force * WEIGHT);
        let forces = equilibrium(normal, RADIUS, f, WEIGHT)?;
        Some(Balanced { f, normal, forces })
    })
}

const BALANCED: &str =
    "put into the balances of forces and torques on each cylinder, solved as a linear system";

fn torque_balance(paper: &PaperTheory) -> Finding {
    let deviations = balanced().map(|state| imbalance(&paper.torque_terms(&state.forces)));
    Finding::identity(deviations, BALANCED)
}

fn horizontal_balance(paper: &PaperTheory) -> Finding {
    let deviations =
        balanced().map(|state| imbalance(&paper.horizontal_terms(&state.forces, state.normal)));
    Finding::identity(deviations, BALANCED)
}

fn vertical_balance(paper: &PaperTheory) -> Finding {
    let deviations = balanced().map(|Balanced { f, normal, forces }| {
        imbalance(&paper.vertical_terms(&forces, normal, f, WEIGHT))
    });
    Finding::identity(deviations, BALANCED)
}

fn stack_balance(paper: &PaperTheory) -> Finding {
    let deviations =
        balanced().map(|state| imbalance(&paper.stack_terms(&state.forces, state.f, WEIGHT)));
    Finding::identity(deviations, BALANCED)
}

/// The vertical balance of the bottom cylinder, d = a n_y + b t_y + m g, follows from Eq. (3) together with
/// f + 3 m g = 2 d: half of one subtracted from half of the other.
fn whose_balances(paper: &PaperTheory) -> Finding {
    let deviations = balanced().map(|Balanced { f, normal, forces }| {
        let upper: f64 = paper
            .vertical_terms(&forces, normal, f, WEIGHT)
            .iter()
            .sum();
        let stack: f64 = paper.stack_terms(&forces, f, WEIGHT).iter().sum();
        let of_the_bottom = forces.d - forces.a * normal.y - forces.b * turned(normal).y - WEIGHT;
        ((of_the_bottom + 0.5 * upper + 0.5 * stack) / forces.d).abs()
    });
    let compared = "Eq. (3) is the balance of the upper cylinder, as the paper says right below it; with f + 3mg = 2d it is \
         equivalent to the vertical balance of the bottom one";
    Finding::identity(deviations, compared)
}

fn mass(paper: &PaperTheory) -> Finding {
    // Area of a disc as the extrapolated limit of inscribed polygons. Doubling their number of sides takes the
    // side s to √(2 − √(4 − s²)), without π.
    let (mut side, mut sides) = (2f64.sqrt(), 4.0);
    let mut areas = Vec::new();
    for _ in 0..12 {
        let next = side / (2.0 + (4.0 - side * side).sqrt()).sqrt();
        // The 2n-gon has the area n s_n/2.
        areas.push(sides * side / 2.0);
        (side, sides) = (next, 2.0 * sides);
    }
    let last = areas[areas.len() - 1];
    let area = last + (last - areas[areas.len() - 2]) / 3.0;
    let (density, radius, length) = (3.0, 1.7, 0.6);
    let volume = area * radius * radius * length;
    let deviation = relative(paper.mass(density, radius, length), density * volume);
    Finding::identity([deviation], "volume of a cylinder from inscribed polygons")
}

fn coulomb_slip(paper: &PaperTheory) -> Finding {
    let mut deviations = Vec::new();
    let frictions = [0.12, 0.2, CRITICAL_FRICTION, 0.3, 0.5];
    for (mu, stiffness) in pairs(frictions, [1e2, 1e3, 1e4]) {
        let limit = quasistatic_limit(&Stack::paper(mu, stiffness), &ContactConvention::PAPER);
        if let (Some(tangent), Some(z), Some(force)) =
            (limit.tangent, limit.z, limit.floor_slip_force)
        {
            let epsilon = 1.0 / stiffness;
            let shear = (z - epsilon) * tangent;
            let load = (force + paper.stack_weights) * epsilon / paper.floor_contacts;
            deviations.push(relative(shear, mu * load));
        }
    }
    let compared = "e and d = (f + 3mg)/2 of the exact quasi-static limit at yield";
    Finding::identity(deviations, compared)
}

fn bottom_contact_open(paper: &PaperTheory) -> Finding {
    let frictions = [0.12, 0.2, CRITICAL_FRICTION, 0.3, 0.4, 0.5, 0.53];
    let stiffnesses = [paper.lowest_stiffness, 1e3, paper.highest_stiffness];
    let inward = pairs(frictions, stiffnesses).map(|(mu, stiffness)| {
        let limit = quasistatic_limit(&paper.stack(mu, stiffness), &ContactConvention::PAPER);
        -limit.y.unwrap_or(f64::NAN) * stiffness
    });
    let lowest = -worst(inward);
    let evidence = format!(
        "in the exact quasi-static limit the bottom cylinders have parted at yield everywhere (mu from 0.12 to \
         0.53, 1/epsilon from 1e2 to 1e4): y/(epsilon r) is at least {lowest:.3}"
    );
    Finding::statement(lowest > 0.0, evidence)
}

/// The conditions for a, b, c, d, e, f: stack, Coulomb, c = 0, Eqs. (1) to (3).
fn conditions(paper: &PaperTheory, mu: f64) -> Matrix6<f64> {
    let (normal, tangent) = (upright(), paper.tangent(upright()));
    let (normal_y, tangent_y) = (
        paper.pair_contacts * normal.y,
        paper.pair_contacts * tangent.y,
    );
    let outward = tangent.x + paper.floor_share;
    let rows = [
        [0.0, 0.0, 0.0, -paper.floor_contacts, 0.0, 1.0],
        [0.0, 0.0, 0.0, -mu, 1.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0, -paper.torque_ratio, 0.0],
        [normal.x, outward, 0.0, 0.0, 0.0, 0.0],
        [normal_y, tangent_y, 0.0, 0.0, 0.0, -1.0],
    ];
    Matrix6::from_fn(|row, column| rows[row][column])
}

fn six_conditions(paper: &PaperTheory) -> Finding {
    let known = Vector6::new(
        -paper.stack_weights,
        0.0,
        0.0,
        0.0,
        0.0,
        paper.upper_weights,
    );
    let mut deviations = Vec::new();
    for mu in [0.1, 0.15, 0.2, 0.25] {
        let solution = conditions(paper, mu).lu().solve(&known);
        let force = solution.map_or(f64::NAN, |solution| solution[5]);
        deviations.push(relative(force, slip_force(mu)));
    }
    let singular = conditions(paper, CRITICAL_FRICTION).determinant().abs();
    deviations.push(singular);
    let compared = "six linear equations for six unknowns, solved for mu = 0.1 to 0.25; singular at mu_c alone, where f diverges";
    Finding::identity(deviations, compared)
}

/// f/(m g) at which rigid cylinders slip, by bisection of e − μ d; 0 if they slip at once, infinite if never.
fn slip_force(mu: f64) -> f64 {
    let excess = |f: f64| {
        equilibrium(upright(), RADIUS, f * WEIGHT, WEIGHT)
            .map_or(f64::NAN, |forces| forces.e - mu * forces.d)
    };
    let (mut low, mut high) = (0.0, 1e12);
    if excess(low) >= 0.0 {
        return 0.0;
    }
    if excess(high) < 0.0 {
        return f64::INFINITY;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

fn unit_vectors(paper: &PaperTheory) -> Finding {
    let deviations = ANGLES.map(|angle| {
        let normal = direction(angle);
        let tangent = paper.tangent(normal);
        worst([
            tangent.dot(&normal).abs(),
            (tangent.norm() - 1.0).abs(),
            (tangent - turned(normal)).norm(),
        ])
    });
    let compared = "length of t, its product with n, and n turned by -90 degrees";
    Finding::identity(deviations, compared)
}

fn rigid_directions(paper: &PaperTheory) -> Finding {
    // Bottom centres 2r apart, the upper one 2r from both.
    let rise = (4.0f64 - 1.0).sqrt();
    let normal = Vector2::new(-1.0, rise) / 2.0;
    let deviations = [
        (paper.rigid_normal() - normal).norm(),
        (paper.rigid_tangent() - turned(normal)).norm(),
    ];
    Finding::identity(deviations, "three touching circles of one radius")
}

fn rigid_states() -> impl Iterator<Item = (f64, Forces)> {
    FORCES.into_iter().filter_map(|force| {
        let f = force * WEIGHT;
        equilibrium(upright(), RADIUS, f, WEIGHT).map(|forces| (f, forces))
    })
}

fn rigid_floor_load(paper: &PaperTheory) -> Finding {
    let deviations =
        rigid_states().map(|(f, forces)| relative(paper.rigid_floor_load(f, WEIGHT), forces.d));
    Finding::identity(deviations, BALANCED)
}

fn rigid_floor_shear(paper: &PaperTheory) -> Finding {
    let deviations =
        rigid_states().map(|(f, forces)| relative(paper.rigid_floor_shear(f, WEIGHT), forces.e));
    Finding::identity(deviations, BALANCED)
}

/// The smallest and the largest e/d of the balances over all forces. The floor slips at every force if μ is below
/// the smallest, and at none if μ is above the largest.
fn ratios() -> (f64, f64) {
    let ratios = (0..=400).filter_map(|index| {
        let f = if index == 0 {
            0.0
        } else {
            10f64.powf(f64::from(index) / 25.0 - 4.0)
        };
        equilibrium(upright(), RADIUS, f * WEIGHT, WEIGHT).map(|forces| forces.e / forces.d)
    });
    ratios.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), ratio| {
        (low.min(ratio), high.max(ratio))
    })
}

fn slips_at_once(paper: &PaperTheory) -> Finding {
    let (lowest, _) = ratios();
    let threshold = paper.critical_friction / paper.rigid_threshold;
    let compared = "mu_c/3 against the smallest e/d of the balances, over f from 0 to 1e12 mg (it is that at f = 0)";
    Finding::identity([relative(threshold, lowest)], compared)
}

fn never_slips(paper: &PaperTheory) -> Finding {
    let (_, highest) = ratios();
    let compared = "mu_c against the largest e/d of the balances, over f from 0 to 1e12 mg (it is approached from below)";
    Finding::identity([relative(paper.critical_friction, highest)], compared)
}

fn rigid_yield_force(paper: &PaperTheory) -> Finding {
    let deviations = (1..=80).map(|index| {
        let mu = 0.005 * f64::from(index) + 1e-3;
        let (printed, truth) = (paper.rigid_yield_force(mu), slip_force(mu));
        if printed == truth {
            0.0
        } else {
            ((printed - truth) / (truth + 3.0)).abs()
        }
    });
    let compared = "f at which e = mu d in the balances, by bisection, at mu = 0.006 to 0.401 in steps of 0.005";
    Finding::identity(deviations, compared)
}

fn rigid_divergence(paper: &PaperTheory) -> Finding {
    let distances = [1e-2, 1e-3, 1e-4];
    let forces = distances.map(|distance| slip_force(CRITICAL_FRICTION * (1.0 - distance)));
    let printed =
        distances.map(|distance| paper.rigid_yield_force(CRITICAL_FRICTION * (1.0 - distance)));
    let exponent = (forces[2] / forces[1]).log10();
    let deviations = [0, 1, 2].map(|index| relative(printed[index], forces[index]));
    let compared = format!(
        "f at which e = mu d in the balances, 1 %, 0.1 % and 0.01 % below mu_c: it grows as the distance to the \
         power -{exponent:.2}"
    );
    Finding::identity(deviations, &compared)
}

fn critical_friction(paper: &PaperTheory) -> Finding {
    let tangent = libm::tan(std::f64::consts::PI / 12.0);
    let compared = "mu_c against tan 15 degrees, the e/d of rigid cylinders under a large force";
    Finding::identity([relative(paper.critical_friction, tangent)], compared)
}

fn critical_friction_decimal(paper: &PaperTheory) -> Finding {
    let tangent = libm::tan(std::f64::consts::PI / 12.0);
    Finding::rounded(
        paper.critical_friction_decimal,
        1e-3,
        tangent,
        "tan 15 degrees",
    )
}
