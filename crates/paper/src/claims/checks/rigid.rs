//! Setup and rigid cylinders: Eqs. (1) to (4), and the supplement's repetition of the first three.

use super::Check;
use crate::claims::finding::{Finding, imbalance, relative, worst};
use crate::claims::notation::{FRICTION, STIFFNESS, list, range};
use crate::claims::printed::PaperTheory;
use crate::claims::truth::{Balanced, Forces, equilibrium, pairs, paper_limit, turned};
use crate::model::{CRITICAL_FRICTION, Stack};
use nalgebra::{Matrix6, Vector2, Vector6};

pub(crate) const CHECKS: &[Check] = &[
    Check::theory("mass", |paper| {
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
    }),
    Check::theory("vertical-balance-of-stack", |paper| {
        in_balance(&ANGLES, |state| imbalance(&paper.stack_terms(state)))
    }),
    Check::theory("coulomb-slip", |paper| {
        let frictions = [0.12, 0.2, CRITICAL_FRICTION, 0.3, 0.5];
        let deviations = pairs(frictions, [1e2, 1e3, 1e4]).filter_map(|(mu, stiffness)| {
            let limit = paper_limit(&Stack::paper(mu, stiffness))?;
            let epsilon = 1.0 / stiffness;
            let shear = (limit.z? - epsilon) * limit.tangent?;
            let load = (limit.floor_slip_force? + paper.stack_weights) * epsilon;
            Some(relative(shear, mu * (load / paper.floor_contacts)))
        });
        let compared = "$e$ and $d = (f + 3mg)/2$ of the exact quasi-static limit at yield";
        Finding::identity(deviations, compared)
    }),
    Check::theory("bottom-contact-open", |paper| {
        let frictions = [0.12, 0.2, CRITICAL_FRICTION, 0.3, 0.4, 0.5, 0.53];
        let stiffnesses = [paper.lowest_stiffness, 1e3, paper.highest_stiffness];
        let inward = pairs(frictions, stiffnesses).map(|(mu, stiffness)| {
            let limit = paper_limit(&paper.stack(mu, stiffness));
            -limit.and_then(|limit| limit.y).unwrap_or(f64::NAN) * stiffness
        });
        let lowest = -worst(inward);
        let evidence = format!(
            "in the exact quasi-static limit the bottom cylinders have parted at yield everywhere ({}, {}): \
             $y/(\\epsilon r)$ is at least {lowest:.3}",
            range(FRICTION, &frictions),
            range(STIFFNESS, &stiffnesses)
        );
        Finding::statement(lowest > 0.0, evidence)
    }),
    Check::theory("six-conditions", |paper| {
        let mut known = Vector6::zeros();
        (known[0], known[5]) = (-paper.stack_weights, paper.upper_weights);
        let frictions = [0.1, 0.15, 0.2, 0.25];
        let solved = frictions.map(|mu| {
            let solution = conditions(paper, mu).lu().solve(&known);
            let force = solution.map_or(f64::NAN, |solution| solution[5]);
            relative(force, slip_force(mu))
        });
        let singular = conditions(paper, CRITICAL_FRICTION).determinant().abs();
        let deviations = solved.into_iter().chain([singular]);
        let compared = format!(
            "six linear equations for six unknowns, with the directions of rigid cylinders, solved for {}; singular at $\\mu_c$ alone, where $f$ diverges",
            range(FRICTION, &frictions)
        );
        Finding::identity(deviations, &compared)
    }),
    Check::theory("torque-balance", |paper| {
        in_balance(&ANGLES, |state| imbalance(&paper.torque_terms(state)))
    }),
    Check::theory("horizontal-balance", |paper| {
        in_balance(&ANGLES, |state| imbalance(&paper.horizontal_terms(state)))
    }),
    Check::theory("vertical-balance", |paper| {
        in_balance(&ANGLES, |state| imbalance(&paper.vertical_terms(state)))
    }),
    // The vertical balance of the bottom cylinder, d = a n_y + b t_y + m g, follows from Eq. (3) together with
    // f + 3 m g = 2 d: half of one subtracted from half of the other.
    Check::theory("whose-balances", |paper| {
        let deviations = balanced(&ANGLES).map(|state| {
            let upper: f64 = paper.vertical_terms(&state).iter().sum();
            let stack: f64 = paper.stack_terms(&state).iter().sum();
            let Forces { a, b, d, .. } = state.forces;
            let normal = state.normal;
            let of_the_bottom = d - a * normal.y - b * turned(normal).y - WEIGHT;
            ((of_the_bottom + 0.5 * upper + 0.5 * stack) / d).abs()
        });
        let compared = "Eq. (3) is the balance of the upper cylinder, as the paper says right below it; with $f + 3mg = 2d$ it is \
             equivalent to the vertical balance of the bottom one";
        Finding::identity(deviations, compared)
    }),
    Check::theory("unit-vectors", |paper| {
        let deviations = ANGLES.map(|angle| {
            let normal = direction(angle);
            let tangent = paper.tangent(normal);
            worst([
                tangent.dot(&normal).abs(),
                (tangent.norm() - 1.0).abs(),
                (tangent - turned(normal)).norm(),
            ])
        });
        let compared = r"length of $\boldsymbol{t}$, its product with $\boldsymbol{n}$, and $\boldsymbol{n}$ turned by $-90$ degrees";
        Finding::identity(deviations, compared)
    }),
    Check::theory("rigid-directions", |paper| {
        // Bottom centres 2r apart, the upper one 2r from both.
        let rise = (4.0f64 - 1.0).sqrt();
        let normal = Vector2::new(-1.0, rise) / 2.0;
        let deviations = [
            (paper.rigid_normal() - normal).norm(),
            (paper.rigid_tangent() - turned(normal)).norm(),
        ];
        Finding::identity(deviations, "three touching circles of one radius")
    }),
    Check::theory("rigid-floor-load", |paper| {
        in_balance(&[UPRIGHT], |state| {
            relative(paper.rigid_floor_load(state), state.forces.d)
        })
    }),
    Check::theory("rigid-floor-shear", |paper| {
        in_balance(&[UPRIGHT], |state| {
            relative(paper.rigid_floor_shear(state), state.forces.e)
        })
    }),
    Check::theory("rigid-slips-at-once", |paper| {
        let (lowest, _) = ratios();
        let threshold = paper.critical_friction / paper.rigid_threshold;
        let compared = r"$\mu_c/3$ against the smallest $e/d$ of the balances, over $f$ from 0 to $10^{12}mg$ (it is that at $f = 0$)";
        Finding::identity([relative(threshold, lowest)], compared)
    }),
    Check::theory("rigid-never-slips", |paper| {
        let (_, highest) = ratios();
        let compared = r"$\mu_c$ against the largest $e/d$ of the balances, over $f$ from 0 to $10^{12}mg$ (it is approached from below)";
        Finding::identity([relative(paper.critical_friction, highest)], compared)
    }),
    Check::theory("rigid-yield-force", |paper| {
        let step = 0.005;
        let frictions: Vec<f64> = (1..=80)
            .map(|index| step * f64::from(index) + 1e-3)
            .collect();
        let deviations = frictions.iter().map(|&mu| {
            let (printed, truth) = (paper.rigid_yield_force(mu), slip_force(mu));
            // Both are infinite from μ_c on.
            match printed == truth {
                true => 0.0,
                false => ((printed - truth) / (truth + 3.0)).abs(),
            }
        });
        let compared = format!(
            "$f$ at which $e = \\mu d$ in the balances, by bisection, at {} in steps of {step}",
            range(FRICTION, &frictions)
        );
        Finding::identity(deviations, &compared)
    }),
    Check::theory("rigid-divergence", |paper| {
        let distances = [1e-2, 1e-3, 1e-4];
        let frictions = distances.map(|distance| CRITICAL_FRICTION * (1.0 - distance));
        let forces = frictions.map(slip_force);
        let exponent = (forces[2] / forces[1]).log10();
        let pairs = frictions.iter().zip(forces);
        let deviations = pairs.map(|(&mu, force)| relative(paper.rigid_yield_force(mu), force));
        let compared = format!(
            "$f$ at which $e = \\mu d$ in the balances, {} below $\\mu_c$: it grows as the distance to the power $-{exponent:.2}$",
            list(distances.map(|distance| format!("{} %", 100.0 * distance)))
        );
        Finding::identity(deviations, &compared)
    }),
    Check::theory("critical-friction", |paper| {
        let deviation = relative(paper.critical_friction, tan_15_degrees());
        let compared =
            r"$\mu_c$ against $\tan 15^\circ$, the $e/d$ of rigid cylinders under a large force";
        Finding::identity([deviation], compared)
    }),
    Check::theory("critical-friction-decimal", |paper| {
        let (printed, truth) = (paper.critical_friction_decimal, tan_15_degrees());
        let evidence = format!("$\\tan 15^\\circ = {truth:.5}$, printed is {printed}");
        // It may be off by half a unit of its last digit.
        Finding::new((printed - truth).abs(), 0.5e-3 * (1.0 + 1e-9), evidence)
    }),
];

const WEIGHT: f64 = 0.37;
const FORCES: [f64; 5] = [0.0, 0.1, 1.0, 10.0, 1e3];
/// Angle of the line between rigid cylinders to the vertical.
const UPRIGHT: f64 = std::f64::consts::FRAC_PI_6;
const ANGLES: [f64; 4] = [0.35, UPRIGHT, 0.8, 1.1];

fn tan_15_degrees() -> f64 {
    libm::tan(std::f64::consts::PI / 12.0)
}

fn direction(angle: f64) -> Vector2<f64> {
    Vector2::new(-angle.sin(), angle.cos())
}

/// Returns equilibria at these angles and several forces.
fn balanced(angles: &[f64]) -> impl Iterator<Item = Balanced> {
    angles.iter().flat_map(|&angle| {
        FORCES
            .iter()
            .filter_map(move |force| equilibrium(direction(angle), force * WEIGHT, WEIGHT))
    })
}

fn in_balance(angles: &[f64], deviation: impl Fn(&Balanced) -> f64) -> Finding {
    let compared =
        "put into the balances of forces and torques on each cylinder, solved as a linear system";
    Finding::identity(balanced(angles).map(|state| deviation(&state)), compared)
}

/// Returns e and d of rigid cylinders under a force, which is given in weights.
fn rigid_forces(force: f64) -> Option<(f64, f64)> {
    let state = equilibrium(direction(UPRIGHT), force * WEIGHT, WEIGHT)?;
    Some((state.forces.e, state.forces.d))
}

/// Returns the matrix of the conditions for a, b, c, d, e, f: stack, Coulomb, c = 0, Eqs. (1) to (3).
fn conditions(paper: &PaperTheory, mu: f64) -> Matrix6<f64> {
    let normal = direction(UPRIGHT);
    let tangent = paper.tangent(normal);
    let [normal_y, tangent_y] = [normal.y, tangent.y].map(|part| paper.pair_contacts * part);
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

/// Returns f/(m g) at which rigid cylinders slip, by bisection of e − μ d: 0 if they slip at once, infinite if never.
fn slip_force(mu: f64) -> f64 {
    let excess = |force: f64| rigid_forces(force).map_or(f64::NAN, |(e, d)| e - mu * d);
    let (mut low, mut high) = (0.0, 1e12);
    if excess(low) >= 0.0 {
        return 0.0;
    }
    if excess(high) < 0.0 {
        return f64::INFINITY;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        let below = excess(middle) < 0.0;
        (low, high) = if below { (middle, high) } else { (low, middle) };
    }
    high
}

/// Returns the smallest and the largest e/d of the balances over all forces. The floor slips at every force if μ is
/// below the smallest, and at none if μ is above the largest.
fn ratios() -> (f64, f64) {
    let growing = (1..=400).map(|index| 10f64.powf(f64::from(index) / 25.0 - 4.0));
    let states = std::iter::once(0.0).chain(growing).filter_map(rigid_forces);
    let ratios = states.map(|(e, d)| e / d);
    ratios.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), ratio| {
        (low.min(ratio), high.max(ratio))
    })
}
