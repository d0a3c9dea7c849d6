//! Growth of the yield force with stiffness: Eqs. (5) and (13), and the rigid limit.

use super::Check;
use crate::claims::finding::{Finding, relative, violation, worst};
use crate::claims::notation::{
    FRICTION, STIFFNESS, fixed, list, powers, range, scientific, size, values,
};
use crate::claims::printed::PaperTheory;
use crate::claims::truth::elastic_displacement;
use crate::model::{CRITICAL_FRICTION, Stack};
use crate::study::yield_force::PAPER_STIFFNESSES;
use crate::theory::{floor_slip_force, rigid_yield};

pub(crate) const CHECKS: &[Check] = &[
    Check::theory("scaling", |paper| {
        let own = [paper.lowest_stiffness, paper.highest_stiffness];
        let far = exponents(paper, FAR, exact_load);
        let near = exponents(paper, own, exact_load);
        let evidence = format!(
            "exponents of the DEM's exact quasi-static limit between {}: {}; over the paper's own range, {}: {}",
            values(STIFFNESS, &FAR),
            listed(far),
            range(STIFFNESS, &own),
            listed(near)
        );
        Finding::new(off_printed(paper, far), EXPONENT, evidence)
    }),
    Check::theory("scaling-of-naive", |paper| {
        let load = |mu: f64, epsilon: f64| {
            let z = if mu < CRITICAL_FRICTION {
                paper.displacement_below(mu, epsilon, 1.0)
            } else if mu == CRITICAL_FRICTION {
                paper.critical_displacement(paper.stiffness_ratio, epsilon, 1.0)
            } else {
                paper.stiff_displacement(mu, paper.stiffness_ratio, 1.0)
            };
            paper.floor_load(z, epsilon, 1.0)
        };
        let rigid = relative(load(BELOW, 1e-6), rigid_load(BELOW));
        let exponent = |mu| (load(mu, 1e-8) / load(mu, 1e-6)).log10() / 2.0;
        let (at, above) = (exponent(CRITICAL_FRICTION), exponent(ABOVE));
        let evidence = format!(
            "$2z/(\\epsilon r)$ of Eq. (13): $(f_0 + 3mg)/mg$ at $\\mu = {BELOW}$ (relative difference {}), exponents {at:.3} at \
             $\\mu_c$ and {above:.3} at ${ABOVE}$",
            size(rigid, 1e-9)
        );
        let deviation = worst([
            rigid,
            (at - paper.scaling_at).abs(),
            (above - paper.scaling_above).abs(),
        ]);
        Finding::new(deviation, 1e-9, evidence)
    }),
    Check::theory("scaling-of-perturbation", |paper| {
        let far = exponents(paper, FAR, |stack| perturbative_load(paper, stack));
        let evidence = format!(
            "exponents of Eq. (17) between {}: {}",
            values(STIFFNESS, &FAR),
            listed(far)
        );
        Finding::new(off_printed(paper, far), EXPONENT, evidence)
    }),
    Check::theory("naive-below", |paper| {
        naive(paper, &[0.1, 0.15, 0.2, 0.25], 1e-4, |mu, epsilon| {
            paper.displacement_below(mu, epsilon, 1.0)
        })
    }),
    Check::theory("naive-at", |paper| {
        let kappa = paper.stiffness_ratio;
        naive(paper, &[CRITICAL_FRICTION], 1e-3, |_, epsilon| {
            paper.critical_displacement(kappa, epsilon, 1.0)
        })
    }),
    Check::theory("naive-above", |paper| {
        let kappa = paper.stiffness_ratio;
        naive(paper, &[0.28, 0.3, 0.4, 0.5, 0.7], 1e-4, |mu, _| {
            paper.stiff_displacement(mu, kappa, 1.0)
        })
    }),
    // Eq. (13) below μ_c meets z ≥ 3 ε r/2 from μ_c/3 on.
    Check::theory("naive-validity", |paper| {
        let excess = |mu: f64| paper.displacement_below(mu, 1.0, 1.0) - paper.lowest_displacement;
        let factors = [0.999, 1.001];
        let [below, above] = factors.map(|factor| excess(factor * CRITICAL_FRICTION / 3.0));
        let evidence = format!(
            "$z/(\\epsilon r) - 3/2$ of Eq. (13) is ${}$ at ${}\\mu_c/3$ and ${}$ at ${}\\mu_c/3$: below $\\mu_c/3$ there is no solution",
            scientific(below, 1),
            factors[0],
            scientific(above, 1),
            factors[1]
        );
        let right = below < 0.0 && above > 0.0;
        Finding::statement(right, evidence)
    }),
    Check::theory("naive-breaks-down", |paper| {
        let distances = [1e-2, 1e-3, 1e-4];
        let stiffness = 1e4;
        let root = |mu: f64| elastic_displacement(&paper.stack(mu, stiffness));
        let ratios = distances.map(|distance| {
            let mu = CRITICAL_FRICTION * (1.0 - distance);
            paper.displacement_below(mu, 1.0 / stiffness, 1.0) / root(mu)
        });
        let mu = CRITICAL_FRICTION * (1.0 + distances[2]);
        let above = paper.stiff_displacement(mu, paper.stiffness_ratio, 1.0) / root(mu);
        let percents = distances.map(|distance| format!("{} %", 100.0 * distance));
        let evidence = format!(
            "naive over true displacement at {}: {} at {} below $\\mu_c$: it diverges there as $\\mu_c/(\\mu_c - \\mu)$. From \
             above it does not diverge but vanishes ({above:.4} at {}): it breaks down on both sides",
            values(STIFFNESS, &[stiffness]),
            fixed(ratios, 1),
            list(percents.clone()),
            percents[2]
        );
        let diverges = ratios[1] > 5.0 * ratios[0] && ratios[2] > 5.0 * ratios[1] && above < 0.1;
        Finding::statement(diverges, evidence)
    }),
    Check::theory("rigid-limit", |paper| {
        let stiffness = 1e8;
        let loads = |mu: f64| {
            let stack = paper.stack(mu, stiffness);
            [exact_load(&stack), perturbative_load(paper, &stack)]
        };
        let finite = [0.1, 0.15, 0.2, 0.25];
        let below = worst(finite.map(|mu| {
            let rigid = paper.rigid_yield_force(mu) + 3.0;
            worst(loads(mu).map(|load| relative(load, rigid)))
        }));
        let infinite = [CRITICAL_FRICTION, 0.3, 0.5];
        let above = infinite.into_iter().flat_map(loads);
        let least = above.fold(f64::INFINITY, f64::min);
        let evidence = format!(
            "at {} the DEM's exact quasi-static limit and Eq. (17) are within ${}$ of $f_0 + 3mg$ for {}, and at least ${}mg$ at \
             {}, where $f_0$ is infinite",
            values(STIFFNESS, &[stiffness]),
            scientific(below, 1),
            range(FRICTION, &finite),
            scientific(least, 1),
            values(FRICTION, &infinite)
        );
        Finding::new(worst([below, violation(least > 1e3)]), 1e-4, evidence)
    }),
    Check::theory("smooth-transition", |paper| {
        let stiffnesses = [paper.lowest_stiffness, 1e3, paper.highest_stiffness];
        let largest = worst(stiffnesses.map(|stiffness| {
            // Slopes on both sides of μ_c: with a kink they would differ at any distance.
            let load =
                |offset: f64| exact_load(&paper.stack(CRITICAL_FRICTION + offset, stiffness));
            let step = 1e-5;
            let (left, right) = (load(0.0) - load(-step), load(step) - load(0.0));
            relative(left, right)
        }));
        let evidence = format!(
            "in the exact quasi-static limit $f$ is finite at $\\mu_c$ and its slopes on both sides of it agree to ${}$ ({})",
            scientific(largest, 1),
            values(STIFFNESS, &stiffnesses)
        );
        Finding::new(largest, 1e-2, evidence)
    }),
    Check::theory("steepest-near-critical", |paper| {
        const SPACING: f64 = 0.004;
        let steepest = |stiffness: f64| {
            let mu = |index: i32| CRITICAL_FRICTION + SPACING * f64::from(index);
            let load = |index: i32| exact_load(&paper.stack(mu(index), stiffness)).ln();
            let loads: Vec<f64> = (-18..=18).map(load).collect();
            let slopes = loads.windows(3).map(|triple| triple[2] - triple[0]);
            let numbered = slopes.enumerate();
            let largest = numbered.max_by(|left, right| left.1.total_cmp(&right.1));
            largest.map_or(f64::NAN, |(index, _)| mu(index as i32 - 17))
        };
        let found = PAPER_STIFFNESSES.map(steepest);
        let evidence = format!(
            "$d\\ln(f + 3mg)/d\\mu$ of the exact quasi-static limit is largest at $\\mu$ of {} for {} ($\\mu_c = {:.3}$)",
            fixed(found, 3),
            values(STIFFNESS, &PAPER_STIFFNESSES),
            CRITICAL_FRICTION
        );
        Finding::new(relative(found[2], paper.critical_friction), 0.01, evidence)
    }),
];

/// Deviation that the next order causes in an exponent at 1/ε = 10⁷.
const EXPONENT: f64 = 2e-3;
/// Stiffnesses at which the next order is negligible.
const FAR: [f64; 2] = [1e7, 1e8];
/// The frictions of Fig. 2(b).
const BELOW: f64 = 0.25;
const ABOVE: f64 = 0.3;

fn exact_load(stack: &Stack) -> f64 {
    floor_slip_force(stack).unwrap_or(f64::NAN) + 3.0
}

fn rigid_load(mu: f64) -> f64 {
    let rigid = rigid_yield(&Stack::paper(mu, 1e4));
    rigid.yield_force.unwrap_or(f64::INFINITY) + 3.0
}

/// Returns exponents between two stiffnesses: of ε below μ_c, and of 1/ε at and above μ_c.
fn exponents(paper: &PaperTheory, [from, to]: [f64; 2], load: impl Fn(&Stack) -> f64) -> [f64; 3] {
    let slope = |low: f64, high: f64| (high / low).ln() / (to / from).ln();
    let at = |mu, stiffness| load(&paper.stack(mu, stiffness));
    let missing = |stiffness| (rigid_load(BELOW) - at(BELOW, stiffness)).abs();
    [
        slope(missing(to), missing(from)),
        slope(at(CRITICAL_FRICTION, from), at(CRITICAL_FRICTION, to)),
        slope(at(ABOVE, from), at(ABOVE, to)),
    ]
}

/// Returns the largest deviation from the exponents of Eq. (5).
fn off_printed(paper: &PaperTheory, [below, at, above]: [f64; 3]) -> f64 {
    worst([
        (below - paper.scaling_below).abs(),
        (at - paper.scaling_at).abs(),
        (above - paper.scaling_above).abs(),
    ])
}

/// Returns F + 3 by Eq. (17).
fn perturbative_load(paper: &PaperTheory, stack: &Stack) -> f64 {
    paper.perturbative_load(stack.floor_friction, stack.stiffness_ratio, stack.epsilon())
}

fn listed([below, at, above]: [f64; 3]) -> String {
    format!(
        "{below:.3} (correction to $f_0$ at $\\mu = {BELOW}$, in $\\epsilon$), {at:.3} ($\\mu_c$) and {above:.3} (${ABOVE}$)"
    )
}

/// Compares a naive solution with the root of the elastic equation, at 1/ε = 10⁴, 10⁶ and 10⁸. `bound` is for the
/// last.
fn naive(
    paper: &PaperTheory,
    frictions: &[f64],
    bound: f64,
    z: impl Fn(f64, f64) -> f64,
) -> Finding {
    let at = |stiffness: f64| {
        worst(frictions.iter().map(|&mu| {
            let root = elastic_displacement(&paper.stack(mu, stiffness));
            relative(z(mu, 1.0 / stiffness), root)
        }))
    };
    let stiffnesses = [1e4, 1e6, 1e8];
    let found = stiffnesses.map(at);
    let evidence = format!(
        "largest relative difference to the root of the elastic equation, {}: {} at {}",
        values(FRICTION, frictions),
        powers(found, 1),
        values(STIFFNESS, &stiffnesses)
    );
    Finding::new(found[2], bound, evidence)
}
