//! Eqs. (6) to (10) and (12), and the statements around them.

use super::Check;
use super::appendix::range_of_states;
use crate::claims::finding::{Finding, relative, worst};
use crate::claims::notation::{
    FRICTION, STIFFNESS, list, number, percent, range, scientific, values,
};
use crate::claims::truth::{
    NORMAL_STIFFNESS, RADIUS, RATIOS, YieldState, elastic_displacement, figure_loads, pairs,
    paper_limit, yield_force, yield_states,
};
use crate::model::{Arms, CRITICAL_FRICTION, ContactConvention, Problem, Stack};
use crate::study::yield_force::PAPER_STIFFNESSES;
use crate::theory::{elastic_root, quasistatic_limit};

pub(crate) const CHECKS: &[Check] = &[
    // A cylinder alone on the floor sinks by ε r.
    Check::theory("epsilon", |paper| {
        let deviations = [1e-4, 1e-2, 0.3].map(|weight| {
            let printed = paper.epsilon(weight, NORMAL_STIFFNESS, RADIUS) * RADIUS;
            relative(printed, weight / NORMAL_STIFFNESS)
        });
        let compared =
            r"$\epsilon r$ against how far one cylinder sinks into the floor under its weight";
        Finding::identity(deviations, compared)
    }),
    Check::theory("floor-load", |paper| {
        let compared = r"$(f + 3mg)/mg$ of the solution against $2z/(\epsilon r)$";
        at_states(compared, |state| {
            let load = state.force / state.weight() + 3.0;
            relative(paper.floor_load(state.z(), state.epsilon, RADIUS), load)
        })
    }),
    Check::theory("lowest-displacement", |paper| {
        // Three cylinders at rest on two floor contacts.
        let truth = 3.0 / 2.0;
        Finding::identity(
            [
                relative(paper.lowest_displacement, truth),
                relative(paper.floor_load(truth, 1.0, 1.0), 3.0),
            ],
            r"$z/(\epsilon r)$ of three weights on two floor contacts, $f = 0$",
        )
    }),
    Check::theory("elastic-equation", |paper| {
        let compared = r"$z$ against $r\mathcal{D}\mathcal{E}$ at the solution's own $\alpha$";
        at_states(compared, |state| paper.closed_form(state))
    }),
    // 𝒟 = (T² + 2√3 T − 1)/(T (1 + T²))/(1 − α) with T read off the solution's geometry.
    Check::theory("script-d", |paper| {
        let compared =
            r"$\mathcal{D}$ against its value in terms of the angle of the line of centres";
        at_states(compared, |state| {
            let tangent = state.half_angle_tangent();
            let square = tangent * tangent;
            let truth = (square + 2.0 * 3f64.sqrt() * tangent - 1.0) / (tangent * (1.0 + square));
            let printed = paper.geometry(state.friction, state.alpha()) * (1.0 - state.alpha());
            // 𝒟 vanishes with the displacements, but its terms are of order 1: the deviation is relative to them.
            (printed - truth).abs()
        })
    }),
    // ℰ = 1/(1 + κ(1 + T²)).
    Check::theory("script-e", |paper| {
        let compared =
            r"$\mathcal{E}$ against its value in terms of the angle of the line of centres";
        at_states(compared, |state| {
            let tangent = state.half_angle_tangent();
            let truth = 1.0 / (1.0 + state.ratio * (1.0 + tangent * tangent));
            let printed = paper.compliance(state.friction, state.ratio, state.alpha());
            relative(printed, truth)
        })
    }),
    Check::theory("stiff-displacement", |paper| {
        let deviations = pairs(WIDE, RATIOS).map(|(mu, kappa)| {
            let square = mu * mu;
            let numerator = square + 2.0 * 3f64.sqrt() * mu - 1.0;
            let truth = RADIUS * numerator / (mu * (1.0 + square)) / (1.0 + kappa * (1.0 + square));
            relative(paper.stiff_displacement(mu, kappa, RADIUS), truth)
        });
        let compared =
            r"the right side of the elastic equation at $\alpha = 0$, in terms of $T = \mu$";
        Finding::identity(deviations, compared)
    }),
    Check::theory("stiff-displacement-changes-sign", |paper| {
        let kappa = paper.stiffness_ratio;
        let at = |mu: f64| paper.stiff_displacement(mu, kappa, 1.0);
        let distance = 1e-9;
        let [below, above] = [-distance, distance].map(|offset| at(CRITICAL_FRICTION + offset));
        let evidence = format!(
            "$z_\\star$ is ${}r$ at $\\mu_c - {1}$ and ${2}r$ at $\\mu_c + {1}$",
            scientific(below, 2),
            number(distance),
            scientific(above, 2)
        );
        Finding::statement(below < 0.0 && above > 0.0, evidence)
    }),
    Check::theory("stiff-displacement-is-the-limit", |paper| {
        let (frictions, stiffness) = ([0.28, 0.3, 0.4, 0.5, 0.7], 1e8);
        let largest = worst(frictions.map(|mu| {
            let printed = paper.stiff_displacement(mu, paper.stiffness_ratio, 1.0);
            relative(elastic_displacement(&paper.stack(mu, stiffness)), printed)
        }));
        let evidence = format!(
            "root of the elastic equation at {} against $z_\\star$, {}: largest relative difference ${}$ (it falls as \
             $\\epsilon$)",
            values(STIFFNESS, &[stiffness]),
            range(FRICTION, &frictions),
            scientific(largest, 1)
        );
        Finding::new(largest, 1e-4, evidence)
    }),
    Check::theory("stiff-displacement-of-dem", |paper| {
        let differences = [0.28, 0.3, 0.4, 0.5].map(|mu| {
            let limit = paper_limit(&paper.stack(mu, NEARLY_RIGID));
            let exact = limit.and_then(|limit| limit.z).unwrap_or(f64::NAN);
            let printed = paper.stiff_displacement(mu, paper.stiffness_ratio, 1.0);
            (mu, printed / exact - 1.0)
        });
        let listed = differences.map(|(mu, difference)| {
            format!("{} at {}", percent(difference, 2), values(FRICTION, &[mu]))
        });
        let evidence = format!(
            "$z_\\star$ against the displacement at which the DEM's exact quasi-static limit slips at {}, whatever the weight: {}",
            values(STIFFNESS, &[NEARLY_RIGID]),
            list(listed)
        );
        let largest = worst(differences.map(|(_, difference)| difference.abs()));
        Finding::new(largest, 1e-3, evidence)
    }),
    // Below μ_c displacements vanish with ε, and the analysis must become exact with them.
    Check::theory("small-displacements", |_| {
        let (below, stiffnesses) = (0.2, [1e3, 1e5]);
        let off = stiffnesses.map(|stiffness| {
            let stack = Stack::paper(below, stiffness);
            let load = elastic_root(&stack).map_or(f64::NAN, |root| root.load);
            load / (yield_force(&stack) + 3.0) - 1.0
        });
        let displacements = [0.2, 0.3, 0.5].map(|mu| {
            let limit = paper_limit(&Stack::paper(mu, NEARLY_RIGID));
            (mu, limit.and_then(|limit| limit.z).unwrap_or(f64::NAN))
        });
        let listed = displacements
            .map(|(mu, z)| format!("${}r$ at {}", scientific(z, 1), values(FRICTION, &[mu])));
        let evidence = format!(
            "solution of the elastic equation against the DEM's exact quasi-static limit at {}: {} off at {}. $z$ at yield at {}: \
             {}. Above $\\mu_c$ displacements do not become small as $\\epsilon \\to 0$, and the analysis remains an \
             approximation there",
            values(FRICTION, &[below]),
            list(off.map(|off| format!("${}$", scientific(off, 1)))),
            values(STIFFNESS, &stiffnesses),
            values(STIFFNESS, &[NEARLY_RIGID]),
            list(listed)
        );
        // An error of the first order in ε falls to a hundredth.
        Finding::new((off[1] / off[0]).abs(), 0.02, evidence)
    }),
    Check::theory("slip-above-critical", |_| {
        let (frictions, stiffness) = ([0.27, 0.3, 0.4, 0.5], 1e2);
        let forces = frictions.map(|mu| yield_force(&Stack::paper(mu, stiffness)));
        let yields = forces.iter().filter(|force| force.is_finite()).count();
        let evidence = format!(
            "the exact quasi-static limit at {} yields at the floor for {yields} of {} frictions above $\\mu_c$ ({}), at a \
             finite force",
            values(STIFFNESS, &[stiffness]),
            frictions.len(),
            range(FRICTION, &frictions)
        );
        Finding::exceptions(frictions.len() - yields, evidence)
    }),
    Check::theory("quantitative-prediction", |paper| {
        let load = |stack: &Stack| {
            paper.perturbative_load(stack.floor_friction, paper.stiffness_ratio, stack.epsilon())
        };
        let (deviation, mu, stiffness) = over_figure(load);
        let evidence = format!(
            "$f_\\epsilon + 3mg$ against the DEM's exact quasi-static limit, {}: at most {:.1} % off ({}, {})",
            range_of_figure(),
            100.0 * deviation,
            values(FRICTION, &[mu]),
            values(STIFFNESS, &[stiffness])
        );
        Finding::new(deviation, 1e-3, evidence)
    }),
    Check::theory("elastic-equation-of-dem", |paper| {
        let load = |stack: &Stack| elastic_root(stack).map_or(f64::NAN, |root| root.load);
        let (deviation, mu, stiffness) = over_figure(load);
        let stiffest = paper.highest_stiffness;
        let listed = [0.2, 0.3].map(|mu| {
            let stack = Stack::paper(mu, stiffest);
            let change = load(&stack) / (yield_force(&stack) + 3.0) - 1.0;
            format!("{} at {}", percent(change, 2), values(FRICTION, &[mu]))
        });
        let evidence = format!(
            "solution of the elastic equation against the DEM's exact quasi-static limit, {}: $f + 3mg$ is at most {:.1} % \
             off ({}, {}); at {}, {}",
            range_of_figure(),
            100.0 * deviation,
            values(FRICTION, &[mu]),
            values(STIFFNESS, &[stiffness]),
            values(STIFFNESS, &[stiffest]),
            list(listed)
        );
        Finding::new(deviation, 1e-3, evidence)
    }),
    Check::theory("arm-of-dem", |_| {
        let half_way = Arms::reciprocal(-0.5, -1.0);
        let change = |convention: ContactConvention, mu: f64, stiffness: f64| {
            let stack = Stack::paper(mu, stiffness);
            let force = |arms| {
                let problem = Problem::new(stack, ContactConvention { arms, ..convention });
                let force = |own: Problem| quasistatic_limit(&own).floor_slip_force;
                problem.ok().and_then(force).unwrap_or(f64::NAN)
            };
            force(half_way) / force(Arms::PAPER) - 1.0
        };
        let [below, above, stiffest] = [0.2, 0.3, 1e4];
        let [written, turned] = [ContactConvention::PAPER, ContactConvention::TURNING]
            .map(|rule| PAPER_STIFFNESSES.map(|stiffness| change(rule, above, stiffness)));
        let percents = |changes: [f64; 3]| list(changes.map(|change| percent(change, 1)));
        let evidence = format!(
            "exact quasi-static limit with the contact point on the undeformed floor and half-way between cylinders \
             ($r_1 = -1$ and $-1/2$) against $r_1 = 0$: $f$ changes by {} at {} and {} ({} with a spring that turns), and by {} \
             at {} and {}. Above $\\mu_c$ displacements are not small for stiff cylinders either, and what is quadratic in them \
             counts",
            percents(written),
            values(FRICTION, &[above]),
            values(STIFFNESS, &PAPER_STIFFNESSES),
            percents(turned),
            percent(change(ContactConvention::PAPER, below, stiffest), 2),
            values(FRICTION, &[below]),
            values(STIFFNESS, &[stiffest])
        );
        Finding::new(worst(written.map(f64::abs)), 1e-2, evidence)
    }),
];

fn at_states(compared: &str, deviation: impl Fn(&YieldState) -> f64) -> Finding {
    Finding::identity(
        yield_states().iter().map(deviation),
        &format!(
            "{compared}; solutions of the five unreduced equations ({})",
            range_of_states()
        ),
    )
}

/// 1/ε so large that displacements above μ_c agree with those for ε → 0 to 7 digits.
const NEARLY_RIGID: f64 = 1e8;
const WIDE: [f64; 8] = [0.1, 0.15, 0.2, 0.25, 0.28, 0.3, 0.5, 0.7];

/// Returns the largest deviation of F + 3 from the exact quasi-static limit over Fig. 2(a), with its friction and
/// stiffness.
fn over_figure(load: impl Fn(&Stack) -> f64) -> (f64, f64, f64) {
    let compared = figure_loads().iter().map(|(stack, exact)| {
        let deviation = relative(load(stack), *exact);
        (deviation, stack.floor_friction, stack.stiffness)
    });
    // `total_cmp` puts NaN last, so a deviation that is not a number counts as the largest.
    let largest = compared.max_by(|left, right| left.0.total_cmp(&right.0));
    largest.unwrap_or((f64::NAN, f64::NAN, f64::NAN))
}

/// Describes the range of the stacks of Fig. 2(a).
fn range_of_figure() -> String {
    let stacks = || figure_loads().iter().map(|(stack, _)| stack);
    let frictions: Vec<f64> = stacks().map(|stack| stack.floor_friction).collect();
    let stiffnesses: Vec<f64> = stacks().map(|stack| stack.stiffness).collect();
    let stiffnesses = range(STIFFNESS, &stiffnesses);
    format!("{}, {stiffnesses}", range(FRICTION, &frictions))
}
